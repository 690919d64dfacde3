// Case files that were changed and not saved: one draft per file, and the text itself in the link where it is short.
import { ask, html, settings, t } from './core.js';

const LONGEST = 8000; // characters of a link
const KEY = 'granum-drafts';
const all = () => {
  try {
    return JSON.parse(localStorage.getItem(KEY)) || {};
  } catch {
    return {};
  }
};

export const drafted = (place) => all()[place] ?? null;
/** Places of everything that was changed and not saved. */
export const draftedPlaces = () => Object.keys(all());
/** The title of a case, as far as its text tells. */
const titleIn = (text) => {
  try {
    return JSON.parse(text.match(/^title\s*=\s*("(?:[^"\\]|\\.)*")/m)[1]).trim();
  } catch {
    return '';
  }
};
/** Lines that are no file of the server, kept in this browser: places with titles, which are told apart where two are equal. */
export function ownLines() {
  const rows = draftedPlaces()
    .filter((place) => place.startsWith('computer:'))
    .map((place) => ({ place, title: titleIn(drafted(place)) || place.slice(9) }));
  const twice = (title) => rows.filter((row) => row.title === title).length > 1;
  return rows
    .map(({ place, title }) => ({ place, title: twice(title) ? `${title} (${place.slice(9)})` : title }))
    .toSorted((a, b) => a.title.localeCompare(b.title, settings.language));
}
/** Those lines in a menu of places, with the one that is open. */
export function OwnLines({ place }) {
  const rows = ownLines();
  const open = place.startsWith('computer:') && !rows.some((row) => row.place === place);
  const all = open ? [{ place, title: place.slice(9) }, ...rows] : rows;
  return all.length > 0 && html`<optgroup label=${t('Kept in this browser')}>${all.map((row) => html`<option value=${row.place} selected=${row.place === place}>${row.title}</option>`)}</optgroup>`;
}
export function keepDraft(place, text) {
  const drafts = all();
  if (text === null) delete drafts[place];
  else drafts[place] = text;
  try {
    localStorage.setItem(KEY, JSON.stringify(drafts));
  } catch {
    /* private window: the link still carries what is short */
  }
}

const TRAIL = 'granum-steps';
const MOST_KEPT = 400_000; // characters: what is taken back must not crowd out what was typed
/** The steps that can be taken back and made again on the line in front: they outlive a reload, in this tab. */
export function keepSteps(place, text, past, future) {
  for (let steps = past; ; steps = steps.slice(Math.ceil(steps.length / 2))) {
    const trail = JSON.stringify({ place, text, past: steps, future });
    if (trail.length > MOST_KEPT && steps.length) continue;
    try {
      sessionStorage.setItem(TRAIL, trail);
    } catch {
      /* no room: they last as long as the page */
    }
    return;
  }
}
/** Those steps, if they lead to this text of this line; null otherwise. */
export function keptSteps(place, text) {
  try {
    const trail = JSON.parse(sessionStorage.getItem(TRAIL));
    return trail?.place === place && trail.text === text ? trail : null;
  } catch {
    return null;
  }
}

/** A change made from another page: the text before it is one step back, as after a change under Lines. */
export function keepChange(place, before, text) {
  const past = keptSteps(place, before)?.past ?? [];
  keepDraft(place, text);
  keepSteps(place, text, [...past, before], []);
}

const through = async (bytes, stream) =>
  new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());

/** A text as a link carries it; empty where it would be too long. */
export async function packed(text) {
  const bytes = await through(new TextEncoder().encode(text), new CompressionStream('deflate-raw'));
  const found = btoa(Array.from(bytes, (b) => String.fromCharCode(b)).join(''))
    .replaceAll('+', '-')
    .replaceAll('/', '_')
    .replaceAll('=', '');
  return found.length <= LONGEST ? found : '';
}
export async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));
  return new TextDecoder().decode(await through(bytes, new DecompressionStream('deflate-raw')));
}

/** The text of a case as one would see it: what the link carries, else the draft of the file, else the file. */
export async function caseAt(place, carried, signal) {
  const [sort, ...rest] = place.split(':');
  const own = carried ? await unpacked(carried) : drafted(place);
  if (sort === 'computer') {
    if (own === null)
      throw new Error(
        t('What was opened from this computer is no longer kept here: open {name} again.', {
          name: rest.join(':'),
        }),
      );
    return { text: own, saved: own, changed: false };
  }
  const { text: saved } = await ask(
    `/api/${sort}/${rest.join(':').split('/').map(encodeURIComponent).join('/')}`,
    undefined,
    { signal },
  );
  return { text: own ?? saved, saved, changed: own !== null && own !== saved };
}

/** The examples of a list of files as a menu shows them. */
export const byTitle = ({ shipped, titles }) =>
  shipped.toSorted((a, b) => (titles[a] || a).localeCompare(titles[b] || b, settings.language));
