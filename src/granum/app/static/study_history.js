// Past studies of this browser: question, time and result, kept in its database.
import { html, t, settings, useEffect, useState } from './core.js';

export const MOST = 30;
const CHANGED = 'granum-history';
let opened = null;

function database() {
  opened ||= new Promise((done, failed) => {
    const request = indexedDB.open('granum', 1);
    request.onupgradeneeded = () => request.result.createObjectStore('studies', { keyPath: 'id' });
    request.onsuccess = () => done(request.result);
    request.onerror = () => failed(request.error);
  });
  return opened;
}

async function within(mode, work) {
  const store = (await database()).transaction('studies', mode).objectStore('studies');
  return new Promise((done, failed) => {
    const request = work(store);
    request.onsuccess = () => done(request.result);
    request.onerror = () => failed(request.error);
  });
}

/** All that is kept, the latest first. */
export async function pastStudies() {
  try {
    return (await within('readonly', (store) => store.getAll())).sort((a, b) => b.when - a.when);
  } catch {
    return []; // a private window
  }
}

/** Keeps a finished study; the oldest beyond the limit go. False when the browser keeps nothing. */
export async function keepStudy(study) {
  try {
    await within('readwrite', (store) => store.put(study));
    for (const old of (await pastStudies()).slice(MOST))
      await within('readwrite', (store) => store.delete(old.id));
    dispatchEvent(new Event(CHANGED));
    return true;
  } catch {
    return false;
  }
}

export async function forgetStudies(id) {
  await within('readwrite', (store) => (id ? store.delete(id) : store.clear()));
  dispatchEvent(new Event(CHANGED));
}

export function usePast() {
  const [past, set] = useState([]);
  useEffect(() => {
    const look = () => pastStudies().then(set);
    look();
    addEventListener(CHANGED, look);
    return () => removeEventListener(CHANGED, look);
  }, []);
  return past;
}

/** The list, to open one again with its set-up. */
export function Past({ past, open }) {
  if (!past.length) return null;
  const when = new Intl.DateTimeFormat(settings.language, { dateStyle: 'medium', timeStyle: 'short' });
  return html`<details class="past" data-past><summary>${t('Past studies of this browser')} <span class="dim">${past.length}</span></summary>
    <ul class="plain">${past.map(
      (study) =>
        html`<li key=${study.id}><button class="plain" onClick=${() => open(study)}>${study.outcome.model}${settings.language === 'fr' ? ' :' : ':'} ${study.question?.title ?? study.question?.kind}</button>
          <div class="small dim">${when.format(study.when)} · ${study.question?.kind} · ${t('{run} cases, {failed} without a result', { run: study.outcome.counts.run, failed: study.outcome.counts.failed })}${!study.outcome.complete && ` · ${t('stopped early')}`} <button class="plain" onClick=${() => forgetStudies(study.id)}>${t('Remove')}</button></div></li>`,
    )}</ul>
    <p class="small dim">${t('The last {count} are kept, in this browser only.', { count: MOST })} <button class="plain" onClick=${() => forgetStudies()}>${t('Remove all')}</button></p></details>`;
}
