// A form made from a card: one field per parameter, with units, limits and source of the default beside it.
import { html, t, number } from './core.js';

const inUnit = (value, unit) => (typeof value === 'number' ? `${Number(value.toPrecision(6))} ${unit}`.trim() : value);

/** What a field holds: text with its unit, such as "85 um"; number and unit are split for display. */
export function split(text, parameter) {
  const found = /^\s*([-+]?[\d.,]+(?:[eE][-+]?\d+)?)\s*(.*)$/.exec(text || '');
  const units = (parameter.units || []).map((u) => u.unit);
  if (!found) return { number: text || '', unit: units[0] || '' };
  return { number: found[1], unit: found[2] || parameter.unit || '' };
}

export function Field({ parameter: p, text, onChange, problem }) {
  const id = `field-${p.name}`;
  const note = `${id}-note`;
  const label = html`<label for=${id}>${p.label} <span class="dim" dangerouslySetInnerHTML=${{ __html: p.symbol_shown || '' }} /></label>`;
  let entry;
  if (p.choices) {
    const shown = text || (p.required ? '' : String(p.default ?? ''));
    entry = html`<select id=${id} class="alone" value=${shown} onChange=${(e) => onChange(e.target.value)}>
      ${(p.required || p.default === null) && html`<option value="">—</option>`}
      ${p.choices.map((c) => html`<option value=${c} selected=${c === shown}>${String(c).replaceAll('_', ' ')}</option>`)}</select>`;
  } else if (p.kind) {
    const parts = split(text, p);
    const units = p.units || [];
    const known = units.some((u) => u.unit === parts.unit);
    const hint = p.required || p.default === null || p.default === undefined ? '' : Array.isArray(p.default) ? p.default.join(' ') : number(p.default, 6);
    entry = html`<input id=${id} type="text" inputmode="decimal" autocomplete="off" value=${parts.number} placeholder=${hint}
        aria-describedby=${note} aria-invalid=${problem ? 'true' : 'false'}
        onInput=${(e) => onChange(/[a-zA-Zµ°%]/.test(e.target.value.replace(/[eE][-+]?\d+/, '')) ? e.target.value : e.target.value.trim() === '' ? '' : `${e.target.value} ${parts.unit}`.trim())} />
      ${units.length > 0 && !(units.length === 1 && units[0].label === '') && html`<select aria-label=${t('Unit of {name}', { name: p.label })} value=${parts.unit}
        onChange=${(e) => parts.number !== '' && onChange(`${parts.number} ${e.target.value}`)}>
        ${!known && parts.unit && html`<option value=${parts.unit} selected>${parts.unit}</option>`}
        ${units.map((u) => html`<option value=${u.unit} selected=${u.unit === parts.unit}>${u.label || '1'}</option>`)}</select>`}`;
  } else {
    entry = html`<input id=${id} type="text" value=${text || ''} placeholder=${p.required ? '' : String(p.default ?? '')} onInput=${(e) => onChange(e.target.value)} aria-describedby=${note} />`;
  }
  return html`<div class="field">${label}<div class="entry">${entry}</div>
    <div class="note small dim" id=${note}>${p.allowed && html`<span>${p.allowed}</span>`}${p.fitted && html`<span> · ${t('source covers')} ${p.fitted.map((x) => (x === null ? '∞' : number(x))).join(' … ')}</span>`}
    ${problem && html`<div class="out">${problem}</div>`}</div></div>`;
}

/** Ordinary values for the required fields, so that a card shows a result when it is opened. */
export function ordinary(card) {
  const values = {};
  for (const p of card.parameters) {
    if (!p.required || !p.kind) continue;
    if (p.series) continue;
    const [low, high] = p.typical;
    const middle = low > 0 ? Math.sqrt(low * high) : (low + high) / 2;
    const power = middle === 0 ? 1 : 10 ** Math.floor(Math.log10(Math.abs(middle)) - 1);
    values[p.name] = inUnit(Math.round(middle / power) * power, p.unit === 'dimensionless' ? '' : p.unit);
  }
  return values;
}
