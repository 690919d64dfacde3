// The shell: header, routing, language, theme.
import {
  html,
  render,
  t,
  ask,
  useState,
  useEffect,
  readLink,
  link,
  lastPlace,
  keepPlace,
  settings,
  keep,
  apply,
} from './core.js';
import { Calculate, isSelection } from './calculate.js';
import { Lab } from './lab.js';
import { Lines } from './lines.js';
import { Studies } from './studies.js';
import { Exercises } from './exercises.js';
import { Desk } from './alone.js';
import { Forward, Home } from './home.js';
import { Read } from './read.js';
import { Seek } from './seek.js';
import { noteRecent } from './recent.js';
import './pinned.js';
import './printed.js';

const PAGES = [
  ['calculate', 'Calculate', (state) => html`<${Desk} key="calculate" state=${state} />`],
  ['lab', 'Lab data', (state) => html`<${Lab} state=${state} />`],
  ['lines', 'Lines', (state) => html`<${Lines} state=${state} />`],
  [
    'charts',
    'Charts',
    (state) =>
      html`<${Calculate} key="charts" state=${state} page="charts" keep=${(c) => c.sort === 'chart'} first="humid_gas.psychrometric_chart" />`,
  ],
  ['studies', 'Studies', (state) => html`<${Studies} state=${state} />`],
  [
    'select',
    'Select',
    (state) => html`<${Calculate} key="select" state=${state} page="select" keep=${isSelection} first="" />`,
  ],
  ['exercises', 'Exercises', (state) => html`<${Exercises} state=${state} />`],
  ['home', 'Start', (state) => html`<${Home} key="home" state=${state} />`],
  ['read', 'Reading', (state) => html`<${Read} key="read" state=${state} />`],
  ['find', 'Find', (state) => html`<${Forward} key="find" state=${state} />`],
];
const ASIDE = ['home', 'read', 'find']; // not in the header

function App() {
  const [state, setState] = useState(readLink());
  const [guides, setGuides] = useState(false);
  const [away, setAway] = useState(false);
  useEffect(() => {
    const changed = () => {
      const next = readLink();
      keepPlace(next.page);
      noteRecent(next);
      setState(next);
    };
    keepPlace(readLink().page);
    noteRecent(readLink());
    const gone = (e) => setAway(e.detail);
    addEventListener('granum-gone', gone);
    addEventListener('hashchange', changed);
    ask('/api/cards?sort=procedure').then((found) => setGuides(found.cards.some(isSelection)));
    return () => {
      removeEventListener('hashchange', changed);
      removeEventListener('granum-gone', gone);
    };
  }, []);
  const set = (name, value) => {
    keep(name, value);
    setState(readLink());
  };
  const page = PAGES.find(([name]) => name === state.page) || PAGES.find(([name]) => name === 'home');
  const shown = PAGES.filter(
    ([name]) => !ASIDE.includes(name) && (name !== 'select' || guides || page[0] === 'select'),
  );
  const other = settings.language === 'fr' ? 'en' : 'fr';
  useEffect(() => {
    document.title = `${t(page[1])} · Granum`;
    document.querySelector('nav a[aria-current]')?.scrollIntoView({ block: 'nearest', inline: 'center' });
  }, [page, settings.language, guides]); // a page that comes into the row later moves the others
  return html`<a class="skip" href="#main" onClick=${(e) => {
    e.preventDefault();
    const inside = 'input, select, textarea';
    const form = document.querySelector('#main form, #main section:not(.find)');
    (form?.querySelector(inside) ?? document.querySelector('#main a, #main input'))?.focus();
  }}>${t('Skip to content')}</a>
    <header><a class="brand" href=${link('home')}><img src="icon.svg" alt="" />Granum</a>
      <nav aria-label=${t('Pages')}>${shown.map(
        ([name, label]) =>
          html`<a href=${lastPlace(name)} onClick=${(e) => {
            e.currentTarget.href = lastPlace(name);
          }} aria-current=${name === page[0] ? 'page' : null}>${t(label)}</a>`,
      )}</nav>
      <${Seek} />
      <div class="tools"><button lang=${other} onClick=${() => set('language', other)}>${other === 'fr' ? 'Français' : 'English'}</button>
        <button aria-label=${t('Units: SI or customary of the United States')} title=${t('Units: SI or customary of the United States')} onClick=${() => set('units', settings.units === 'field' ? 'si' : 'field')}>${settings.units === 'field' ? 'ft·lb' : 'SI'}</button>
        <button aria-label=${t('Light or dark')} onClick=${() => keep('theme', settings.theme === 'dark' ? 'light' : 'dark')}>◐</button></div></header>
    ${away && html`<p class="gone" role="alert">${t('Granum no longer answers. Restart it in the terminal; this page reconnects by itself. What you typed is kept.')}</p>`}
    ${page[2](state)}`;
}

apply();
render(html`<${App} />`, document.getElementById('app'));
