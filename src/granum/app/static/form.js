// A form made from a card: one field per parameter, with units, limits and range of the source beside it.
import { html, t, settings } from './core.js';

const NUMBER = /^\s*([-+]?[\d.,]+(?:[eE][-+]?\d+)?)\s*(.*)$/;
const joined = ({ number, unit }) => `${number} ${unit}`.trim();
const inLanguage = (text) => (settings.language === 'fr' ? text.replace('.', ',') : text);

/** What a field holds is text with its unit, such as "85 um"; number and unit are split for display. */
function split(text, p) {
  const usual = p.default_shown?.unit || p.example?.unit || p.units?.[0]?.unit || '';
  const found = NUMBER.exec(text || '');
  return found ? { number: found[1], unit: found[2] || p.unit || '' } : { number: text || '', unit: usual };
}

export function Field({ parameter: p, text, onChange, problem }) {
  const id = `field-${p.name}`;
  const note = `${id}-note`;
  const Entry = text?.startsWith('{') && p.law ? LawTable : p.options?.length ? Choice : p.kind && p.series ? Series : p.kind ? Quantity : Text;
  return html`<div class="field"><label for=${id}>${p.label} <span class="symbol" dangerouslySetInnerHTML=${{ __html: p.symbol_shown || '' }} />${!p.required && html` <span class="small dim">${t('optional')}</span>`}</label>
    <div class="entry"><${Entry} p=${p} id=${id} note=${note} text=${text} onChange=${onChange} problem=${problem} /></div>
    <div class="note small dim" id=${note}>${[p.allowed, p.source_range && `${t('source covers')} ${p.source_range}`].filter(Boolean).join(' · ')}
    ${problem && html`<div class="out">${problem}</div>`}</div></div>`;
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

function Quantity({ p, id, note, text, onChange, problem }) {
  const parts = split(text, p);
  const units = p.units || [];
  const type = (typed) => {
    const clean = typed.trim().replace(/^([-+]?\d*),(\d*)/, '$1.$2');
    const found = NUMBER.exec(clean);
    onChange(clean === '' ? '' : found && found[2] ? clean : joined({ number: clean, unit: parts.unit }));
  };
  const bare = units.length === 0 || (units.length === 1 && units[0].label === '');
  return html`<input id=${id} type="text" inputmode="decimal" autocomplete="off" value=${inLanguage(parts.number)} placeholder=${p.default_shown ? inLanguage(p.default_shown.number) : ''}
      aria-describedby=${note} aria-invalid=${problem ? 'true' : 'false'} onInput=${(e) => type(e.target.value)} />
    ${!bare && html`<select aria-label=${t('Unit of {name}', { name: p.label })} value=${parts.unit} onChange=${(e) => parts.number !== '' && onChange(joined({ number: parts.number, unit: e.target.value }))}>
      ${parts.unit && !units.some((u) => u.unit === parts.unit) && html`<option value=${parts.unit} selected>${parts.unit}</option>`}
      ${units.map((u) => { const unit = u.unit === 'dimensionless' ? '' : u.unit; return html`<option value=${unit} selected=${unit === parts.unit}>${u.label || '1'}</option>`; })}</select>`}`;
}

function Series({ p, id, note, text, onChange, problem }) {
  const hint = p.example ? joined(p.example) : `1 2 3 ${p.units?.[0]?.unit === 'dimensionless' ? '' : p.units?.[0]?.unit || ''}`.trim();
  return html`<input id=${id} type="text" autocomplete="off" value=${text || ''} placeholder=${p.default_shown ? joined(p.default_shown) : hint} aria-describedby=${note} aria-invalid=${problem ? 'true' : 'false'} onInput=${(e) => onChange(e.target.value)} />`;
}

function Text({ p, id, note, text, onChange, problem }) {
  return html`<input id=${id} type="text" value=${text || ''} placeholder=${p.default_shown?.number ?? ''} aria-describedby=${note} aria-invalid=${problem ? 'true' : 'false'} onInput=${(e) => onChange(e.target.value)} />`;
}

/** The card's own example, so that it shows a result when it is opened. */
export function ordinary(card) {
  return Object.fromEntries(card.parameters.filter((p) => p.example).map((p) => [p.name, joined(p.example)]));
}
