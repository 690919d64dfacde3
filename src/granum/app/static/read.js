// A page of the documentation, read in the app.
import { Awaited, html, t, ask, useAnswer, useEffect, useRef, useState, render, settings, Working } from './core.js';
import { Moving } from './moving.js';
import { Plot } from './plot.js';

/** A figure of a chapter, drawn when it comes near what is seen. */
function Drawn({ name, label }) {
  const place = useRef(null);
  const [near, setNear] = useState(false);
  useEffect(() => {
    const watch = new IntersectionObserver(
      (seen) => seen.some((entry) => entry.isIntersecting) && setNear(true),
      { rootMargin: '400px' },
    );
    watch.observe(place.current);
    return () => watch.disconnect();
  }, []);
  return html`<div class="drawn" ref=${place}>${near ? html`<${Asked} name=${name} label=${label} />` : html`<p class="dim">${t('The figure is on its way…')}</p>`}</div>`;
}

function Asked({ name, label }) {
  const { data, error, pending, cancel, job } = useAnswer(
    (signal) => ask(`/api/chapters/${name}`, undefined, { signal }),
    [name],
    0,
  );
  if (error) return html`<p class="message out">${error.message}</p>`;
  if (data) return html`<${Plot} figure=${data} label=${label} name=${name.replaceAll('/', '-')} />`;
  return html`<p class="dim">${t('The figure is on its way…')}</p><${Working} busy=${pending} cancel=${cancel} job=${job} text=${t('The calculations of the chapter are run…')} />`;
}

/** What is drawn in a place of the page; the caption of a figure stands below it. */
const content = (place) =>
  place.dataset.moving
    ? html`<${Moving} name=${place.dataset.moving} />`
    : html`<${Drawn} name=${place.dataset.drawn} label=${place.nextElementSibling?.textContent ?? place.dataset.drawn} />`;

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
    const places = [...(article.current?.querySelectorAll('[data-moving], [data-drawn]') ?? [])];
    // not within the effect itself: effects of what is rendered there would not run
    const later = setTimeout(() =>
      places.forEach((place) => render(content(place), place)),
    );
    return () => {
      clearTimeout(later);
      places.forEach((place) => render(null, place));
    };
  }, [data]);
  if (error)
    return html`<main class="page" id="main"><h1>${t('Reading')}</h1><p class="message out">${error.message}</p></main>`;
  if (!data)
    return html`<main class="page" id="main"><h1>${t('Reading')}</h1><${Awaited} text=${t('The page is on its way…')} /></main>`;
  return html`<main class="page read" id="main"><article ref=${article} lang=${data.language} dangerouslySetInnerHTML=${{ __html: data.html }} />
    ${data.whole ? null : html`<p class="small dim">${t('The other plots and tables of this page are in the documentation site.')}</p>`}</main>`;
}
