// A page of the documentation, read in the app.
import { html, t, ask, useAnswer, useEffect, useRef, render, settings } from './core.js';
import { Moving } from './moving.js';

export function Read({ state }) {
  const { data, error } = useAnswer(
    (signal) =>
      ask(`/api/pages/${state.key.split('/').map(encodeURIComponent).join('/')}`, undefined, { signal }),
    [state.key, settings.language],
    0,
  );
  useEffect(() => scrollTo(0, 0), [state.key]);
  const article = useRef(null);
  useEffect(() => {
    const places = [...(article.current?.querySelectorAll('[data-moving]') ?? [])];
    // not within the effect itself: effects of what is rendered there would not run
    const later = setTimeout(() =>
      places.forEach((place) => render(html`<${Moving} name=${place.dataset.moving} />`, place)),
    );
    return () => {
      clearTimeout(later);
      places.forEach((place) => render(null, place));
    };
  }, [data]);
  if (error)
    return html`<main class="page" id="main"><h1>${t('Reading')}</h1><p class="message out">${error.message}</p></main>`;
  if (!data)
    return html`<main class="page" id="main" aria-busy="true"><h1>${t('Reading')}</h1><p class="dim">${t('The page is on its way…')}</p></main>`;
  return html`<main class="page read" id="main"><article ref=${article} lang=${data.language} dangerouslySetInnerHTML=${{ __html: data.html }} />
    <p class="small dim">${t('The other plots and tables of this page are in the documentation site.')}</p></main>`;
}
