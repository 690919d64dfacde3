// Calculate: find a card, enter values, believe the result. Up to three cases side by side.
import {
  Awaited,
  html,
  t,
  ask,
  link,
  useAnswer,
  useCopying,
  useState,
  useEffect,
  useRef,
  useKept,
  replaceLink,
  download,
  settings,
  Working,
} from './core.js';
import { Chapter } from './chapter.js';
import { Plot, decoded } from './plot.js';
import { Fields, changed, fields, missingOf, ordinary } from './form.js';
import { Finder, NoCard, useCards } from './cards.js';
import { Result } from './result.js';
import { Quantity, joined } from './quantity.js';
import { States, statesOf } from './states.js';

export const CALCULATED = (c) => (c.sort === 'formula' || c.sort === 'procedure') && !isSelection(c);
/** Selection guides are the procedures whose name says that they choose. */
export const isSelection = (c) => c.sort === 'procedure' && /^choose|_choice$/.test(c.card.split('.')[1]);

export function Calculate({
  state,
  page = 'calculate',
  keep = CALCULATED,
  first = 'particles.terminal_velocity',
}) {
  const cards = useCards(keep);
  const key = state.key || (cards?.some((c) => c.card === first) ? first : cards?.[0]?.card);
  const { data: card, error } = useAnswer(
    (signal) =>
      key ? ask(`/api/cards/${encodeURIComponent(key)}`, undefined, { signal }) : Promise.resolve(null),
    [key, settings.language, settings.units],
    0,
  );
  const ready = card && card.card === key;
  return html`<main class=${page === 'charts' ? 'three chart' : 'three'} id="main"><${Finder} page=${page} current=${key} cards=${cards} />
    ${
      error
        ? html`<${NoCard} heading=${t({ charts: 'Charts', select: 'Select' }[page] ?? 'Calculate')} error=${error} />`
        : ready
          ? html`<${Work} key=${`${key} ${settings.language} ${settings.units} ${state.visit}`} page=${page} card=${card} given=${state.values} />`
          : html`<section aria-label=${t('Enter')}><${Awaited} text=${key ? t('The card is on its way…') : t('The list of cards is on its way…')} /></section><section />`
    }</main>`;
}

function Work({ page, card, given }) {
  const names = new Set(fields(card, card.parameters).map((p) => p.name));
  const start = Object.fromEntries(Object.entries(given).filter(([name]) => names.has(name)));
  const [values, setValues] = useState(Object.keys(start).length ? start : ordinary(card));
  const [past, setPast] = useState([]);
  const [kept, setKept] = useKept('compared ' + card.card, []);
  const edited = useRef('');
  const [copied, copy] = useCopying();
  useEffect(() => replaceLink(page, card.card, values), [values]);
  const kind = card.sort === 'chart' ? 'chart' : 'calc';
  const missing = missingOf(card, card.parameters, values);
  const answer = useAnswer(
    (signal) =>
      missing.length ? Promise.resolve(null) : ask(`/api/${kind}/${card.card}`, values, { signal }),
    [JSON.stringify(values)],
  );
  const others = useAnswer(
    (signal) => Promise.all(kept.map((given) => ask(`/api/calc/${card.card}`, given, { signal }))),
    [JSON.stringify(kept)],
    0,
  );
  const [laws, setLaws] = useState(false); // whether those of others are open: kept while a field is empty and no result stands
  const set = (next, name = '', understood = false) => {
    // what is typed in one field in one go is one step back; that it was understood is none
    if (!understood) {
      if (!name || edited.current !== name) setPast([...past.slice(-50), values]);
      edited.current = name;
    }
    setValues(next);
  };
  const results = card.outputs?.filter((p) => p.kind && !p.series) ?? [];
  const othersGiven = (name) =>
    missingOf(card, card.parameters, { ...values, [name]: '' }).every((p) => p.name === name);
  const { sought, solved, finder, change, stop } = useSeek({
    card,
    values,
    ready: othersGiven,
    put: (name, text) => set({ ...values, [name]: text }, name),
    start: (p, before) => {
      const output = before?.output || results[0].name;
      return { name: p.name, output, text: written(answer.data, output) };
    },
    seekable: (p) => kind === 'calc' && results.length > 0 && seekable(p),
  });
  const wrong = fields(card, card.parameters).find((p) => p.name === answer.error?.details?.name);
  const process = kind === 'chart' && names.has('temperature') && names.has('humidity_ratio');
  // Lists that were opened as lists stay so while somebody types in them.
  const [asTable] = useState(() => process && statesOf(values) !== null);
  const states = asTable ? statesOf(values) : null;
  const inForm = fields(card, card.parameters).filter((p) => !states || !(p.name in STATES));
  const addState = (x, y) => {
    const found = stateAt(answer.data, x, y);
    if (found)
      set({
        ...values,
        temperature: appended(values.temperature, found.celsius, 'degC'),
        humidity_ratio: appended(values.humidity_ratio, found.grams, 'g/kg'),
      });
  };
  const sheet = async (shown) => {
    const body = { ...shown, inputs: values, link: location.href };
    download(`${card.card}.html`, await ask(`/api/sheet/${card.card}`, body, { text: true }), 'text/html');
  };
  return html`<section aria-label=${t('Enter')}><h1>${card.title}</h1><p class="dim">${card.summary} <${Chapter} card=${card.card} /></p>
      <form onSubmit=${(e) => e.preventDefault()} onfocusout=${() => {
        edited.current = '';
      }}><${Fields} card=${card} all=${inForm} values=${values} onChange=${(p, text, understood) => {
        if (p.name === sought?.name && !understood) stop();
        set((before) => changed(before, p, text), p.name, understood);
      }} aside=${finder} wrong=${wrong} error=${answer.error?.message} /></form>
      <div class="row"><button class="button" disabled=${!past.length} onClick=${() => {
        edited.current = '';
        setValues(past.at(-1));
        setPast(past.slice(0, -1));
      }}>${t('Undo')}</button>
      <button class="button" onClick=${() => set(ordinary(card))}>${t('Example values')}</button>
      <button class="button" onClick=${copy}>${t('Copy link')}</button>${kind === 'calc' && html` <a class="button" href=${link('studies', 'card:' + card.card, resolved(values, answer.data))}>${t('Study')}</a>`} <span role="status" class="small dim">${copied}</span></div></section>
    <section aria-label=${t('Believe')}>
      ${sought && html`<${Seek} results=${results} sought=${sought} change=${change} stop=${stop} solved=${solved} label=${card.parameters.find((p) => p.name === sought.name).label} />`}
      <div aria-live="polite">${answer.error && (wrong ? html`<p class="message out told">${t('Nothing is calculated before this is mended: {name}', { name: wrong.label })}</p>` : html`<p class="message out">${answer.error.message}</p>`)}
        ${missing.length > 0 && html`<p class="message dim">${t('Still to be given: {names}', { names: missing.map((p) => p.label).join(', ') })}</p>`}</div>
      <${Working} busy=${answer.pending} cancel=${answer.cancel} job=${answer.job} />
      <div class=${answer.pending || answer.error ? 'stale' : ''} aria-busy=${String(answer.pending)}>
      ${
        answer.data &&
        (kind === 'chart'
          ? html`<${Plot} figure=${answer.data} label=${card.title} name=${card.card} onPoint=${process ? (x, y) => addState(x, y) : null} tables=${!states} />`
          : html`<${Result} card=${card} values=${values} data=${answer.data} old=${answer.pending || Boolean(answer.error)} kept=${others.data || []} keep=${() => setKept([...kept, values])} clear=${() => setKept([])} choose=${set} laws=${laws} setLaws=${setLaws} sheet=${sheet} />`)
      }</div>
      ${states && html`<${States} values=${values} states=${states} figure=${answer.data} set=${set} />`}
      ${process && !states && html`<div class="row"><span class="small dim">${t('Click on the chart to add a state of a process.')}</span> <button class="button" disabled=${!values.temperature && !values.humidity_ratio} onClick=${() => set({ ...values, temperature: '', humidity_ratio: '' })}>${t('Clear the process')}</button></div>`}
      ${kind === 'chart' && html`<p class="small dim">${card.citation}</p>`}</section>`;
}

/** A result as a field takes it, to start from. */
function written(data, name) {
  const unit = data?.shown.find((row) => row.name === name)?.units[0];
  return unit
    ? joined({ number: unit.full.replace(',', '.'), unit: unit.unit === 'dimensionless' ? '' : unit.unit })
    : '';
}

/** Whether an input can be found for a wanted result. */
export const seekable = (p) => p.kind && !p.series && !p.options?.length && p.sort !== 'int';

/**
 * An input that is sought for a wanted result: which one, what the server finds, the button that asks for it. `start` says
 * for which result, `put` takes what is found, `ready` whether the other inputs are given.
 */
export function useSeek({ card, values, ready = () => true, put, start, seekable: may }) {
  const [sought, setSought] = useState(null);
  const asks = Boolean(sought?.text && ready(sought.name));
  const solved = useAnswer(
    (signal) =>
      asks
        ? ask(
            `/api/solve/${card.card}`,
            { inputs: values, find: sought.name, output: sought.output, wanted: sought.text },
            { signal },
          )
        : Promise.resolve(null),
    [JSON.stringify([asks, sought, { ...values, [sought?.name]: '' }])],
    150,
  );
  useEffect(() => {
    if (solved.data && !solved.pending) put(sought.name, solved.data.text);
  }, [solved.data]);
  const seek = (p) => setSought(sought?.name === p.name ? null : start(p, sought));
  const finder = (p) =>
    may(p) &&
    html`<button type="button" class="find-input" aria-pressed=${String(sought?.name === p.name)} title=${t('Find the value that gives a wanted result')} aria-label=${t('Find {name} for a wanted result', { name: p.label })} onClick=${() => seek(p)}>${t('find')}</button>`;
  const change = (part) => setSought({ ...sought, ...part });
  return { sought, solved, finder, change, stop: () => setSought(null) };
}

/** The wanted result, typed where the result stands; the input is found. */
export function Seek({ results, sought, change, stop, solved, label }) {
  const p = results.find((q) => q.name === sought.output);
  return html`<div class="sought" data-seek=${sought.name}><div class="row"><strong>${t('Find {name} for', { name: label })}</strong>${
    results.length > 1
      ? html`<select aria-label=${t('Wanted result')} value=${p.name} onChange=${(e) => change({ output: e.target.value, text: '' })}>${results.map((q) => html`<option value=${q.name} selected=${q.name === p.name}>${q.label}</option>`)}</select>`
      : html`<label for="wanted">${p.label}</label>`
  } =</div><div class="row"><${Quantity} key=${p.name} p=${p} id="wanted" note="wanted-note" text=${sought.text} onChange=${(text) => change({ text })} label=${p.label} /><button class="button" onClick=${stop}>${t('Done')}</button></div>
    <p id="wanted-note" class=${solved.error ? 'small out' : 'small dim'} role="status">${solved.error ? solved.error.message : solved.pending ? '' : (solved.data?.shown ?? '')}</p></div>`;
}

const STATES = { temperature: true, humidity_ratio: true };

/** Values for pages that take numbers only: the properties that a fluid gave in its place, the middles of intervals. */
function resolved(values, data) {
  if (!data?.inputs) return values;
  const { fluid, ...rest } = values;
  const given = Object.entries(data.inputs)
    .filter(([name, input]) => (fluid?.trim() && input?.from) || /±|\+\/?-|\.\.|…/.test(rest[name] ?? ''))
    .map(([name, input]) => [name, `${input.value} ${input.unit ?? ''}`.trim()]);
  return { ...rest, ...Object.fromEntries(given) };
}

/** Temperature and humidity ratio at a place of a chart of humid gas: a plane through the nearest places of the grid that the chart carries. */
function stateAt(figure, x, y) {
  const grid = figure.data.find((trace) => trace.customdata && trace.mode === 'markers');
  if (!grid) return null;
  const [gx, gy] = [decoded(grid.x), decoded(grid.y)];
  const rows = Array.isArray(grid.customdata) ? grid.customdata : rowsOf(grid.customdata);
  const [spanX, spanY] = ['xaxis', 'yaxis'].map((axis) =>
    Math.abs(figure.layout[axis].range[1] - figure.layout[axis].range[0]),
  );
  const near = gx
    .map((_, i) => i)
    .sort((a, b) => far(a) - far(b))
    .slice(0, 6);
  function far(i) {
    return ((gx[i] - x) / spanX) ** 2 + ((gy[i] - y) / spanY) ** 2;
  }
  if (far(near[0]) > 0.03 ** 2) return null; // fog, or beside the chart
  const plane = (k) => fitPlane(near.map((i) => [(gx[i] - x) / spanX, (gy[i] - y) / spanY, rows[i][k]]));
  return { celsius: plane(0), grams: Math.max(0, plane(1)) };
}

/** Value at the origin of the plane through points (x, y, z), least squares; the nearest point's value when they lie on a line. */
function fitPlane(points) {
  const sum = (f) => points.reduce((total, p) => total + f(p), 0);
  const [n, sx, sy, sz] = [points.length, sum((p) => p[0]), sum((p) => p[1]), sum((p) => p[2])];
  const [xx, xy, yy, xz, yz] = [
    sum((p) => p[0] * p[0]),
    sum((p) => p[0] * p[1]),
    sum((p) => p[1] * p[1]),
    sum((p) => p[0] * p[2]),
    sum((p) => p[1] * p[2]),
  ];
  const minor = xx * yy - xy * xy;
  const whole = n * minor - sx * (sx * yy - xy * sy) + sy * (sx * xy - xx * sy);
  if (Math.abs(whole) < 1e-14 * n * (xx + yy) ** 2) return points[0][2];
  return (sz * minor - sx * (xz * yy - xy * yz) + sy * (xz * xy - xx * yz)) / whole;
}

function rowsOf(packed) {
  const flat = decoded(packed);
  const width = Number(String(packed.shape).split(',')[1]);
  return Array.from({ length: flat.length / width }, (_, i) => flat.slice(i * width, (i + 1) * width));
}

/** A list with one more number; a list in another unit starts again. */
function appended(text, value, unit) {
  const shown = String(Number(value.toPrecision(3)));
  const before = text?.endsWith(` ${unit}`) ? text.slice(0, -unit.length - 1) : '';
  return `${before ? before + ' ' : ''}${shown} ${unit}`;
}
