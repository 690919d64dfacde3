// What stands on paper besides the page: which program and version, when, and the address that brings it back.
import { html, render, t, ask, settings, useEffect, useState } from './core.js';

let version = '';
ask('/api/version').then((found) => {
  version = found.version;
});

/** What the page shows: the line or the card, not the part of the program. */
const heading = () =>
  document.querySelector('main h2.title')?.textContent || document.querySelector('main h1')?.textContent || '';

/** The address to type again: that of a line without the whole case in it, which nobody types. */
const address = () => location.href.replace(/[?&]case=[^&]*/, '');

function Printed() {
  const [, again] = useState(0);
  useEffect(() => {
    let kept = '';
    const before = () => {
      kept = document.title;
      document.title = `${heading()} · Granum`; // the name of the file that is printed to
      again((count) => count + 1);
    };
    const after = () => {
      document.title = kept;
    };
    addEventListener('beforeprint', before);
    addEventListener('afterprint', after);
    return () => {
      removeEventListener('beforeprint', before);
      removeEventListener('afterprint', after);
    };
  }, []);
  const when = new Intl.DateTimeFormat(settings.language, { dateStyle: 'long', timeStyle: 'short' });
  return html`<p class="printed">Granum ${version} · ${heading()} · ${when.format(Date.now())}<br />${t('The same page again:')} ${address()}</p>`;
}

const foot = document.createElement('footer');
document.body.append(foot);
render(html`<${Printed} />`, foot);
