// The start: tasks in words, what was open lately, and the domains with all they hold.
import { Awaited, html, t, link, settings } from './core.js';
import { entriesOf, order, useCards } from './cards.js';
import { hrefOf, placeOf } from './seek.js';
import { recent } from './recent.js';

const TASKS = [
  [
    'How fast does it settle?',
    'Terminal velocity of a particle in a fluid',
    'calculate',
    'particles.terminal_velocity',
  ],
  ['Size a thickener from a jar test', 'Settling curve to area', 'lab', 'settling.batch_test'],
  ['Size a filter from a leaf test', 'Filtrate over time to cake resistance', 'lab', 'filtration.leaf_test'],
  [
    'Filter, centrifuge or thickener?',
    'Which separator suits a suspension',
    'select',
    'filtration.separator_choice',
  ],
  [
    'A drum filter at work',
    'Capacity, washing and moisture of a machine',
    'calculate',
    'filtration.rotary_vacuum_drum',
  ],
  ['Dry a product: energy and air', 'Balance of a dryer', 'calculate', 'drying.dryer_balance'],
  ['Which dryer?', 'Dryers that suit a product, with reasons', 'select', 'drying.choose'],
  ['State of humid air', 'Psychrometric chart with your process', 'charts', 'humid_gas.psychrometric_chart'],
  [
    'Cyclones for a dust',
    'Diameter and number for a cut and a pressure drop',
    'calculate',
    'cyclones.cyclone_sizing',
  ],
  [
    'When does a bed fluidize?',
    'Minimum fluidization by every correlation',
    'calculate',
    'fluidization.minimum_fluidization_spread',
  ],
  ['Crystals from a cooling batch', 'Size and yield, seeded or not', 'calculate', 'crystallization.batch'],
  ['Sizes from a sieve analysis', 'Median, spread and means of a table', 'lab', 'particles.sieve_analysis'],
  ['Energy for grinding', 'Power of a mill by Bond', 'calculate', 'comminution.mill_power_bond'],
  [
    'Pressure drop of a bed of grains',
    'Packed bed by the usual laws',
    'calculate',
    'porous.pressure_drop_packed_bed',
  ],
  ['A whole process line', 'Streams, sizes, duties, report', 'lines', ''],
];
const SORTS = [
  ['equipment', 'Equipment'],
  ['procedure', 'Procedures'],
  ['formula', 'Formulas'],
  ['lab test', 'Lab tests'],
  ['chart', 'Charts'],
];

export function Home({ state }) {
  const cards = useCards();
  if (state.key) return html`<${Domain} domain=${state.key} cards=${cards} />`;
  const domains = order
    .map((domain) => [domain, (cards || []).filter((c) => c.domain === domain).length])
    .filter(([, count]) => count);
  const lately = recent(cards);
  return html`<main class="page home" id="main"><h1>${t('What do you want to know?')}</h1>
    <p class="dim">${t('Choose a task, or press / and type what you look for: a word, a symbol, an author.')}</p>
    <ul class="tiles" aria-label=${t('Tasks')}>${TASKS.map(
      ([title, note, page, key]) =>
        html`<li><a class="tile" href=${link(page, key)}><strong>${t(title)}</strong><span class="small dim">${t(note)}</span></a></li>`,
    )}</ul>
    ${lately.length > 0 && html`<h2>${t('Open lately')}</h2><ul class="plain" data-recent>${lately.map((one) => html`<li><a href=${one.hash}>${one.title}</a> <span class="small dim">${t(one.name)}</span></li>`)}</ul>`}
    <h2>${t('By domain')}</h2>
    <ul class="tiles small" aria-label=${t('By domain')} aria-busy=${String(!cards)}>${!cards && html`<li><${Awaited} text=${t('The list of cards is on its way…')} /></li>`}${domains.map(
      ([domain, count]) =>
        html`<li><a class="tile" href=${link('home', domain)}><strong>${t(domain)}</strong><span class="small dim">${t('{count} cards', { count })}</span></a></li>`,
    )}</ul></main>`;
}

/** All that a domain holds, by what it is. */
function Domain({ domain, cards }) {
  const own = (cards || [])
    .filter((c) => c.domain === domain)
    .toSorted((a, b) => a.title.localeCompare(b.title, settings.language));
  return html`<main class="page home" id="main" aria-busy=${String(!cards)}><p class="small"><a href=${link('home')}>${t('Start')}</a></p><h1>${t(domain)}</h1>${!cards && html`<${Awaited} text=${t('The list of cards is on its way…')} />`}
    ${cards && !own.length && html`<p class="message dim">${t('Nothing found.')}</p>`}
    ${SORTS.map(([sort, label]) => {
      const list = own.filter((c) => c.sort === sort);
      if (!list.length) return null;
      const entries = sort === 'formula' ? entriesOf(list) : list.map((card) => ({ card }));
      return html`<h2>${t(label)} <span class="dim">${list.length}</span></h2><ul class="plain several">${entries.map(
        (entry) =>
          entry.card
            ? html`<li key=${entry.card.card}><${Way} card=${entry.card} /></li>`
            : html`<li key=${entry.name}><details><summary>${entry.title}</summary><ul class="plain">${entry.list.map((c) => html`<li><${Way} card=${c} /></li>`)}</ul></details></li>`,
      )}</ul>`;
    })}</main>`;
}

const Way = ({ card: c }) =>
  html`<a href=${hrefOf({ sort: c.sort, key: c.card })} title=${c.summary}>${c.title}</a>`;

/** A card by its key alone, wherever it is shown. */
export function Forward({ state }) {
  const cards = useCards();
  const card = cards?.find((c) => c.card === state.key);
  if (card) {
    const { page, key } = placeOf({ sort: card.sort, key: card.card });
    setTimeout(() => location.replace(link(page, key)));
  }
  return html`<main class="page" id="main" aria-busy=${String(!cards || Boolean(card))}><h1>${t('Find')}</h1>${!cards && html`<${Awaited} text=${t('The list of cards is on its way…')} />`}${cards && !card && html`<p class="message dim">${t('Nothing found.')}</p>`}</main>`;
}
