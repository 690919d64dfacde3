// A new line: its title, what enters it, of which substances.
import { html, t, ask, settings, useState, useEffect } from './core.js';

const lists = {};
/** What a line can be made of, asked for once per language. */
export function useSubstances() {
  const [known, setKnown] = useState(lists[settings.language] || null);
  useEffect(() => {
    const language = settings.language;
    lists[language]
      ? setKnown(lists[language])
      : ask('/api/substances').then((found) => setKnown((lists[language] = found)));
  }, [settings.language]);
  return known;
}
export const named = (known, name) =>
  Object.values(known || {})
    .flat()
    .find((row) => row.value === name)?.label || name;

const plain = (text) =>
  text
    .normalize('NFD')
    .replace(/[\u0300-\u036f]/g, '')
    .trim()
    .toLowerCase();

/** One of a list, searched by typing; what is not in the list is handed on as it was typed. */
export function Choice({ id, label, rows, value, pick, quiet }) {
  const shown = rows.find((row) => row.value === value)?.label ?? value;
  const [typed, setTyped] = useState(null);
  useEffect(() => setTyped(null), [value]);
  const settle = (text) => {
    const found = rows.find((row) => plain(row.label) === plain(text) || plain(row.value) === plain(text));
    pick(found ? found.value : text.trim());
    setTyped(null);
  };
  const entry = html`<input id=${id} list=${id + '-list'} type="text" autocomplete="off" aria-label=${quiet ? label : null} placeholder=${quiet ? label : ''} value=${typed ?? shown} onFocus=${(e) => e.target.select()} onInput=${(
    e,
  ) => {
    setTyped(e.target.value);
    const whole = rows.find((row) => plain(row.label) === plain(e.target.value));
    if (
      whole &&
      e.inputType !== 'deleteContentBackward' &&
      !rows.some((row) => row !== whole && plain(row.label).startsWith(plain(e.target.value)))
    )
      pick(whole.value);
  }} onChange=${(e) => settle(e.target.value)} /><datalist id=${id + '-list'}>${rows.map((row) => html`<option value=${row.label}></option>`)}</datalist>`;
  return quiet ? entry : html`<label class="end" for=${id}><span>${label}</span>${entry}</label>`;
}

const BEGINNINGS = [
  ['solution', 'A solution to crystallize', ['liquid', 'solute']],
  ['suspension', 'A suspension', ['liquid', 'solid']],
  ['moist_solid', 'A moist solid to dry', ['solid', 'liquid', 'gas']],
  ['dusty_gas', 'A gas with dust', ['gas', 'solid']],
];

export function NewLine({ make, cancel }) {
  const known = useSubstances();
  const [values, setValues] = useState({
    title: '',
    enters: 'solution',
    liquid: 'water',
    solute: 'potassium nitrate',
    solid: 'quartz',
    gas: 'dry air',
  });
  const set = (name) => (value) => setValues((before) => ({ ...before, [name]: value }));
  const asked = BEGINNINGS.find(([name]) => name === values.enters)[2];
  const rows = known && {
    liquid: known.liquids,
    solute: known.solutes.filter((s) => s.solvent === values.liquid && s.complete),
    solid: known.solids,
    gas: known.gases,
  };
  const labels = { liquid: t('liquid'), solute: t('dissolved in it'), solid: t('solid'), gas: t('gas') };
  return html`<form class="card new" data-new aria-label=${t('New line')} onSubmit=${(e) => {
    e.preventDefault();
    make(values);
  }}><h2 class="first">${t('New line')}</h2>
    <label class="end" for="new-title"><span>${t('title')}</span><input id="new-title" type="text" required value=${values.title} placeholder=${t('Salt from brine')} onInput=${(e) => set('title')(e.target.value)} /></label>
    <fieldset><legend>${t('What enters')}</legend>${BEGINNINGS.map(([name, label]) => html`<label class="choice line"><input type="radio" name="enters" value=${name} checked=${values.enters === name} onChange=${() => set('enters')(name)} /> ${t(label)}</label>`)}</fieldset>
    ${rows && asked.map((name) => html`<${Choice} key=${name} id=${'new-' + name} label=${labels[name]} rows=${rows[name]} value=${values[name]} pick=${set(name)} />`)}
    <p class="small dim">${t('Amounts, temperature and sizes start from ordinary values; change them afterwards.')}</p>
    <div class="row"><button class="button main" type="submit" disabled=${!values.title.trim() || !known}>${t('Create the line')}</button><button class="button" type="button" onClick=${cancel}>${t('Cancel')}</button></div></form>`;
}
