// The left column: search, grouped by domain.
import { html, t, ask, link, useAnswer, useState, settings } from './core.js';

export function useCards(sorts) {
  const { data } = useAnswer(() => ask('/api/cards'), [settings.language], 0);
  return data ? data.cards.filter((c) => sorts.includes(c.sort)) : null;
}

export function Finder({ page, current, cards }) {
  const [word, setWord] = useState('');
  if (!cards) return html`<section class="find" aria-busy="true"><p class="dim">${t('Loading…')}</p></section>`;
  const needle = word.toLowerCase();
  const found = cards.filter((c) => `${c.card} ${c.title} ${c.summary}`.toLowerCase().includes(needle));
  const groups = Map.groupBy ? Map.groupBy(found, (c) => c.domain) : found.reduce((m, c) => m.set(c.domain, [...(m.get(c.domain) || []), c]), new Map());
  return html`<section class="find" aria-label=${t('Find')}>
    <input type="search" aria-label=${t('Search cards')} placeholder=${t('Search {count} cards…', { count: cards.length })} value=${word} onInput=${(e) => setWord(e.target.value)} />
    <div class="scroll">${[...groups].map(([domain, list]) => html`<details open=${needle !== '' || (current || '').startsWith(domain + '.')} key=${domain + (needle !== '')}>
      <summary>${t(domain)} <span class="dim">${list.length}</span></summary>
      <ul>${list.map((c) => html`<li><a href=${link(page, c.card)} aria-current=${c.card === current ? 'page' : null} title=${c.summary}>${c.title}</a></li>`)}</ul></details>`)}
    ${found.length === 0 && html`<p class="dim">${t('Nothing found.')}</p>`}</div></section>`;
}
