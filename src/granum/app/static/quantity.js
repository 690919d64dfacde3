// A quantity as people type it. While the field has the focus its text is the user's and is never rewritten; what the server
// understood of it stands under the field; number and unit part when the field is left.
import { html, t, ask, settings, useState, useEffect, useRef } from './core.js';

export const joined = ({ number, unit }) => `${number} ${unit}`.trim();
export const inLanguage = (text) =>
  settings.language === 'fr' && !text.includes(',') ? text.replaceAll(/\.(?=\d)/g, ',') : text;

const RAISED = '⁰¹²³⁴⁵⁶⁷⁸⁹';
const raised = (power) =>
  (power.startsWith('-') ? '⁻' : '') + [...power.replace(/\D/g, '')].map((digit) => RAISED[digit]).join('');
/** A number as it is printed: 1.07 × 10⁸ for 1.07e8; it may be typed so as well. */
export const printed = (text) => text.replace(/(\d)e([-+]?\d+)/g, (_whole, last, power) => `${last} × 10${raised(power)}`);
const NUMBER =
  /[\s;,[\]]*(?:(?:±|\+\/?-|\.\.+|…|(?:à|to)(?=\s))\s*)?[-+−–]?\s?(?!1\s?\/\s?[a-zµ(])(?:\d+(?:[.,](?!\.)\d*)*|[.,]\d+)(?:e[-+−]?\d+|\s*[×x·*]\s*10(?:\^?[-+−]?\d+|[⁺⁻]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+))?(?:\/\d+(?![\d.,]))?/iy;
/** A unit in a menu; what has none stands as in the head of a table. */
export const unitLabel = (unit) => unit.label || '–';
const named = (unit) => (unit === 'dimensionless' ? '' : unit || '');
/** A unit that no menu offers, as it is printed: dm² for dm^2. */
const asPrinted = (unit) => unit.replace(/\^?((?<=[\^\p{L}])-?\d+)/gu, (_whole, power) => raised(power)).replaceAll('*', '·').replace(/\bum\b/g, 'µm');
/** A value of a case as people read it. */
export const readable = (text, p) => {
  const { number, unit } = split(text);
  const label = p.units?.find((u) => u.unit === unit)?.label ?? asPrinted(unit);
  return `${printed(inLanguage(number))} ${label}`.trim();
};

/** Text such as "1 200,5 cm2" or "2 4 8 um" cut where the unit begins; what the number and the unit mean is for the server to say. */
export function split(text) {
  NUMBER.lastIndex = 0;
  let end = 0;
  while (NUMBER.test(text)) end = NUMBER.lastIndex;
  return end
    ? {
        number: text.slice(0, end).trim(),
        unit: text
          .slice(end)
          .replace(/^[\s\],;]+/, '')
          .trim(),
      }
    : { number: text, unit: '' };
}

/** Number and unit of the text of a form, where a number alone is SI; an empty one in the unit people usually write. */
function held(text, p) {
  if (!text)
    return { number: '', unit: named(p.default_shown?.unit ?? p.example?.unit ?? p.units?.[0]?.unit) };
  const { number, unit } = split(text);
  const offered = p.units?.find(
    (u) => u.unit.replaceAll('^', '') === unit.replaceAll('^', '') || u.label === unit,
  ); // m2: m^2
  if (!unit && !/\p{Nd}/u.test(number)) return { number, unit: held('', p).unit }; // no number, such as a minus alone
  return { number, unit: unit ? named(offered?.unit ?? unit) : named(p.unit) };
}

/** What the server makes of a text, a moment after the last key; asked only while somebody types. */
function useReading(p, text) {
  const [found, setFound] = useState({ text: null });
  useEffect(() => {
    if (!text) {
      setFound({ text });
      return undefined;
    }
    const stop = new AbortController();
    const timer = setTimeout(() => read(p, text, stop.signal).then(setFound, () => {}), 60);
    return () => {
      stop.abort();
      clearTimeout(timer);
    };
  }, [text]);
  return text && found.text === text ? found : null;
}

async function read(p, text, signal) {
  const parts = split(text);
  const asked = {
    number: parts.number,
    unit_typed: parts.unit,
    name: p.name,
    kind: p.kind,
    unit: p.unit,
    lower: p.lower,
    upper: p.upper,
    open_lower: p.open_lower,
    open_upper: p.open_upper,
    series: p.series || '',
    several: p.several || false,
    interval: p.interval || false,
    or_kind: p.or_kind || '',
    units: (p.units || []).map((u) => u.unit),
  };
  return { text, ...(await ask('/api/read', asked, { signal })) };
}

// A field that is left by pressing a button keeps its height until the button is let go: the press would miss it otherwise.
let pressed = false;
addEventListener(
  'pointerdown',
  () => {
    pressed = true;
    document.activeElement?.closest('.field')?.classList.add('held'); // its bounds stay in sight
  },
  true,
);
for (const end of ['pointerup', 'pointercancel'])
  addEventListener(
    end,
    () => {
      pressed = false;
      setTimeout(() => document.querySelectorAll('.field.held').forEach((field) => field.classList.remove('held')));
    },
    true,
  );
const released = () =>
  new Promise((done) => {
    if (pressed)
      for (const end of ['pointerup', 'pointercancel'])
        addEventListener(end, () => setTimeout(done), { once: true });
    else done();
  });

const underway = new Set();
const tracked = (work) => {
  const known = work.catch(() => {}).finally(() => underway.delete(known)); // not read: the text stays as it was typed
  underway.add(known);
};
/** Done when every field that was left has been understood: what acts on a whole form waits for it. */
export const settled = () => Promise.all(underway);

/** The text that a value keeps: what was typed, with the unit of the menu where none was typed. */
function kept(typed, menu) {
  const parts = split(typed.trim());
  return typed.trim() === ''
    ? ''
    : joined(parts.unit || !/\p{Nd}/u.test(parts.number) ? parts : { number: parts.number, unit: menu });
}

/**
 * `onChange` gets the text, and whether it is only what the server understood of the text it had already: that comes late,
 * goes to whoever holds the value then, and to nobody once the field is gone. `onEnter` is called once what was typed is understood.
 */
/** Units of one sort, under its name where a field takes several. */
const grouped = (sort, options) => (sort ? html`<optgroup label=${sort}>${options}</optgroup>` : options);

export function Quantity({ p, id, note, text = '', onChange, onEnter, problem, label = p.label }) {
  const given = held(text, p);
  const [typed, show] = useState(null);
  const [unit, setUnit] = useState(given.unit);
  const raw = useRef(null);
  const offers = useRef(false);
  const sent = useRef(text);
  const focused = useRef(false);
  const holder = useRef(onChange);
  holder.current = onChange;
  useEffect(
    () => () => {
      raw.current = null;
    },
    [],
  );
  const menu = typed === null && text ? given.unit : unit;
  const asked = typed === null ? '' : kept(typed, menu);
  const reading = useReading(p, asked);
  const setTyped = (next) => {
    raw.current = next;
    show(next);
  };
  const send = (next, understood = false) => {
    if (next !== sent.current) {
      sent.current = next;
      holder.current(next, understood);
    }
  };
  useEffect(() => {
    // a value from elsewhere: an undo, an example, a link
    if (text === sent.current || focused.current) return;
    sent.current = text;
    setTyped(null);
    if (text) setUnit(given.unit);
  }, [text]);
  useEffect(() => {
    // the value as it was understood, unless another key has come since; the text stays as it was typed
    if (reading?.number !== undefined && kept(raw.current ?? '', menu) === reading.text)
      send(joined(reading), true);
  }, [reading]);
  const type = (next) => {
    setUnit(menu);
    setTyped(next);
    send(kept(next, menu));
  };
  const settle = async () => {
    const before = raw.current;
    if (before === null) return;
    const found = asked && (reading || (await read(p, asked)));
    if (raw.current !== before || found.problem) return;
    setTyped(null);
    if (found) {
      setUnit(found.unit);
      send(joined(found), true);
    }
  };
  const choose = (next) => {
    const number = typed === null ? given.number : split(typed).number;
    setUnit(next);
    setTyped(null);
    if (number) send(joined({ number, unit: next }));
  };
  const units = (p.units || []).map((u) => ({ unit: named(u.unit), label: unitLabel(u), sort: u.sort || '' }));
  if (menu && !units.some((u) => u.unit === menu)) units.push({ unit: menu, label: asPrinted(menu), sort: '' });
  const plain = p.kind === 'ratio' && !units[0]?.unit && units.every((u) => ['', 'percent'].includes(u.unit));
  if (!plain || menu) offers.current = true; // a count or an exponent has no unit to choose, unless somebody wrote %
  const shown = printed(inLanguage(given.number));
  const wrong = reading?.problem || problem;
  const example = p.default_shown?.number ?? p.hint ?? (p.series ? (p.example?.number ?? '1 2 3') : '');
  return html`<div class="quantity"><div class="pairs"><input id=${id} type="text" inputmode="text" autocomplete="off" autocapitalize="off" spellcheck=${false} aria-label=${id ? null : label} aria-describedby=${note} aria-invalid=${wrong ? 'true' : 'false'}
      value=${typed ?? shown} placeholder=${p.series ? inLanguage(example) : printed(inLanguage(example))} onFocus=${() => {
        focused.current = true;
      }} onBlur=${() => {
        focused.current = false;
        tracked(released().then(settle));
      }}
      onInput=${(e) => type(e.target.value)} onKeyDown=${(e) => {
        if (e.key === 'Enter') {
          e.preventDefault();
          tracked(settle().then(() => onEnter?.()));
        }
      }} />
    ${offers.current && units.some((u) => u.unit) && html`<select class=${typed !== null && split(typed).unit ? 'dim' : ''} aria-label=${t('Unit of {name}', { name: label })} value=${menu} onChange=${(e) => choose(e.target.value)}>${[...new Set(units.map((u) => u.sort))].map((sort) => grouped(sort, units.filter((u) => u.sort === sort).map((u) => html`<option value=${u.unit} selected=${u.unit === menu}>${u.label}</option>`)))}</select>`}</div>
    ${wrong ? html`<div class="out small told" role="status">${wrong}</div>` : reading?.shown ? html`<div class="dim small" role="status" data-echo>= ${reading.shown}</div>` : ''}</div>`;
}
