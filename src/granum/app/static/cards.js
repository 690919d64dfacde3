// The left column: search, grouped by domain in the order of the house.
import { html, t, ask, link, useAnswer, useState, settings } from './core.js';
import { english } from './strings.fr.js';

export function useCards(keep) {
  const { data } = useAnswer(() => ask('/api/cards'), [settings.language, settings.units], 0);
  return data ? data.cards.filter(keep) : null;
}

const plain = (text) =>
  text
    .normalize('NFD')
    .replace(/[\u0300-\u036f]/g, '')
    .toLowerCase();
const order = Object.keys(english);

export function Finder({ page, current, cards }) {
  const [word, setWord] = useState('');
  if (!cards)
    return html`<section class="find" aria-busy="true" aria-label=${t('Find')}><p class="dim">${t('Loading…')}</p></section>`;
  const words = plain(word).split(/\s+/).filter(Boolean);
  const found = cards.filter((c) => {
    const text = plain(`${c.card.replaceAll('_', ' ')} ${c.card} ${c.title} ${c.summary} ${c.other_names}`);
    return words.every((w) => text.includes(w));
  });
  const groups = new Map(order.map((domain) => [domain, []]));
  found.forEach((c) => groups.get(c.domain)?.push(c) ?? groups.set(c.domain, [c]));
  const few = cards.length <= 40 || words.length > 0;
  return html`<section class="find" aria-label=${t('Find')}>
    <input type="search" aria-label=${t('Search cards')} placeholder=${t('Search {count} cards…', { count: cards.length })} value=${word} onInput=${(e) => setWord(e.target.value)} />
    <div class="scroll" tabindex="0" role="region" aria-label=${t('Cards found')}>${[...groups]
      .filter(([, list]) => list.length)
      .map(
        ([
          domain,
          list,
        ]) => html`<details open=${few || (current || '').startsWith(domain + '.')} key=${domain + few}>
      <summary>${t(domain)} <span class="dim">${list.length}</span></summary>
      <ul>${list.map((c) => html`<li><a href=${link(page, c.card)} aria-current=${c.card === current ? 'page' : null} title=${c.summary}>${c.title}</a></li>`)}</ul></details>`,
      )}
    ${found.length === 0 && html`<p class="dim">${t('Nothing found.')}</p>`}</div></section>`;
}
