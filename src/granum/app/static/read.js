// A page of the documentation, read in the app.
import { html, t, ask, useAnswer, useEffect, settings } from './core.js';

export function Read({ state }) {
  const { data, error } = useAnswer(
    (signal) =>
      ask(`/api/pages/${state.key.split('/').map(encodeURIComponent).join('/')}`, undefined, { signal }),
    [state.key, settings.language],
    0,
  );
  useEffect(() => scrollTo(0, 0), [state.key]);
  if (error)
    return html`<main class="page" id="main"><h1>${t('Reading')}</h1><p class="message out">${error.message}</p></main>`;
  if (!data)
    return html`<main class="page" id="main" aria-busy="true"><h1>${t('Reading')}</h1><p class="dim">${t('The page is on its way…')}</p></main>`;
  return html`<main class="page read" id="main"><article lang=${data.language} dangerouslySetInnerHTML=${{ __html: data.html }} />
    <p class="small dim">${t('Plots and tables of this page are in the documentation site.')}</p></main>`;
}
