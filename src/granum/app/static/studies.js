// Studies: what varies, what is watched; progress, cancel, and the outcome as charts and tables.
import { html, t, ask, useAnswer, useState, useEffect, useKept, settings, Working } from './core.js';
import { caseAt } from './drafts.js';
import { Quantity, inLanguage, joined, split } from './quantity.js';
import { Outcome, useJob } from './study_job.js';

const KINDS = [
  ['sweep', 'Sweep of one input'],
  ['map', 'Map of two inputs'],
  ['monte_carlo', 'Monte Carlo'],
  ['sobol', 'Where the variance comes from'],
  ['optimize', 'Optimum'],
];
const kindLabel = (kind) => t((KINDS.find(([name]) => name === kind) || ['', kind])[1]);
const doubtful = (kind) => kind === 'monte_carlo' || kind === 'sobol';

/** A fresh row for an input: bounds a tenth below and above its present value, in its own unit. */
function row(input) {
  const at = (number) => joined({ number: String(Number(number.toPrecision(4))), unit: input.unit });
  const value = Number(input.value);
  const degrees = input.unit === 'degC' || input.unit === 'degF';
  const [low, high] = degrees ? [value - 5, value + 5] : [0.9 * value, 1.1 * value];
  return {
    name: input.name,
    low: at(low),
    high: at(high),
    mean: joined({ number: input.value, unit: input.unit }),
    spread: degrees ? '1 kelvin' : at(Math.abs(0.05 * value)),
    law: 'normal',
    steps: '21',
  };
}

export function Studies({ state }) {
  const [list, setList] = useState(null);
  useEffect(() => {
    Promise.all([ask('/api/workspace'), ask('/api/examples')]).then(([own, shipped]) =>
      setList({ own: own.files || [], shipped: shipped.files }),
    );
  }, []);
  const place = state.key || 'card:particles.terminal_velocity';
  const {
    data: found,
    error,
    pending,
    cancel,
    job,
  } = useAnswer(
    (signal) => subjectOf(place, state.values, signal),
    [place, state.visit, settings.language, settings.units],
    0,
  );
  const go = (value) => {
    location.hash = `#/studies/${encodeURIComponent(value)}`;
  };
  const head = html`<h1>${t('Studies')}</h1>
    <div class="row"><label>${t('Study of')} <select value=${place} onChange=${(e) => go(e.target.value)}>
      <option value=${place.startsWith('card:') ? place : 'card:particles.terminal_velocity'}>${found?.choices.title && place.startsWith('card:') ? found.choices.title : t('Terminal velocity')}</option>
      ${place.startsWith('computer:') && html`<option value=${place} selected>${place.slice(9)}</option>`}
      ${list?.shipped.length > 0 && html`<optgroup label=${t('Examples')}>${list.shipped.map((f) => html`<option value=${'examples:' + f} selected=${place === 'examples:' + f}>${f}</option>`)}</optgroup>`}
      ${list?.own.length > 0 && html`<optgroup label=${t('Workspace')}>${list.own.map((f) => html`<option value=${'workspace:' + f} selected=${place === 'workspace:' + f}>${f}</option>`)}</optgroup>`}</select></label></div>
    ${found?.changed && html`<p class="small caution" data-changed>▲ ${t('With the changes made under Lines that are not saved.')}</p>`}`;
  const ready = found && found.place === place && !pending;
  return html`<main class="studies" id="main">${
    ready
      ? html`<${Form} key=${place + settings.language + settings.units + state.visit} place=${place} head=${head} subject=${found.subject} choices=${found.choices} />`
      : html`<section aria-label=${t('Enter')}>${head}${error && !pending ? html`<p class="message out" role="alert">${error.message}</p>` : html`<p class="dim" aria-busy="true">${t('Loading…')}</p><${Working} busy=${pending} cancel=${cancel} job=${job} />`}</section><section aria-label=${t('Believe')} />`
  }</main>`;
}

/** What is studied: a card with the values of the link, or a line as it stands on the screen, saved or not. */
async function subjectOf(place, values, signal) {
  const [sort, ...rest] = place.split(':');
  const { case: carried, ...inputs } = values;
  let subject = { card: rest.join(':'), inputs };
  let changed = false;
  if (sort !== 'card') {
    const found = await caseAt(place, carried, signal);
    subject = { case: found.text, place };
    changed = found.changed;
  } else if (!Object.keys(inputs).length) {
    const card = await ask(`/api/cards/${encodeURIComponent(subject.card)}`, undefined, { signal });
    subject.inputs = Object.fromEntries(
      card.parameters.filter((p) => p.example).map((p) => [p.name, joined(p.example)]),
    );
  }
  return { place, subject, changed, choices: await ask('/api/studies/choices', subject, { signal }) };
}

function Form({ place, head, subject, choices }) {
  const usable = choices.inputs.filter((i) => i.value !== '');
  const fresh = {
    kind: 'sweep',
    rows: usable.slice(0, 1).map(row),
    watched: choices.figures.slice(0, 1).map((f) => f.name),
    samples: '1000',
    sense: 'minimize',
    limits: [],
    declared: '',
  };
  const [stored, keep] = useKept('study ' + place, null);
  const setup = known(stored, usable, choices) ? stored : fresh;
  const set = (part) => keep({ ...setup, ...part });
  const { kind, rows, watched, samples, sense, limits } = setup;
  const wanted = kind === 'map' ? 2 : kind === 'sweep' ? 1 : null;
  const pick = (next) => {
    const count = next === 'map' ? 2 : next === 'sweep' ? 1 : rows.length;
    const spare = usable.filter((i) => !rows.some((r) => r.name === i.name));
    set({ kind: next, declared: '', rows: [...rows, ...spare.map(row)].slice(0, count) });
  };
  const change = (index, part) => set({ rows: rows.map((r, i) => (i === index ? { ...r, ...part } : r)) });
  const limit = (index, part) => set({ limits: limits.map((l, i) => (i === index ? { ...l, ...part } : l)) });
  const asked = setup.declared
    ? { ...subject, declared: setup.declared }
    : { ...subject, varied: rows.map((r) => r.name), table: declared(setup) };
  const job = useJob(place);
  const now = JSON.stringify(asked);
  const old = job.outcome && (job.asked !== now || job.running || Boolean(job.error));
  return html`<section aria-label=${t('Enter')}>${head}
    ${choices.declared.length > 0 && html`<h2>${t('Studies of this file')}</h2><div role="radiogroup" aria-label=${t('Studies of this file')}>${choices.declared.map((d) => html`<label class="choice line"><input type="radio" name="kind" data-declared=${d.name} checked=${setup.declared === d.name} onChange=${() => set({ declared: d.name })} /> <span>${d.title} <span class="dim small">${kindLabel(d.kind)}</span></span></label>`)}</div><h2>${t('Or another study')}</h2>`}
    <div class="row" role="radiogroup" aria-label=${t('Kind of study')}>${KINDS.map(([name, label]) => html`<label class="choice"><input type="radio" name="kind" data-kind=${name} checked=${!setup.declared && kind === name} onChange=${() => pick(name)} /> ${t(label)}</label>`)}</div>
    ${
      !setup.declared &&
      html`<h2>${t('What varies')}</h2>${rows.map((r, i) => html`<${Varied} key=${i + r.name} kind=${kind} row=${r} inputs=${usable} change=${(part) => change(i, part)} remove=${wanted || rows.length === 1 ? null : () => set({ rows: rows.filter((_, k) => k !== i) })} />`)}
    ${!wanted && rows.length < usable.length && html`<div class="row"><button class="button" onClick=${() => set({ rows: [...rows, row(usable.find((x) => !rows.some((r) => r.name === x.name)))] })}>${t('One more input')}</button></div>`}
    <h2>${kind === 'optimize' ? t('What is sought') : t('What is watched')}</h2>
    ${
      kind === 'optimize'
        ? html`<div class="row"><select aria-label=${t('Sense')} value=${sense} onChange=${(e) => set({ sense: e.target.value })}><option value="minimize" selected=${sense === 'minimize'}>${t('smallest')}</option><option value="maximize" selected=${sense === 'maximize'}>${t('largest')}</option></select>
        <${Figures} label=${t('Figure')} value=${watched[0]} figures=${choices.figures} onChange=${(name) => set({ watched: [name] })} /></div>
        ${limits.map((l, i) => html`<${Limit} key=${i + l.name} limit=${l} figures=${choices.figures} change=${(part) => limit(i, part)} remove=${() => set({ limits: limits.filter((_, k) => k !== i) })} />`)}
        <div class="row"><button class="button" onClick=${() => set({ limits: [...limits, { name: choices.figures[0].name, low: '', high: '' }] })}>${t('Add a limit')}</button></div>`
        : html`<div class="scroll watched" tabindex="0" role="group" aria-label=${t('What is watched')}>${choices.figures.map((f) => html`<label class="choice"><input type="checkbox" checked=${watched.includes(f.name)} onChange=${(e) => set({ watched: e.target.checked ? [...watched, f.name] : watched.filter((n) => n !== f.name) })} /> ${f.label}</label>`)}</div>`
    }
    ${doubtful(kind) && html`<div class="row"><label>${t('Samples')} <input class="short" inputmode="numeric" value=${samples} onInput=${(e) => set({ samples: e.target.value })} /></label></div>`}`
    }
    <div class="row"><button class="button main" disabled=${job.running || (!setup.declared && (!rows.length || !watched.length))} onClick=${() => job.start(asked, question(setup, choices))}>${t('Run the study')}</button></div></section>
    <section aria-label=${t('Believe')}><${Working} busy=${job.running} cancel=${job.cancel} share=${job.share} text=${job.note || t('Working…')} />
      ${job.error && html`<p class="message out" role="alert">${job.error}</p>`}
      ${!job.outcome && !job.running && !job.error && html`<p class="dim">${t('Choose what varies and what is watched, then run the study. Charts and tables appear here.')}</p>`}
      ${
        job.outcome &&
        html`${old && html`<p class="message caution" data-old>▲ ${t('What follows answers an earlier question. Run the study to answer the one on the left.')}</p>`}
        <div class=${old ? 'stale' : ''}><${Outcome} data=${job.outcome} question=${job.question} /></div>`
      }</section>`;
}

/** Whether a set-up of last time still speaks of inputs and figures that exist. */
function known(setup, inputs, choices) {
  return (
    setup &&
    setup.rows.length > 0 &&
    setup.rows.every((r) => inputs.some((i) => i.name === r.name)) &&
    [...setup.watched, ...setup.limits.map((l) => l.name)].every((name) =>
      choices.figures.some((f) => f.name === name),
    ) &&
    (!setup.declared || choices.declared.some((d) => d.name === setup.declared))
  );
}

/** A whole number as people type it, its thousands apart or not; anything else goes to the server as it is, which refuses it. */
const whole = (text) =>
  /^\s*(?:\d+|[1-9]\d{0,2}(?:\s\d{3})+)\s*$/.test(text) ? Number(text.replace(/\s/g, '')) : text;

function declared({ kind, rows, watched, samples, sense, limits }) {
  const by = (make) => Object.fromEntries(rows.map((r) => [r.name, make(r)]));
  if (kind === 'sweep' || kind === 'map')
    return { kind, outputs: watched, over: by((r) => ({ from: r.low, to: r.high, steps: whole(r.steps) })) };
  if (kind === 'optimize')
    return {
      kind,
      [sense]: watched[0],
      over: by((r) => ({ lower: r.low, upper: r.high })),
      ...(limits.length
        ? {
            limits: Object.fromEntries(
              limits.map((l) => [
                l.name,
                { ...(l.low && { lower: l.low }), ...(l.high && { upper: l.high }) },
              ]),
            ),
          }
        : {}),
    };
  const uncertain = by((r) =>
    r.law === 'uniform'
      ? { distribution: 'uniform', lower: r.low, upper: r.high }
      : { distribution: 'normal', mean: r.mean, standard_deviation: r.spread },
  );
  return { kind, outputs: watched, samples: whole(samples), uncertain };
}

const colon = () => (settings.language === 'fr' ? ' :' : ':');

/** The question in words, to stand above its answer. */
function question(setup, choices) {
  const one = choices.declared.find((d) => d.name === setup.declared);
  if (one) return { kind: kindLabel(one.kind), title: one.title, rows: [] };
  const figure = (name) => choices.figures.find((f) => f.name === name);
  const written = (text, quantity) => {
    const { number, unit } = split(text);
    return `${inLanguage(number)} ${quantity.units?.find((u) => u.unit === unit)?.label ?? unit}`.trim();
  };
  const range = (r) => {
    const { quantity, spread } = choices.inputs.find((i) => i.name === r.name);
    return doubtful(setup.kind) && r.law === 'normal'
      ? `${written(r.mean, quantity)} ± ${written(r.spread, spread)}`
      : `${written(r.low, quantity)} … ${written(r.high, quantity)}`;
  };
  const bounds =
    setup.kind === 'optimize'
      ? setup.limits.map(
          (l) =>
            `${figure(l.name).label}${colon()} ${[l.low && `${t('at least')} ${written(l.low, figure(l.name).quantity)}`, l.high && `${t('at most')} ${written(l.high, figure(l.name).quantity)}`].filter(Boolean).join(', ')}`,
        )
      : [];
  return {
    kind: kindLabel(setup.kind),
    title: setup.watched.map((name) => figure(name).label).join(', '),
    rows: [
      ...setup.rows.map(
        (r) => `${choices.inputs.find((i) => i.name === r.name).label}${colon()} ${range(r)}`,
      ),
      ...bounds,
      ...(doubtful(setup.kind) ? [`${t('Samples')}${colon()} ${setup.samples}`] : []),
    ],
  };
}

function Varied({ kind, row: r, inputs, change, remove }) {
  const input = inputs.find((i) => i.name === r.name);
  const field = (name, label, quantity = input.quantity) =>
    html`<div class="small part"><span>${label}</span> <div data-part=${name}><${Quantity} p=${quantity} label=${`${input.label}, ${label}`} text=${r[name]} onChange=${(text) => change({ [name]: text })} /></div></div>`;
  return html`<div class="varied"><div class="row"><select aria-label=${t('Input')} value=${r.name} onChange=${(e) => change(row(inputs.find((i) => i.name === e.target.value)))}>${inputs.map((i) => html`<option value=${i.name} selected=${i.name === r.name}>${i.label}</option>`)}</select>
    <span class="small dim">${t('now')} ${input.shown}</span>${remove && html`<button class="button" onClick=${remove}>${t('Remove')}</button>`}</div>
    ${doubtful(kind) && html`<div class="row"><select aria-label=${t('Distribution')} value=${r.law} onChange=${(e) => change({ law: e.target.value })}><option value="normal" selected=${r.law === 'normal'}>${t('normal')}</option><option value="uniform" selected=${r.law === 'uniform'}>${t('uniform')}</option></select></div>`}
    ${doubtful(kind) && r.law === 'normal' ? html`${field('mean', t('mean'))}${field('spread', t('standard deviation'), input.spread)}` : html`${field('low', t('from'))}${field('high', t('to'))}`}
    ${(kind === 'sweep' || kind === 'map') && html`<label class="small part"><span>${t('steps')}</span> <input class="short" inputmode="numeric" data-part="steps" value=${r.steps} onInput=${(e) => change({ steps: e.target.value })} /></label>`}</div>`;
}

function Limit({ limit, figures, change, remove }) {
  const figure = figures.find((f) => f.name === limit.name);
  const field = (name, label) =>
    html`<div class="small part"><span>${label}</span> <div data-limit=${name}><${Quantity} p=${figure.quantity} label=${`${figure.label}, ${label}`} text=${limit[name]} onChange=${(text) => change({ [name]: text })} /></div></div>`;
  return html`<div class="varied"><div class="row"><${Figures} label=${t('Figure')} value=${limit.name} figures=${figures} onChange=${(name) => change({ name, low: '', high: '' })} /> <button class="button" onClick=${remove}>${t('Remove')}</button></div>
    ${field('low', t('at least'))}${field('high', t('at most'))}</div>`;
}

function Figures({ label, value, figures, onChange }) {
  return html`<select aria-label=${label} value=${value} onChange=${(e) => onChange(e.target.value)}>${figures.map((f) => html`<option value=${f.name} selected=${f.name === value}>${f.label}</option>`)}</select>`;
}
