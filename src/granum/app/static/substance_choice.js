// The substances of the library, and one of a list searched by typing.
import { html, ask, settings, useState, useEffect } from './core.js';

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

/** Whether a word of five letters or more is that of a substance but for its last two letters. */
const begins = (row, word) =>
  word.length >= 5 && [row.label, row.value].map(plain).some((name) => name.startsWith(word) && name.length <= word.length + 2);

/** One of a list, searched by typing; what is not in the list is handed on as it was typed. */
export function Choice({ id, label, rows, value, pick, quiet, problem = '' }) {
  const shown = rows.find((row) => row.value === value)?.label ?? value;
  const [typed, setTyped] = useState(null); // belongs to whoever types until the field is left
  const settle = (text) => {
    const whole = rows.find((row) => plain(row.label) === plain(text) || plain(row.value) === plain(text));
    const near = rows.filter((row) => begins(row, plain(text)));
    const found = whole ?? (near.length === 1 ? near[0] : null); // granit is granite, where nothing else begins so
    pick(found ? found.value : text.trim());
    setTyped(null);
  };
  const entry = html`<input id=${id} list=${id + '-list'} type="text" autocomplete="off" aria-label=${quiet ? label : null} placeholder=${quiet ? label : ''} aria-invalid=${problem ? 'true' : 'false'} aria-describedby=${problem ? id + '-told' : null} value=${typed ?? shown} onFocus=${(e) => e.target.select()} onInput=${(
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
  }} onChange=${(e) => settle(e.target.value)} onBlur=${() => setTyped(null)} /><datalist id=${id + '-list'}>${rows.map((row) => html`<option value=${row.label}></option>`)}</datalist>`;
  const told = problem && html`<div class="out small told" id=${id + '-told'} role="alert">${problem}</div>`;
  return quiet ? html`${entry}${told}` : html`<label class="end" for=${id}><span>${label}</span>${entry}</label>${told}`;
}
