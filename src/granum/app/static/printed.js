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

/** Groups of a form that are folded although something is told in them: a sheet without it could not be calculated again. */
const folded = () =>
  [...document.querySelectorAll('main form details:not([open])')].filter(
    (group) =>
      group.matches('.inlet') || [...group.querySelectorAll('input')].some((field) => field.value !== ''),
  );

/** Fields in which nothing stands, not even what holds in its place. */
const blank = () =>
  [...document.querySelectorAll('main form .field')].filter((field) => {
    const entries = [...field.querySelectorAll('.entry :is(input, select.alone, textarea)')];
    return entries.length > 0 && entries.every((entry) => !entry.value && !entry.placeholder);
  });

function Printed() {
  const [, again] = useState(0);
  useEffect(() => {
    let kept = '';
    let opened = [];
    let empty = [];
    const before = () => {
      opened = folded();
      for (const group of opened) group.open = true;
      empty = blank();
      for (const field of empty) field.classList.add('blank');
      kept = document.title;
      document.title = `${heading()} · Granum`; // the name of the file that is printed to
      again((count) => count + 1);
    };
    const after = () => {
      document.title = kept;
      for (const group of opened) group.open = false;
      for (const field of empty) field.classList.remove('blank');
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
