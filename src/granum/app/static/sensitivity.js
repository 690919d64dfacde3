// A result over one of its inputs: the chart beside a number, on Calculate and under an exercise.
import { html, t, ask, useAnswer, useRef, Working } from './core.js';
import { Plot } from './plot.js';

/** The result over one input; asked for when the number itself stands, and what else comes first, so that these never wait for it. */
export function Sensitivity({ card, values, case: text = '', old, wait = false, units = {}, laws = false, choice, setChoice, none = '' }) {
  const fresh = useRef(null);
  if (!old && !wait) fresh.current = values;
  const asked = fresh.current && {
    inputs: fresh.current,
    against: choice.against || '',
    output: choice.output || '',
    unit: units[choice.output || card.outputs?.[0]?.name] || '',
    laws: laws && card.sort === 'formula',
    case: text,
  };
  const { data, error, pending, cancel, job } = useAnswer(
    (signal) => (asked ? ask(`/api/sensitivity/${card.card}`, asked, { signal }) : Promise.resolve(null)),
    [JSON.stringify(asked)],
    120,
  );
  if (card.sort === 'equipment' && pending && !data && !old) return html`<${Working} busy=${true} cancel=${cancel} job=${job} />`;
  const missing = error ? none : data?.figure ? '' : data?.note || none;
  if (missing && !data?.inputs?.length) return html`<p class="small dim">${missing}</p>`;
  if (error || !(data?.figure || missing)) return null;
  const menu = (name, label, list, chosen) =>
    list.length > 1 &&
    html`<label class="small">${label} <select data-menu=${name} value=${chosen} onChange=${(e) => setChoice({ ...choice, [name]: e.target.value })}>${list.map((p) => html`<option value=${p.name} selected=${p.name === chosen}>${p.label}</option>`)}</select></label>`;
  return html`<section class=${(pending || wait) && !old ? 'sensitivity stale' : 'sensitivity'} aria-label=${t('Sensitivity')} data-sensitivity=${data.against}>
    <div class="row"><h2>${t('How it changes')}</h2>${menu('output', t('Draw'), data.outputs, data.output)} ${menu('against', t('over'), data.inputs, data.against)}</div>
    ${missing && html`<p class="small dim">${missing}</p>`}
    ${data.figure && html`<p class="spoken">${data.spoken}</p>
    <${Plot} figure=${data.figure} label=${data.spoken} name=${`${card.card}-${data.against}`} />`}
    ${data.covered && html`<p class="small dim">${card.sort === 'equipment' ? t('Shaded: within its practical limits.') : t('Shaded: what the source covers.')}</p>`}
    ${laws && card.sort === 'formula' && data.figure?.data.length > 2 && html`<p class="small dim">${t('Thin lines: other laws.')}</p>`}</section>`;
}
