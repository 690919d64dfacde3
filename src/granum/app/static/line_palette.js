// The equipment to choose from, by domain, with its symbols; found by its names in either language.
import { html, t, ask, settings, useState, useEffect, useRef } from './core.js';
import { english } from './strings.fr.js';

const kept = {};
const plain = (text) =>
  text
    .normalize('NFD')
    .replace(/[\u0300-\u036f]/g, '')
    .toLowerCase();

export function Palette({ origin, pick, close }) {
  const [list, setList] = useState(kept[settings.language] || null);
  const [word, setWord] = useState('');
  const field = useRef(null);
  useEffect(() => {
    const language = settings.language;
    if (!kept[language]) ask('/api/palette').then((found) => setList((kept[language] = found.equipment)));
    field.current?.focus();
  }, []);
  const words = plain(word).split(/\s+/).filter(Boolean);
  const inside = ({ title }) => words.filter((w) => !` ${plain(title)}`.includes(` ${w}`)).length; // "continu" in "discontinu"
  const found = (list || [])
    .filter((e) => {
      const text = plain(`${e.title} ${e.other_names} ${e.model.replaceAll('_', ' ')} ${e.summary}`);
      return words.every((w) => text.includes(w));
    })
    .toSorted((one, other) => inside(one) - inside(other));
  const domains = Object.keys(english).filter((domain) => found.some((e) => e.domain === domain));
  return html`<section class="card palette" data-palette aria-label=${t('Add equipment')} onKeyDown=${(e) => e.key === 'Escape' && close()}><div class="row spread"><h2 class="first">${origin ? t('Equipment for {origin}', { origin }) : t('Add equipment')}</h2><button class="button" onClick=${close}>${t('Close')}</button></div>
    <input type="search" ref=${field} aria-label=${t('Search equipment')} placeholder=${t('filter, dryer, cyclone…')} value=${word} onInput=${(e) => setWord(e.target.value)} onKeyDown=${(
      e,
    ) => {
      if (e.key === 'Enter' && found.length) pick(found[0].model);
    }} />
    ${!list && html`<p class="dim" aria-busy="true">${t('Loading…')}</p>`}
    <div class="shelves">${domains.map(
      (domain) =>
        html`<div key=${domain}><h3>${t(domain)}</h3><div class="shelf">${found
          .filter((e) => e.domain === domain)
          .map(
            (e) =>
              html`<button class="piece" data-model=${e.model} title=${e.summary} onClick=${() => pick(e.model)}><svg viewBox="0 0 60 60" width="40" height="40" aria-hidden="true" class="symbol" dangerouslySetInnerHTML=${{ __html: e.symbol }} /><span>${e.title}</span></button>`,
          )}</div></div>`,
    )}</div>
    ${list && found.length === 0 && html`<p class="dim">${t('Nothing found.')}</p>`}</section>`;
}
