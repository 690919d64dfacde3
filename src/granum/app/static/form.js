// A form made from a card: one field per parameter, with units, limits and range of the source beside it.
import { html, t, useState, useRef } from './core.js';
import { Quantity, inLanguage, joined } from './quantity.js';

export function Field({ parameter: p, text, onChange, problem, option = '', id = `field-${p.name}`, aside = '' }) {
  const tables = useRef({}); // parameters typed for a law that another one took the place of
  const note = `${id}-note`;
  const Entry =
    text?.startsWith('{') && p.law ? LawTable : p.options?.length ? Choice : p.kind ? Quantity : Text;
  const range = p.source_range && `${t('source covers')} ${p.source_range}`;
  return html`<div class=${`field${problem ? ' wrong' : ''}${p.series || p.gives || (p.law && Entry === LawTable) ? ' long' : ''}`}><div class="head"><label for=${id}>${p.label} <span class="symbol" dangerouslySetInnerHTML=${{ __html: p.symbol_shown || '' }} />${!p.required && html` <span class="small dim optional">${t('optional')}</span>`}</label>${aside}</div>
    <div class="entry"><${Entry} p=${p} id=${id} note=${note} text=${text} onChange=${onChange} problem=${problem} option=${option} tables=${tables.current} /></div>
    <div class="note small dim" id=${note}>${p.allowed && html`<span class=${p.gives ? '' : 'bounds'}>${p.allowed}</span>`}${p.allowed && range && html`<span class="bounds"> · </span>`}${range}
    ${problem && !p.kind && !(Entry === LawTable && holds(asTable(text), option)) && html`<div class="out">${problem}</div>`}</div></div>`;
}

/** The fields of a card: what must be given and what it is about in front, what may be left out folded; a field does not move while it is filled. */
export function Fields({ card, all, values, onChange, wrong, error, aside }) {
  const [folded] = useState(() => {
    const some = card.sort !== 'chart' && all.some((p) => p.required);
    return new Set(
      all.filter((p) => some && !p.required && !p.gives && !p.law && !values[p.name]).map((p) => p.name),
    );
  });
  const [open, setOpen] = useState(false);
  const field = (p) =>
    html`<${Field} key=${p.name} parameter=${p} text=${values[p.name]} onChange=${(text, understood) => onChange(p, text, understood)} problem=${wrong === p ? error : ''} aside=${aside?.(p)} />`;
  const rest = all.filter((p) => folded.has(p.name));
  return html`<div class="fields">${all.filter((p) => !folded.has(p.name)).map(field)}</div>
    ${rest.length > 0 && html`<details class="more" open=${open || rest.includes(wrong)} onToggle=${(e) => setOpen(e.target.open)}><summary>${t('More ({count})', { count: rest.length })}</summary><div class="fields">${rest.map(field)}</div></details>`}`;
}

function Choice({ p, id, note, text, onChange, problem = '', tables = {} }) {
  const word = text || (p.required ? '' : (p.default_shown?.number ?? ''));
  const shown = p.law && word !== '' ? named(p, word) : word;
  const open = p.required || p.default === null;
  const known = shown === '' || p.options.some((o) => o.value === shown);
  return html`<select id=${id} class="alone" value=${shown} aria-describedby=${note} aria-invalid=${problem ? 'true' : 'false'} onChange=${(e) => onChange(meant(p, e.target.value, text, tables))}>
    ${(open || shown === '') && html`<option value="">—</option>`}${!known && html`<option value=${shown} selected>${shown.replaceAll('_', ' ')}</option>`}
    ${p.options.map((o) => html`<option value=${o.value} selected=${o.value === shown}>${o.label}</option>`)}</select>`;
}

/**
 * A word as it is; a law that has parameters with those that were typed for it before, else with what it shares with the law before
 * it, and for the rest those of its example.
 */
function meant(p, word, text, tables) {
  const before = asTable(text);
  if (before) tables[before.law] = before;
  const table = asTable(p.options.find((o) => o.value === word)?.table);
  if (!table) return word;
  const has = (name) => name in table || name in (p.laws?.[word]?.parameters || {});
  const shared = Object.entries(before || {}).filter(([name]) => name !== 'law' && has(name));
  return JSON.stringify({ ...table, ...tables[word], ...Object.fromEntries(shared), law: table.law });
}
/** The table of a law with parameters, from its text; null where it is none. */
export function asTable(text) {
  try {
    const table = text?.startsWith('{') ? JSON.parse(text) : null;
    return table && typeof table === 'object' ? table : null;
  } catch {
    return null; // shown as text
  }
}
/** Whether a law with parameters, or one inside it, has a parameter of this name. */
export const holds = (table, option) =>
  table !== null && typeof table === 'object' && (option in table || Object.values(table).some((inner) => holds(inner, option)));

/** A law with its own parameters: the law as a choice, its parameters as fields; quantities with their units. */
function LawTable({ p, id, note, text, onChange, problem = '', option = '', tables = {} }) {
  const table = asTable(text);
  if (!table)
    return html`<input id=${id} value=${text} aria-describedby=${note} onInput=${(e) => onChange(e.target.value)} />`;
  const law = p.laws?.[table.law];
  const options = p.options.some((o) => o.value === table.law)
    ? p.options
    : [{ value: table.law, label: law?.title || String(table.law).replaceAll('_', ' ') }, ...p.options];
  const set = (name, value) => onChange(JSON.stringify({ ...table, [name]: value }));
  return html`<div class="law"><select id=${id} class="alone" value=${table.law} aria-describedby=${note} aria-invalid=${problem && !holds(table, option) ? 'true' : 'false'} onChange=${(e) => onChange(meant(p, e.target.value, text, tables))}>${options.map((o) => html`<option value=${o.value} selected=${o.value === table.law}>${o.label}</option>`)}</select>
    ${Object.entries(table)
      .filter(([name]) => name !== 'law')
      .map(([name, value]) => {
        const declared = law?.parameters[name];
        const at = Boolean(problem) && option === name;
        const q = declared && { ...declared, ...p.families?.[declared.law], families: p.families };
        return html`<div class="small given" key=${`${table.law} ${name}`} data-option=${name}><label for=${`${id}-${name}`}>${q?.label || name.replaceAll('_', ' ')}</label>
        ${
          q?.options?.length || (q?.law && value?.law)
            ? html`<${value?.law ? LawTable : Choice} p=${q} id=${`${id}-${name}`} note=${note} text=${value?.law ? JSON.stringify(value) : q.law ? named(q, value) : String(value)} onChange=${(next) => set(name, table_of(next))} problem=${at || holds(value, option) ? problem : ''} option=${at ? '' : option} tables=${(tables[' ' + name] ||= {})} />`
            : q?.kind && isQuantity(value)
              ? html`<${Quantity} p=${q} id=${`${id}-${name}`} note=${note} text=${[value].flat().map(brief).join('; ')} onChange=${(next) => set(name, bare(next, value))} problem=${at ? problem : ''} />`
              : html`<${Plain} id=${`${id}-${name}`} value=${value} onChange=${(next) => set(name, next)} wrong=${at} />`
        }${at && !(q?.kind && isQuantity(value)) && html`<div class="out small told" role="status">${problem}</div>`}</div>`;
      })}</div>`;
}

/** The option that a word means: a law may be called without the name of its family, or the other way round. */
const named = (p, word) =>
  p.options.find((o) => o.value === word || o.value === `${p.law}_${word}`)?.value ?? String(word);
/** A law with parameters stands as a table in another. */
const table_of = (text) => (text.startsWith('{') ? JSON.parse(text) : text);
/** A number with its power of ten where it would be a row of zeros. */
const brief = (x) =>
  typeof x === 'number' && x !== 0 && (Math.abs(x) < 1e-3 || Math.abs(x) >= 1e6)
    ? x.toExponential().replace('e+', 'e')
    : String(x);
const isQuantity = (value) => [value].flat().every((x) => typeof x === 'number' || typeof x === 'string');
const plain = (value) =>
  typeof value === 'string'
    ? value
    : typeof value === 'number'
      ? inLanguage(String(value))
      : JSON.stringify(value);
/** A number stays a number where nothing but a number was typed. */
const bare = (text, before) =>
  typeof before === 'number' && text.trim() !== '' && Number.isFinite(Number(text)) ? Number(text) : text;

/** An option that is no quantity: a name, a number without a unit, a list. The text is that of the person who types it. */
function Plain({ id, value, onChange, wrong }) {
  const [before] = useState(value);
  const [typed, setTyped] = useState(null);
  const take = (text) => {
    setTyped(text);
    onChange(read(text, before));
  };
  return html`<input id=${id} aria-invalid=${wrong ? 'true' : 'false'} value=${typed ?? plain(value)} onInput=${(e) => take(e.target.value)} onBlur=${() => setTyped(null)} />`;
}

/** What is typed for an option that is no quantity; a comma is that of a number only in a number. */
function read(typed, before) {
  const clean = typeof before === 'number' ? typed.replace(/^([-+]?\d*),(\d*)$/, '$1.$2') : typed;
  if (!clean.trim().startsWith('[')) return bare(clean, before);
  try {
    return JSON.parse(clean);
  } catch {
    return clean;
  }
}

function Text({ p, id, note, text, onChange, problem }) {
  const [touched, setTouched] = useState(false);
  const wrong = problem || !touched ? '' : notWhole(p, text || '');
  const list = p.suggested?.length ? `${id}-list` : null;
  return html`<input id=${id} type="text" value=${text || ''} list=${list} placeholder=${p.default_shown?.number ?? ''} aria-describedby=${note} aria-invalid=${problem || wrong ? 'true' : 'false'} onInput=${(e) => {
      setTouched(true);
      onChange(e.target.value);
    }} />
    ${list && html`<datalist id=${list}>${p.suggested.map((one) => html`<option value=${one.value}>${one.label}</option>`)}</datalist>`}
    ${wrong && html`<div class="out small told" role="status">${wrong}</div>`}`;
}

/** What a text that is typed for a count lacks; empty where it may stand. */
function notWhole(p, text) {
  if (p.sort !== 'int' || text.trim() === '') return '';
  const number = Number(text.trim().replace(/[−–]/, '-'));
  const beyond = (p.lower ?? -Infinity) > number || number > (p.upper ?? Infinity);
  if (Number.isInteger(number) && !beyond) return '';
  return p.allowed ? t('A whole number is needed: {allowed}.', { allowed: p.allowed }) : t('A whole number is needed.');
}

/** Fields of a card: where it asks for properties of a fluid, that fluid in words before the first of them. */
export const fields = (card, parameters) =>
  parameters.flatMap((p) => (p.name === card.fluid?.gives[0] ? [card.fluid, p] : [p]));

/** Values after a field was changed; a fluid stands in place of its properties. */
export function changed(values, p, text) {
  const gone = p.gives && text.trim() ? p.gives : [];
  return Object.fromEntries([
    ...Object.entries(values).filter(([name]) => !gone.includes(name)),
    [p.name, text],
  ]);
}

/** What must still be given. */
export const missingOf = (card, parameters, values) =>
  parameters.filter(
    (p) => p.required && !values[p.name] && !(values.fluid?.trim() && card.fluid?.gives.includes(p.name)),
  );

/** The card's own example, so that it shows a result when it is opened. */
export function ordinary(card) {
  return Object.fromEntries(card.parameters.filter((p) => p.example).map((p) => [p.name, joined(p.example)]));
}
