// The search of every page: "/" opens it. Cards, equipment, charts, lab tests, lines, exercises and pages to read, the best first, by what they are.
import { html, t, ask, link, useAnswer, useState, useEffect, useRef, settings } from './core.js';
import { isSelection } from './calculate.js';

const SHOWN = 24;
const IN_A_GROUP = 6;
const PLACES = {
  'formula': ['calculate', 'Calculate'],
  'procedure': ['calculate', 'Calculate'],
  'law': ['calculate', 'Calculate'],
  'equipment': ['calculate', 'Calculate'],
  'chart': ['charts', 'Charts'],
  'lab test': ['lab', 'Lab data'],
  'line': ['lines', 'Lines'],
  'exercise': ['exercises', 'Exercises'],
  'page': ['read', 'Reading'],
};
const GROUPS = {
  'formula': 'Formulas',
  'procedure': 'Procedures',
  'law': 'Laws',
  'equipment': 'Equipment',
  'chart': 'Charts',
  'lab test': 'Lab tests',
  'line': 'Lines',
  'exercise': 'Exercises',
  'page': 'Reading',
};

/** Page, its name and key of something found, which is `{sort, key}`. */
export function placeOf(hit) {
  if (hit.sort === 'procedure' && isSelection({ sort: hit.sort, card: hit.key }))
    return { page: 'select', name: 'Select', key: hit.key };
  const [page, name] = PLACES[hit.sort];
  return { page, name, key: hit.sort === 'line' ? `examples:${hit.key}` : hit.key };
}

export const hrefOf = (hit) => link(placeOf(hit).page, placeOf(hit).key);

function grouped(hits) {
  const groups = new Map();
  for (const hit of hits) {
    const sort = GROUPS[hit.sort];
    groups.set(sort, [...(groups.get(sort) || []), hit]);
  }
  return [...groups].map(([name, list]) => [name, list.slice(0, IN_A_GROUP)]);
}

/** The server has its words ready once somebody is about to type: they take seconds the first time. */
const readied = new Set();
function ready() {
  const { language } = settings;
  if (readied.has(language)) return;
  readied.add(language);
  ask('/api/search?limit=1&q=').catch(() => readied.delete(language));
}

export function Seek() {
  const [word, setWord] = useState('');
  const [open, setOpen] = useState(false);
  const [active, setActive] = useState(0);
  const input = useRef(null);
  const eager = useRef(false); // Enter came before the answer
  const asked = word.trim();
  const found = useAnswer(
    (signal) =>
      asked
        ? ask(`/api/search?limit=${SHOWN}&q=${encodeURIComponent(asked)}`, undefined, { signal })
        : Promise.resolve({ hits: [] }),
    [asked, settings.language],
    40,
  );
  const groups = asked ? grouped(found.data?.hits || []) : [];
  const flat = groups.flatMap(([, list]) => list);
  const at = Math.min(active, Math.max(flat.length - 1, 0));
  const show = () => {
    setOpen(true);
    input.current?.focus(); // at once: the next key is meant for it
    setTimeout(() => input.current?.focus()); // on a phone it is hidden until it is open
  };
  const close = () => {
    setOpen(false);
    setActive(0);
    input.current?.blur();
  };
  useEffect(() => {
    const key = (e) => {
      const typing = e.target.closest?.('input, textarea, select, [contenteditable]');
      if (e.key !== '/' || typing || e.ctrlKey || e.metaKey || e.altKey) return;
      e.preventDefault();
      show();
    };
    const left = () => setOpen(false);
    addEventListener('keydown', key);
    addEventListener('hashchange', left);
    return () => {
      removeEventListener('keydown', key);
      removeEventListener('hashchange', left);
    };
  }, []);
  useEffect(() => {
    document.getElementById(`hit-${at}`)?.scrollIntoView({ block: 'nearest' });
  }, [at, flat.length]);
  const go = (hit) => {
    setWord('');
    close();
    location.hash = hrefOf(hit);
  };
  useEffect(() => {
    if (!eager.current || found.pending) return;
    eager.current = false;
    if (flat[at]) go(flat[at]);
  });
  const press = (e) => {
    eager.current = e.key === 'Enter' && found.pending;
    if (e.key === 'Escape') close();
    else if (e.key === 'ArrowDown' || e.key === 'ArrowUp') {
      e.preventDefault();
      setOpen(true);
      if (flat.length) setActive((at + (e.key === 'ArrowDown' ? 1 : flat.length - 1)) % flat.length);
    } else if (e.key === 'Enter' && flat[at] && !found.pending) {
      e.preventDefault();
      go(flat[at]);
    }
  };
  const listed = open && asked !== '';
  let number = -1;
  return html`<div class=${open ? 'seek open' : 'seek'} role="search" onfocusout=${(e) => {
    if (e.currentTarget.contains(e.relatedTarget)) return;
    eager.current = false;
    setOpen(false);
  }}>
    <button class="opener" aria-label=${t('Search everything')} aria-expanded=${String(open)} onClick=${show}><${Glass} /></button>
    <div class="sheet"><div class="line"><${Glass} /><input ref=${input} id="seek" type="text" role="combobox" aria-expanded=${String(listed && flat.length > 0)} enterkeyhint="search" autocomplete="off" spellcheck=${false} aria-label=${t('Search everything')} aria-controls="hits" aria-autocomplete="list" aria-activedescendant=${listed && flat.length ? `hit-${at}` : null}
        placeholder=${t('Search everything')} value=${word} onFocus=${() => {
          setOpen(true);
          ready();
        }} onKeyDown=${press} onInput=${(
          e,
        ) => {
          setWord(e.target.value);
          setActive(0);
          setOpen(true);
        }} /><kbd aria-hidden="true">/</kbd><button class="button closer" onClick=${close}>${t('Close')}</button></div>
    <div id="hits" role="listbox" aria-label=${t('Found')} hidden=${!listed || !flat.length}>${groups.map(
      ([
        name,
        list,
      ]) => html`<div role="group" aria-label=${t(name)} key=${name}><div class="kind" aria-hidden="true">${t(name)}</div>
      ${list.map((hit) => {
        number += 1;
        const mine = number;
        const where = placeOf(hit);
        return html`<a role="option" id=${`hit-${mine}`} key=${hit.key} tabindex="-1" aria-selected=${String(mine === at)} href=${hrefOf(hit)} onMouseDown=${(e) => e.preventDefault()} onMouseMove=${() => setActive(mine)} onClick=${(
          e,
        ) => {
          if (e.ctrlKey || e.metaKey || e.shiftKey) return;
          e.preventDefault();
          go(hit);
        }}><span class="title">${hit.title}</span> <span class="where">${hit.domain ? `${t(hit.domain)} · ` : ''}${t(where.name)}</span><span class="summary">${hit.summary}</span></a>`;
      })}</div>`,
    )}</div>
    <div class="none" role="status">${listed && found.pending && !flat.length ? html`<span class="late">${t('Searching…')}</span>` : listed && !found.pending ? (flat.length ? html`<span class="unseen">${t('{count} found', { count: flat.length })}</span>` : t('Nothing found for “{word}”. Try another word, a symbol or an author.', { word: asked })) : ''}</div></div></div>`;
}

const Glass = () =>
  html`<svg viewBox="0 0 16 16" width="16" height="16" aria-hidden="true"><circle cx="6.5" cy="6.5" r="4.5" fill="none" stroke="currentColor" stroke-width="1.6" /><path d="M10 10l4.5 4.5" stroke="currentColor" stroke-width="1.6" stroke-linecap="round" /></svg>`;
