// The left column: cards grouped by domain in the order of the house, laws of one family together; its own search is the one of every page.
import { Awaited, html, t, ask, link, useAnswer, useState, useEffect, useRef, settings } from './core.js';
import { english } from './strings.fr.js';

const MANY = 3; // members from which a family is folded
export const order = Object.keys(english);
const lists = new Map();

/** All cards in the language of the page, fetched once. */
function listed() {
  const { language } = settings;
  if (!lists.has(language))
    lists.set(
      language,
      ask('/api/cards').catch((problem) => {
        lists.delete(language);
        throw problem;
      }),
    );
  return lists.get(language);
}

const everything = () => true;

export function useCards(keep = everything) {
  const { data } = useAnswer(listed, [settings.language], 0);
  return data ? data.cards.filter(keep) : null;
}

/** What stands where a link leads to no card: why, and the way to the one that may be meant. */
export function NoCard({ heading, error }) {
  const meant = useCards()?.find((c) => c.card === error.details?.did_you_mean);
  return html`<section aria-label=${t('Enter')}><h1>${heading}</h1><p class="message out" role="alert">${error.message}</p>
    ${meant && html`<p>${t('Open')} <a href=${link('find', meant.card)}>${meant.title}</a></p>`}</section><section />`;
}

/** Entries of a domain: the equipment as a group, then single cards and families of laws in the order of their titles. */
export function entriesOf(cards) {
  const families = new Map();
  for (const c of cards) {
    const name = c.sort === 'equipment' ? 'equipment' : c.family && `family ${c.family}`;
    if (name) families.set(name, [...(families.get(name) || []), c]);
  }
  const folded = [...families].filter(([name, list]) => name === 'equipment' || list.length >= MANY);
  const inside = new Set(folded.flatMap(([, list]) => list));
  const groups = folded.map(([name, list]) => ({
    name,
    list,
    title:
      name === 'equipment'
        ? t('Equipment – {count}', { count: list.length })
        : t('{family} – {count} laws', { family: list[0].family_title, count: list.length }),
  }));
  const single = cards.filter((c) => !inside.has(c)).map((c) => ({ card: c, title: c.title }));
  const first = (entry) => (entry.name === 'equipment' ? 0 : 1);
  return [...groups, ...single].sort(
    (a, b) => first(a) - first(b) || a.title.localeCompare(b.title, settings.language),
  );
}

export function Finder({ page, current, cards }) {
  const [word, setWord] = useState('');
  const asked = word.trim();
  const found = useAnswer(
    (signal) =>
      asked
        ? ask(`/api/cards?word=${encodeURIComponent(asked)}`, undefined, { signal })
        : Promise.resolve(null),
    [asked, settings.language],
  );
  const list = useRef(null);
  useEffect(() => {
    oneStop(list.current);
    list.current?.querySelector('[aria-current]')?.scrollIntoView({ block: 'nearest' });
  }, [current, Boolean(cards)]);
  useEffect(() => oneStop(list.current));
  if (!cards)
    return html`<section class="find" aria-label=${t('Find')}><${Awaited} text=${t('The list of cards is on its way…')} /></section>`;
  const here = new Set(cards.map((c) => c.card));
  const hits = asked && found.data ? found.data.cards.filter((c) => here.has(c.card)) : null;
  return html`<section class="find" aria-label=${t('Find')}>
    <input type="search" aria-label=${t('Search cards')} placeholder=${t('Search {count} cards…', { count: cards.length })} value=${word} onInput=${(e) => setWord(e.target.value)} onKeyDown=${(
      e,
    ) => {
      if (e.key !== 'ArrowDown') return;
      e.preventDefault();
      visible(list.current)[0]?.focus();
    }} />
    <nav class="scroll" ref=${list} aria-label=${t('Cards found')} onKeyDown=${walk} onfocusin=${(e) => oneStop(list.current, e.target)}>
      ${asked ? hits && html`<ul>${hits.map((c) => html`<${Item} key=${c.card} page=${page} card=${c} current=${current} />`)}</ul>` : html`<${Tree} page=${page} cards=${cards} current=${current} />`}
      ${hits?.length === 0 && !found.pending && html`<p class="dim">${t('Nothing found.')}</p>`}</nav></section>`;
}

function Tree({ page, cards, current }) {
  const groups = new Map(order.map((domain) => [domain, []]));
  cards.forEach((c) => groups.get(c.domain)?.push(c) ?? groups.set(c.domain, [c]));
  const few = cards.length <= 40;
  return [...groups]
    .filter(([, list]) => list.length)
    .map(
      ([domain, list]) => html`<${Fold} key=${domain} open=${few || (current || '').startsWith(domain + '.')} title=${html`${t(domain)} <span class="dim">${list.length}</span>`} inside=${() =>
        (few ? list.map((card) => ({ card })) : entriesOf(list)).map((entry) =>
          entry.card
            ? html`<${Item} key=${entry.card.card} page=${page} card=${entry.card} current=${current} />`
            : html`<li key=${entry.name}><${Fold} sort="family" open=${entry.list.some((c) => c.card === current)} title=${entry.title} inside=${() =>
                entry.list.map((c) => html`<${Item} key=${c.card} page=${page} card=${c} current=${current} family=${c.family_title} />`)} /></li>`,
        )} />`,
    );
}

/** A group of the list; what is in it is made when it is opened first: a thousand links that nobody sees make every page slow. */
function Fold({ sort = null, open, title, inside }) {
  const [seen, setSeen] = useState(open);
  return html`<details class=${sort} open=${open} onToggle=${(e) => e.currentTarget.open && setSeen(true)}><summary>${title}</summary>${(seen || open) && html`<ul>${inside()}</ul>`}</details>`;
}

/** A card in the list; in a family what tells it from the others, its whole title for who hears it. */
function Item({ page, card: c, current, family = '' }) {
  const own = family && c.title.startsWith(`${family} (`) && c.title.endsWith(')');
  const shown = own ? html`<span class="spoken">${family} </span>${c.title.slice(family.length + 2, -1)}` : c.title;
  return html`<li><a href=${link(page, c.card)} aria-current=${c.card === current ? 'page' : null} title=${own ? `${c.title}\u2002·\u2002${c.summary}` : c.summary}>${shown}</a></li>`;
}

// ---- one tab stop, arrow keys inside ----------------------------------------------------------------
const visible = (list) =>
  [...(list?.querySelectorAll('summary, a') || [])].filter((e) => e.checkVisibility());

/** Only one entry is reached by Tab: the one that has the focus, else the open card, else the first. */
function oneStop(list, wanted) {
  if (!list) return;
  const all = [...list.querySelectorAll('summary, a')];
  const stop =
    (wanted && all.includes(wanted) && wanted) ||
    all.find((e) => e === document.activeElement) ||
    all.find((e) => e.hasAttribute('aria-current') && e.checkVisibility()) ||
    all[0];
  all.forEach((e) => {
    e.tabIndex = e === stop ? 0 : -1;
  });
}

function walk(e) {
  const list = visible(e.currentTarget);
  const at = list.indexOf(e.target);
  if (at < 0) return;
  const details = e.target.matches('summary') && e.target.parentElement;
  const above = e.target.parentElement.closest('details')?.parentElement?.closest('details');
  const parent = (details ? above : e.target.closest('details'))?.querySelector('summary');
  const next = {
    ArrowDown: () => list[at + 1],
    ArrowUp: () => list[at - 1] || e.currentTarget.parentElement.querySelector('input'),
    Home: () => list[0],
    End: () => list.at(-1),
    ArrowRight: () => {
      if (!details) return null;
      if (details.open) return list[at + 1];
      details.open = true;
      return e.target;
    },
    ArrowLeft: () => {
      if (details?.open) {
        details.open = false;
        return e.target;
      }
      return parent;
    },
  }[e.key];
  if (!next) return;
  e.preventDefault();
  next()?.focus();
}
