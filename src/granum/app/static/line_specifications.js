// Design specifications of a line: what is sought, which result of a unit or figure of a stream it is to give, and where to look.
import { colon, html, t, useState } from './core.js';
import { pretty } from './line_forms.js';
import { Quantity, readable } from './quantity.js';

const NOTHING = { vary: '', of: '', so_that: '', equals: '', lower: '', upper: '' };
/** Figures of a feed that can be sought: a share whose phase has no other, or dry gas that is given moist, cannot. */
const FED = /^(temperature|pressure|mass_flow|liquid_flow|solid_flow|gas_flow|(liquid|solid|gas)\..+)$/;

const HUMID = ['relative_humidity', 'humidity_ratio', 'wet_bulb_temperature', 'dew_point_temperature'];

const sought = (form) => [
  ...Object.entries(form.units).flatMap(([name, unit]) => given(name, unit, (p) => p.kind && !p.series)),
  ...Object.entries(form.feeds).flatMap(([name, feed]) =>
    given(
      name,
      feed,
      (p) => p.kind && FED.test(p.name) && !(p.name === 'gas_flow' && HUMID.some((word) => feed.values[word])),
    ),
  ),
];
const given = (name, item, fits) =>
  item.parameters
    .filter((p) => fits(p) && item.values[p.name] !== undefined)
    .map((p) => ({
      value: `${name}.${p.name}`,
      label: `${pretty(name)}${colon()} ${p.label}`,
      p,
      now: item.values[p.name],
    }));

/** Units with their results, then streams with their figures; a stream goes by the outlet it leaves, which keeps its name. */
function places(form) {
  const units = Object.entries(form.units)
    .filter(([, unit]) => unit.figures?.length)
    .map(([name, unit]) => ({ value: name, label: pretty(name), figures: unit.figures }));
  const streams = Object.entries(form.units).flatMap(([name, unit]) =>
    unit.outlets.map((o) => ({
      value: `${name}.${o.port}`,
      label: pretty(o.stream) === pretty(`${name}.${o.port}`) || o.stream.includes('.') ? `${pretty(name)} · ${o.label}` : pretty(o.stream),
      names: [o.stream],
      figures: form.stream_figures,
    })),
  );
  return { units, streams };
}

function told(all, path) {
  for (const place of all)
    for (const name of [place.value, ...(place.names || [])])
      for (const p of place.figures)
        if (path === `${name}.${p.name}`) return `${place.label}${colon()} ${p.label}`;
  return pretty(path);
}

export function Specifications({ form, build }) {
  const inputs = sought(form);
  const { units, streams } = places(form);
  const all = [...units, ...streams];
  const [draft, setDraft] = useState(NOTHING);
  const set = (part) => setDraft((before) => ({ ...before, ...part }));
  const input = inputs.find((one) => one.value === draft.vary);
  const place = all.find((one) => one.value === draft.of);
  const figure = place?.figures.find((p) => p.name === draft.so_that);
  const option = (one, value) =>
    html`<option value=${one.value} selected=${one.value === value}>${one.label}</option>`;
  const menu = (id, text, value, pick, inside) =>
    html`<label class="end" for=${id}><span>${text}</span><select id=${id} value=${value} onChange=${(e) => pick(e.target.value)}><option value="">—</option>${inside}</select></label>`;
  const amount = (id, text, p, word) =>
    html`<div class="end"><label for=${id}>${text}</label><div class="entry"><${Quantity} key=${id + p.name} p=${{ ...p, name: word }} id=${id} text=${draft[word]} label=${text} onChange=${(value) => set({ [word]: value })} /></div></div>`;
  const whole = input && figure && draft.equals && draft.lower && draft.upper;
  const [adding, setAdding] = useState(false);
  const add = async () => {
    const { vary, of, so_that, equals, lower, upper } = draft;
    setAdding(true);
    const made = await build('set_specification', { vary, so_that: `${of}.${so_that}`, equals, lower, upper });
    setAdding(false);
    if (made) setDraft((before) => (before.vary === vary && before.of === of ? NOTHING : before));
  };
  return html`<details data-specifications><summary>${t('Design specifications')} <span class="dim">${Object.keys(form.specifications).length || ''}</span></summary>
    ${Object.entries(form.specifications).map(
      ([name, spec]) =>
        html`<p class="small" data-specification=${name}>${t('{input} is sought so that {figure} is {value}', { input: inputs.find((one) => one.value === spec.vary)?.label || pretty(spec.vary), figure: told(all, spec.so_that), value: spec.shown.equals })} <span class="dim">(${spec.shown.lower} … ${spec.shown.upper})</span> <button class="button" onClick=${() => build('remove_specification', { name })}>${t('Remove')}</button></p>`,
    )}
    <div class="ports">${menu(
      'spec-vary',
      t('sought'),
      draft.vary,
      (value) => set({ vary: value, lower: '', upper: '' }),
      inputs.map((one) => option(one, draft.vary)),
    )}
    ${menu('spec-of', t('so that, in'), draft.of, (value) => set({ of: value, so_that: '', equals: '' }), html`<optgroup label=${t('Equipment')}>${units.map((one) => option(one, draft.of))}</optgroup><optgroup label=${t('Streams')}>${streams.map((one) => option(one, draft.of))}</optgroup>`)}
    ${
      place &&
      menu(
        'spec-figure',
        t('this figure'),
        draft.so_that,
        (value) => set({ so_that: value, equals: '' }),
        place.figures.map((p) => option({ value: p.name, label: p.label }, draft.so_that)),
      )
    }
    ${figure && amount('spec-equals', t('takes the value'), figure, 'equals')}
    ${input && html`${amount('spec-lower', t('looked for from'), input.p, 'lower')}${amount('spec-upper', t('up to'), input.p, 'upper')}<p class="small dim">${t('now {value}', { value: readable(input.now, input.p) })}</p>`}
    <button class="button" disabled=${!whole || adding} onClick=${add}>${t('Add the specification')}</button></div></details>`;
}
