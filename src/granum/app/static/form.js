// A form made from a card: one field per parameter, with units, limits and range of the source beside it.
import { html, t } from './core.js';
import { Quantity, inLanguage, joined } from './quantity.js';

export function Field({ parameter: p, text, onChange, problem, id = `field-${p.name}` }) {
  const note = `${id}-note`;
  const Entry = text?.startsWith('{') && p.law ? LawTable : p.options?.length ? Choice : p.kind ? Quantity : Text;
  return html`<div class="field"><label for=${id}>${p.label} <span class="symbol" dangerouslySetInnerHTML=${{ __html: p.symbol_shown || '' }} />${!p.required && html` <span class="small dim">${t('optional')}</span>`}</label>
    <div class="entry"><${Entry} p=${p} id=${id} note=${note} text=${text} onChange=${onChange} problem=${problem} /></div>
    <div class="note small dim" id=${note}>${[p.allowed, p.source_range && `${t('source covers')} ${p.source_range}`].filter(Boolean).join(' · ')}
    ${problem && !p.kind && html`<div class="out">${problem}</div>`}</div></div>`;
}

function Choice({ p, id, note, text, onChange }) {
  const shown = text || (p.required ? '' : (p.default_shown?.number ?? ''));
  const open = p.required || p.default === null;
  const known = shown === '' || p.options.some((o) => o.value === shown);
  return html`<select id=${id} class="alone" value=${shown} aria-describedby=${note} onChange=${(e) => onChange(meant(p, e.target.value))}>
    ${(open || shown === '') && html`<option value="">—</option>`}${!known && html`<option value=${shown} selected>${shown.replaceAll('_', ' ')}</option>`}
    ${p.options.map((o) => html`<option value=${o.value} selected=${o.value === shown}>${o.label}</option>`)}</select>`;
}

/** A word as it is; a law that has parameters with those of its example, to be changed. */
const meant = (p, word) => p.options.find((o) => o.value === word)?.table || word;

/** A law with its own parameters: the law as a choice, its parameters as fields. */
function LawTable({ p, id, note, text, onChange }) {
  let table = null;
  try { table = JSON.parse(text); } catch { /* shown as text below */ }
  if (!table || typeof table !== 'object') return html`<input id=${id} value=${text} aria-describedby=${note} onInput=${(e) => onChange(e.target.value)} />`;
  const labels = p.laws?.[table.law];
  const options = p.options.some((o) => o.value === table.law) ? p.options : [{ value: table.law, label: labels?.law || String(table.law).replaceAll('_', ' ') }, ...p.options];
  const plain = (value) => (typeof value === 'string' ? inLanguage(value) : typeof value === 'number' ? inLanguage(String(value)) : JSON.stringify(value));
  const read = (typed, before) => { const clean = typed.replace(/^([-+]?\d*),(\d*)/, '$1.$2'); if (clean.trim().startsWith('[')) { try { return JSON.parse(clean); } catch { return clean; } } return typeof before === 'number' && clean.trim() !== '' && Number.isFinite(Number(clean)) ? Number(clean) : clean; };
  return html`<div class="law"><select id=${id} class="alone" value=${table.law} aria-describedby=${note} onChange=${(e) => onChange(meant(p, e.target.value))}>${options.map((o) => html`<option value=${o.value} selected=${o.value === table.law}>${o.label}</option>`)}</select>
    ${Object.entries(table).filter(([name]) => name !== 'law').map(([name, value]) => html`<label class="small">${labels?.[name] || name.replaceAll('_', ' ')} <input data-option=${name} value=${plain(value)} onInput=${(e) => onChange(JSON.stringify({ ...table, [name]: read(e.target.value, value) }))} /></label>`)}</div>`;
}

function Text({ p, id, note, text, onChange, problem }) {
  return html`<input id=${id} type="text" value=${text || ''} placeholder=${p.default_shown?.number ?? ''} aria-describedby=${note} aria-invalid=${problem ? 'true' : 'false'} onInput=${(e) => onChange(e.target.value)} />`;
}

/** The card's own example, so that it shows a result when it is opened. */
export function ordinary(card) {
  return Object.fromEntries(card.parameters.filter((p) => p.example).map((p) => [p.name, joined(p.example)]));
}
