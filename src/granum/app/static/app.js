// The shell: header, routing, language, theme.
import { html, render, t, useState, useEffect, readLink, link, settings, keep, apply } from './core.js';
import { Calculate } from './calculate.js';
import { Lab } from './lab.js';
import { Lines } from './lines.js';

const PAGES = [
  ['calculate', 'Calculate', (state) => html`<${Calculate} state=${state} />`],
  ['lab', 'Lab data', (state) => html`<${Lab} state=${state} />`],
  ['lines', 'Lines', (state) => html`<${Lines} state=${state} />`],
  ['charts', 'Charts', (state) => html`<${Calculate} key="charts" state=${state} page="charts" sorts=${['chart']} first="particles.drag_chart" />`],
];

function App() {
  const [state, setState] = useState(readLink());
  const [, refresh] = useState(0);
  useEffect(() => {
    const changed = () => setState(readLink());
    addEventListener('hashchange', changed);
    return () => removeEventListener('hashchange', changed);
  }, []);
  const set = (name, value) => { keep(name, value); refresh((n) => n + 1); };
  const page = PAGES.find(([name]) => name === state.page) || PAGES[0];
  useEffect(() => { document.title = `${t(page[1])} · Granum`; }, [page, settings.language]);
  return html`<a class="skip" href="#main" onClick=${(e) => { e.preventDefault(); document.getElementById('main')?.querySelector('input,select,textarea')?.focus(); }}>${t('Skip to content')}</a>
    <header><a class="brand" href=${link('calculate')}><img src="icon.svg" alt="" />Granum</a>
      <nav aria-label=${t('Pages')}>${PAGES.map(([name, label]) => html`<a href=${link(name)} aria-current=${name === page[0] ? 'page' : null}>${t(label)}</a>`)}</nav>
      <div class="tools"><button lang=${settings.language === 'fr' ? 'en' : 'fr'} onClick=${() => set('language', settings.language === 'fr' ? 'en' : 'fr')}>${settings.language === 'fr' ? 'English' : 'Français'}</button>
        <button aria-label=${t('Light or dark')} onClick=${() => set('theme', settings.theme === 'dark' ? 'light' : 'dark')}>◐</button></div></header>
    ${page[2](state)}`;
}

apply();
render(html`<${App} />`, document.getElementById('app'));
