// State in the link, language, theme, requests: shared by every page.
import {
  h,
  html as drawn,
  render,
  useState,
  useEffect,
  useLayoutEffect,
  useRef,
  useMemo,
  useCallback,
} from './vendor/htm-preact.js';
import { english, french } from './strings.fr.js';

export { h, render, useState, useEffect, useLayoutEffect, useRef, useMemo, useCallback };

// ---- state in the link: #/page/key?name=value&… ----------------------------------------------------
let links = 0;
export function readLink() {
  const [path, query = ''] = location.hash.replace(/^#\/?/, '').split('?');
  const [page = 'home', ...rest] = path.split('/').map(decodeURIComponent);
  return {
    page: page || 'home',
    key: rest.join('/'),
    values: Object.fromEntries(new URLSearchParams(query)),
    visit: ++links,
  };
}

/** `emptied`: whether a field that was emptied is told, where one that is not named is as in the example. */
export function link(page, key = '', values = {}, emptied = false) {
  const kept = Object.entries(values).filter(
    ([, value]) => (emptied || value !== '') && value !== undefined && value !== null,
  );
  const query = new URLSearchParams(kept).toString();
  return `#/${page}${key ? '/' + encodeURIComponent(key) : ''}${query ? '?' + query : ''}`;
}

export function replaceLink(page, key, values, emptied = false) {
  history.replaceState(null, '', link(page, key, values, emptied));
  keepPlace(page);
}

// ---- what outlives a reload, a change of language, a look at another page and a closed tab -------------
const memories = () => [sessionStorage, localStorage]; // one's own tab first, then what the last tab left
/** Keeps a value in this browser; false when it cannot (a private window, or too large). */
export function remember(name, value) {
  try {
    for (const memory of memories())
      value === null || value === undefined
        ? memory.removeItem('granum:' + name)
        : memory.setItem('granum:' + name, JSON.stringify(value));
    return true;
  } catch {
    return false;
  }
}
export function recall(name, fallback = null) {
  try {
    const found = memories()
      .map((memory) => memory.getItem('granum:' + name))
      .find((text) => text !== null);
    return found === undefined ? fallback : (JSON.parse(found) ?? fallback);
  } catch {
    return fallback;
  }
}
/** Where one was on a page, so that its entry in the header leads back there. */
export const keepPlace = (page) => remember('place ' + page, location.hash);
export const lastPlace = (page) => recall('place ' + page, link(page));
/** A state that outlives its component; the third says whether it was kept. */
export function useKept(name, fallback) {
  const [value, set] = useState(() => recall(name, fallback));
  const [kept, setKept] = useState(true);
  return [
    value,
    (next) => {
      setKept(remember(name, next));
      set(next);
    },
    kept,
  ];
}

// ---- language and theme ---------------------------------------------------------------------------
const store = (name, fallback) => {
  try {
    return localStorage.getItem(name) || fallback;
  } catch {
    return fallback;
  }
};
export const settings = {
  language:
    new URLSearchParams(location.search).get('lang') ||
    store('granum-language', navigator.language.startsWith('fr') ? 'fr' : 'en'),
  units: store('granum-units', 'si'),
  theme: store('granum-theme', matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light'),
};
export function keep(name, value) {
  settings[name] = value;
  try {
    localStorage.setItem('granum-' + name, value);
  } catch {
    /* private window: the choice lasts for the page */
  }
  apply();
}
export function apply() {
  document.documentElement.lang = settings.language;
  document.documentElement.dataset.theme = settings.theme;
  dispatchEvent(new Event('granum-theme'));
}

/** The colon of the language: French puts a no-break space before it. */
export const colon = () => (settings.language === 'fr' ? '\u00a0:' : ':');

/** French as it is printed: no line begins with a mark; words of the page have the apostrophe of print besides. */
const unbroken = (text) => text.replace(/(?<=\S) (?=[:;?!»%])|(?<=«) /g, '\u00a0');
const spaced = (text) => unbroken(text.replaceAll("'", '’'));

/** Of each value of a template whether it is text between tags, which is printed; attributes and code stay as they are. */
const places = new Map();
function printed(parts) {
  if (!places.has(parts)) {
    let within = false;
    places.set(
      parts,
      parts.map((part) => {
        const [open, close] = [part.lastIndexOf('<'), part.lastIndexOf('>')];
        if (open >= 0 || close >= 0) within = close > open && !/<(pre|code|textarea)\b[^<]*>$/.test(part);
        return within;
      }),
    );
  }
  return places.get(parts);
}

/** What is drawn; what the server says in French is printed as such here, and nowhere else. */
export const html = (parts, ...values) =>
  drawn(
    parts,
    ...(settings.language === 'fr'
      ? values.map((value, i) => (typeof value === 'string' && printed(parts)[i] ? unbroken(value) : value))
      : values),
  );

export function t(text, values = {}) {
  const found =
    settings.language === 'fr' ? (french[text] ? spaced(french[text]) : text) : english[text] || text;
  return found.replace(/\{(\w+)\}/g, (whole, name) => (name in values ? counted(values[name]) : whole));
}

/** A large count with its thousands apart, as the server writes it. */
const counted = (value) =>
  Number.isInteger(value) && value >= 10_000 ? String(value).replace(/\B(?=(\d{3})+$)/g, '\u202f') : value;

// ---- requests -------------------------------------------------------------------------------------
const ATTEMPTS = 3;
let waiting = null;
/** Resolves when the server answers again; until then the page says that it is gone. */
function returned() {
  waiting ||= (async () => {
    dispatchEvent(new CustomEvent('granum-gone', { detail: true }));
    for (;;) {
      try {
        await fetch('icon.svg', { method: 'HEAD', cache: 'no-store' });
        break;
      } catch {
        await new Promise((done) => setTimeout(done, 1500));
      }
    }
    waiting = null;
    dispatchEvent(new CustomEvent('granum-gone', { detail: false }));
  })();
  return waiting;
}

/** A request that waits for a server that is gone, and is then made again. */
async function reach(path, request) {
  for (let attempt = 1; ; attempt += 1) {
    try {
      return await fetch(path, request);
    } catch (problem) {
      if (request.signal?.aborted || problem.name === 'AbortError') throw problem;
      if (attempt >= ATTEMPTS) throw new Error(t('The connection broke off again and again.'));
      await returned();
      request.signal?.throwIfAborted();
    }
  }
}

export async function ask(path, body, options = {}) {
  const form = body instanceof FormData;
  const response = await reach(path, {
    method: options.method || (body === undefined ? 'GET' : 'POST'),
    headers: {
      'x-language': settings.language,
      'x-units': settings.units,
      ...(options.signal?.job && { 'x-job': options.signal.job }),
      ...(form || body === undefined ? {} : { 'content-type': 'application/json' }),
    },
    body: body === undefined ? undefined : form ? body : JSON.stringify(body),
    signal: options.signal,
  });
  if (options.text && response.ok) return response.text();
  if (options.blob && response.ok) return response.blob();
  const data = await response.json();
  if (!response.ok)
    throw Object.assign(new Error(data.error?.message || t('The server did not understand the request.')), {
      details: data.error,
    });
  return data;
}

/** The way to stop a request, with a name under which the server can be asked how far it is. */
export function stoppable() {
  const stop = new AbortController();
  stop.signal.job = Array.from(crypto.getRandomValues(new Uint8Array(12)), (byte) => byte.toString(36)).join(
    '',
  );
  return stop;
}

/**
 * The latest answer to a request that changes with every key stroke; older answers are dropped, the last one stays visible.
 * `pending` is true from the moment the question changes until it is answered, so that nothing old looks new.
 */
export function useAnswer(make, dependencies, wait = 60) {
  const [state, setState] = useState({ data: null, error: null, to: null });
  const running = useRef(null);
  useEffect(() => {
    const stop = stoppable();
    running.current = stop;
    const timer = setTimeout(async () => {
      try {
        const data = await make(stop.signal);
        if (!stop.signal.aborted) setState({ data, error: null, to: dependencies });
      } catch (error) {
        if (!stop.signal.aborted) setState((s) => ({ data: s.data, error, to: dependencies }));
      }
    }, wait);
    return () => {
      stop.abort();
      clearTimeout(timer);
    };
  }, dependencies);
  const pending = !state.to || dependencies.some((value, i) => value !== state.to[i]);
  const cancel = () => {
    running.current?.abort();
    setState((s) => ({
      ...s,
      error: new Error(t('Canceled. Change an input to calculate again.')),
      to: dependencies,
    }));
  };
  return { data: state.data, error: state.error, pending, cancel, job: () => running.current?.signal.job };
}

/** Puts a text on the clipboard; whether it is there. Browsers give theirs to this computer and to https alone. */
export async function toClipboard(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const before = document.activeElement;
    const field = Object.assign(document.createElement('textarea'), { value: text, className: 'unseen' });
    document.body.append(field);
    field.select();
    const done = document.execCommand('copy');
    field.remove();
    before?.focus();
    return done;
  }
}

/** What is said after the address of the page has been copied, and what copies it. */
export function useCopying() {
  const [copied, setCopied] = useState('');
  const copy = async () => {
    setCopied((await toClipboard(location.href)) ? t('Copied.') : location.href);
    setTimeout(() => setCopied(''), 4000);
  };
  return [copied, copy];
}

/**
 * Shown once something takes longer than a second, or from another one on: what the server is doing, how long already,
 * and a way to stop it. `job` gives the name of the request waited for; without one, `share` and `text` say how far it is.
 */
export function Working({
  busy,
  cancel,
  job,
  share = 0,
  from = 1,
  text = t('Working… what is asked for the first time takes a little longer.'),
}) {
  const [seconds, setSeconds] = useState(0);
  const [note, setNote] = useState('');
  useEffect(() => {
    if (!busy) return undefined;
    const start = Date.now();
    let asking = false;
    setSeconds(0);
    setNote('');
    const look = async () => {
      setSeconds(Math.floor((Date.now() - start) / 1000));
      const name = job?.();
      if (!name || asking || Date.now() - start < 1000) return;
      asking = true;
      try {
        const found = await ask(`/api/progress/${name}`);
        if (name === job()) setNote(found.note || '');
      } catch {
        setNote('');
      }
      asking = false;
    };
    const timer = setInterval(look, 500);
    return () => clearInterval(timer);
  }, [busy]);
  if (!busy || seconds < from) return null;
  return html`<div class="row" data-working><progress max="1" value=${share || null} aria-label=${t('Progress')}></progress> <span class="small"><span data-note>${note ? note[0].toUpperCase() + note.slice(1) : text}</span>${seconds > 0 ? ' · ' : ''}${share ? `${Math.round(100 * share)} % · ` : ''}${seconds > 0 ? t('{seconds} s', { seconds }) : ''}</span>${cancel && html` <button class="button" onClick=${cancel}>${t('Cancel')}</button>`}</div>`;
}

/** A place that is empty until what belongs there has come: what that is, and since when it is awaited. */
export const Awaited = ({ text, job }) =>
  html`<div aria-busy="true"><${Working} busy=${true} from=${0} text=${text} job=${job} /></div>`;

/** A file made here, handed to the person in front of the page. */
export function download(name, text, type) {
  const place = URL.createObjectURL(new Blob([text], { type }));
  Object.assign(document.createElement('a'), { href: place, download: name }).click();
  URL.revokeObjectURL(place);
}
