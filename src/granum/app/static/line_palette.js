// The equipment to choose from, by domain, with its symbols; found by its names in either language.
import { Awaited, html, t, ask, settings, useAnswer, useState, useEffect, useRef } from './core.js';
import { english } from './strings.fr.js';

const kept = {};
const plain = (text) =>
  text
    .normalize('NFD')
    .replace(/[\u0300-\u036f]/g, '')
    .toLowerCase();

const MOST = 8; // pieces that only the search finds: by synonyms, and in spite of a typing error
/** Equipment that words mean, the best first, as the search over everything has it; the most usual for an everyday word. */
function useRanked(word) {
  const { data, error, pending } = useAnswer(
    (signal) => (word ? ask(`/api/cards?sort=equipment&word=${encodeURIComponent(word)}`, undefined, { signal }) : Promise.resolve(null)),
    [word],
  );
  const known = Boolean(word && data);
  return {
    ranked: known ? data.cards.map((c) => c.card) : [],
    usual: known ? data.usual : [],
    waits: pending && !error,
  };
}

export function Palette({ origin, pick, close }) {
  const [list, setList] = useState(kept[settings.language] || null);
  const [word, setWord] = useState('');
  const [entered, setEntered] = useState('');
  const field = useRef(null);
  useEffect(() => {
    const language = settings.language;
    if (!kept[language]) ask('/api/palette').then((found) => setList((kept[language] = found.equipment)));
    field.current?.focus();
  }, []);
  const words = plain(word).split(/\s+/).filter(Boolean);
  const { ranked, usual, waits } = useRanked(word.trim());
  const has = (e) => {
    const text = plain(`${e.title} ${e.other_names} ${e.model.replaceAll('_', ' ')} ${e.summary}`);
    return words.every((w) => text.includes(w));
  };
  /** How many of the words do not stand in the title: "continu" is also in "discontinu". */
  const far = (e) => words.filter((w) => !` ${plain(e.title)}`.includes(` ${w}`)).length;
  const first = (e) => (usual.includes(e.model) ? usual.indexOf(e.model) : usual.length);
  const place = (e) => (ranked.includes(e.model) ? ranked.indexOf(e.model) : ranked.length);
  // of what the search alone knows, what it ranks before the last piece that has the words, or the first few
  const named = (list || []).filter(has);
  const last = named.length ? Math.max(...named.map(place)) : MOST;
  const found = (list || [])
    .filter((e) => has(e) || usual.includes(e.model) || (place(e) < last && place(e) < ranked.length))
    // what one stream is enough for comes before what needs another one first; of titles with all the words the
    // shortest is the most general
    .toSorted(
      (one, other) =>
        first(one) - first(other) ||
        far(one) - far(other) ||
        one.joins - other.joins ||
        (far(one) ? 0 : one.title.length - other.title.length) ||
        place(one) - place(other),
    );
  useEffect(() => {
    // pressed before the search has answered, Enter waits for what it finds
    if (entered && entered === word && found.length && !waits) pick(found[0].model);
  }, [entered, word, found.length, waits]);
  const domains = Object.keys(english).filter((domain) => found.some((e) => e.domain === domain));
  const pieces = (some) =>
    html`<div class="shelf">${some.map(
      (e) =>
        html`<button class="piece" data-model=${e.model} title=${e.summary} onClick=${() => pick(e.model)}><svg viewBox="0 0 60 60" width="40" height="40" aria-hidden="true" class="symbol" dangerouslySetInnerHTML=${{ __html: e.symbol }} /><span>${e.title}</span></button>`,
    )}</div>`;
  return html`<section class="card palette" data-palette aria-label=${t('Add equipment')} onKeyDown=${(e) => e.key === 'Escape' && close()}><div class="row spread"><h2 class="first">${origin ? t('Equipment for {origin}', { origin }) : t('Add equipment')}</h2><button class="button" onClick=${close}>${t('Close')}</button></div>
    <input type="search" ref=${field} aria-label=${t('Search equipment')} placeholder=${t('filter, dryer, cyclone…')} value=${word} onInput=${(e) => setWord(e.target.value)} onKeyDown=${(
      e,
    ) => {
      if (e.key === 'Enter') setEntered(word);
    }} />
    ${!list && html`<${Awaited} text=${t('The list of equipment is on its way…')} />`}
    <div class="shelves">${words.length ? pieces(found) : domains.map((domain) => html`<div key=${domain}><h3>${t(domain)}</h3>${pieces(found.filter((e) => e.domain === domain))}</div>`)}</div>
    ${list && found.length === 0 && html`<p class="dim">${t('Nothing found.')}</p>`}</section>`;
}
