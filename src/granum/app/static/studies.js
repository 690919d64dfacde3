// Studies: what varies, what is watched; progress, cancel, the outcome as charts and tables, and past studies.
import {
  html,
  t,
  ask,
  link,
  useAnswer,
  useState,
  useEffect,
  useKept,
  useRef,
  remember,
  settings,
  Working,
} from './core.js';
import { byTitle, caseAt, OwnLines } from './drafts.js';
import { Quantity, joined, settled } from './quantity.js';
import { Outcome, lastStudied, showStudy, useJob } from './study_job.js';
import { Past, usePast } from './study_history.js';
import {
  KINDS,
  designed,
  doubtful,
  explained,
  kindLabel,
  limited,
  newCase,
  possible,
  question,
  renewed,
  row,
  table,
  usable as usableOf,
  wantedInputs,
} from './study_setup.js';

/** The page of studies; opened bare it is at the study that runs, or was started last. */
export function Studies({ state }) {
  const last = state.key ? null : lastStudied();
  useEffect(() => {
    if (last) location.replace(last);
  }, [last]);
  return last ? null : html`<${Study} state=${state} />`;
}

function Study({ state }) {
  const [list, setList] = useState(null);
  useEffect(() => {
    Promise.all([ask('/api/workspace'), ask('/api/examples')]).then(([own, shipped]) =>
      setList({ own: own.files || [], shipped: shipped.files, titles: shipped.titles }),
    );
  }, [settings.language]);
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
    location.hash = link('studies', value);
  };
  const head = html`<h1>${t('Studies')}</h1>
    <div class="row"><label>${t('Study of')} <select value=${place} onChange=${(e) => go(e.target.value)}>
      ${place.startsWith('card:') && html`<option value=${place} selected>${found?.choices.title ?? place.slice(5)}</option>`}
      <${OwnLines} place=${place} />
      ${list?.shipped.length > 0 && html`<optgroup label=${t('Examples')}>${byTitle(list).map((f) => html`<option value=${'examples:' + f} selected=${place === 'examples:' + f}>${list.titles[f] || f}</option>`)}</optgroup>`}
      ${list?.own.length > 0 && html`<optgroup label=${t('Workspace')}>${list.own.map((f) => html`<option value=${'workspace:' + f} selected=${place === 'workspace:' + f}>${f}</option>`)}</optgroup>`}</select></label> <${Cards} go=${go} /></div>
    ${found?.changed && html`<p class="small caution" data-changed>▲ ${t('With the changes made under Lines that are not saved.')}</p>`}`;
  const ready = found && found.place === place && !pending;
  return html`<main class="studies" id="main">${
    ready
      ? html`<${Form} key=${place + settings.language + settings.units + state.visit} place=${place} head=${head} subject=${found.subject} choices=${found.choices} />`
      : html`<section aria-label=${t('Enter')}>${head}${error && !pending ? html`<p class="message out" role="alert">${error.message}</p>` : html`<div aria-busy="true"><${Working} busy=${pending} from=${0} text=${t('Reading what may vary and what may be watched…')} cancel=${cancel} job=${job} /></div>`}</section><section aria-label=${t('Believe')} />`
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

/** Any formula or procedure, found by its title. */
function Cards({ go }) {
  const [cards, setCards] = useState([]);
  const load = () =>
    cards.length ||
    ask('/api/cards').then((found) =>
      setCards(found.cards.filter((c) => c.sort === 'formula' || c.sort === 'procedure')),
    );
  const named = (c) => `${c.title} · ${t(c.domain)}`;
  const choose = (text) => {
    const found = cards.find((c) => named(c) === text);
    if (found) go('card:' + found.card);
  };
  return html`<label class="screen">${t('or of a card')} <input type="search" list="study-cards" placeholder=${t('Type its title')} data-cards onFocus=${load} onInput=${(e) => choose(e.target.value)} /></label><datalist id="study-cards">${cards.map((c) => html`<option value=${named(c)} />`)}</datalist>`;
}

function Form({ place, head, subject, choices }) {
  const usable = usableOf(choices);
  const [stored, keep] = useKept('study ' + place, null);
  const setup = renewed(stored, choices);
  const set = (part) => keep({ ...setup, ...part });
  const { kind, rows, watched } = setup;
  const wanted = wantedInputs(kind);
  const pick = (next) => {
    const count = wantedInputs(next) ?? rows.length;
    const spare = usable.filter((i) => !rows.some((r) => r.name === i.name));
    const part = { kind: next, declared: '', rows: [...rows, ...spare.map(row)].slice(0, count) };
    const made = { ...setup, ...part };
    set(next === 'scenarios' && !setup.cases.length ? { ...part, cases: [newCase(made, choices)] } : part);
  };
  const change = (index, part) => set({ rows: rows.map((r, i) => (i === index ? { ...r, ...part } : r)) });
  const asked = setup.declared
    ? { ...subject, declared: setup.declared }
    : { ...subject, varied: rows.map((r) => r.name), table: table(setup) };
  const job = useJob(place);
  const past = usePast();
  const latest = past.find((study) => study.place === place);
  useEffect(() => {
    if (latest && !job.outcome && !job.running && !job.error) showStudy(latest);
  }, [latest?.id]);
  const open = (study) => {
    showStudy(study);
    if (study.place === place) keep(study.setup);
    else {
      remember('study ' + study.place, study.setup);
      location.hash = link('studies', study.place);
    }
  };
  const [starting, setStarting] = useState(false);
  const whole = useRef(null);
  whole.current = { asked, setup };
  const run = async () => {
    setStarting(true);
    await settled(); // the field that was left by pressing the button
    setStarting(false);
    job.start(whole.current.asked, question(whole.current.setup, choices), whole.current.setup);
  };
  const now = JSON.stringify(asked);
  const old = job.outcome && (job.asked !== now || job.running || Boolean(job.error));
  const lacking =
    !setup.declared && (!rows.length || !watched.length || (kind === 'scenarios' && !setup.cases.length));
  return html`<section aria-label=${t('Enter')}>${head}
    ${choices.declared.length > 0 && html`<h2>${t('Studies of this file')}</h2><div role="radiogroup" aria-label=${t('Studies of this file')}>${choices.declared.map((d) => html`<label class="choice line"><input type="radio" name="kind" data-declared=${d.name} checked=${setup.declared === d.name} onChange=${() => set({ declared: d.name })} /> <span>${d.title} <span class="dim small">${kindLabel(d.kind)}</span></span></label>`)}</div><h2>${t('Or another study')}</h2>`}
    <div class="segments" role="radiogroup" aria-label=${t('Kind of study')}>${possible(choices).map(([name, label]) => html`<label class=${!setup.declared && kind === name ? 'segment on' : 'segment'}><input type="radio" name="kind" data-kind=${name} checked=${!setup.declared && kind === name} onChange=${() => pick(name)} />${t(label)}</label>`)}</div>
    ${
      !setup.declared &&
      html`<p class="small dim">${t(KINDS.find(([name]) => name === kind)[2])}</p>
    <h2>${t('What varies')}</h2>${rows.map((r, i) => html`<${Varied} key=${i + r.name} kind=${kind} row=${r} inputs=${usable} change=${(part) => change(i, part)} remove=${wanted || rows.length === 1 ? null : () => set({ rows: rows.filter((_, k) => k !== i) })} />`)}
    ${!wanted && rows.length < usable.length && html`<div class="row"><button class="button" onClick=${() => set({ rows: [...rows, row(usable.find((x) => !rows.some((r) => r.name === x.name)))] })}>${t('One more input')}</button></div>`}
    ${kind === 'scenarios' && html`<${Scenarios} setup=${setup} choices=${choices} set=${set} />`}
    <${Sought} setup=${setup} figures=${choices.figures} set=${set} />
    ${limited(kind) && html`<${Limits} setup=${setup} figures=${choices.figures} set=${set} />`}
    ${doubtful(kind) && html`<div class="row"><label>${t('Samples')} <input class="short" inputmode="numeric" value=${setup.samples} onInput=${(e) => set({ samples: e.target.value })} /></label></div>`}
    ${kind === 'sobol' && designed(setup) && html`<p class="small dim" data-design>${explained(designed(setup))}</p>`}`
    }
    <div class="row"><button class="button main" disabled=${job.running || starting || lacking} onClick=${run}>${t('Run the study')}</button></div>
    <p class="small dim screen">${t('A study runs on when you leave this page or close it; after an hour it is stopped, and what it has computed is kept.')}</p>
    <${Past} past=${past} open=${open} /></section>
    <section aria-label=${t('Believe')}><${Working} busy=${job.running} cancel=${job.cancel} share=${job.share} text=${job.note || t('Working…')} />
      ${job.running && job.partly && html`<div class="row"><${Look} look=${job.look} again=${Boolean(job.part)} /></div>`}
      ${job.error && html`<p class="message out" role="alert">${job.error}</p>`}
      ${!job.outcome && !job.running && !job.error && html`<p class="dim">${t('Choose what varies and what is watched, then run the study. Charts and tables appear here.')}</p>`}
      ${job.unkept && html`<p class="message caution">▲ ${t('This browser could not keep the result: download the cases before you leave.')}</p>`}
      ${
        job.running && job.part
          ? html`<div data-so-far><${Outcome} data=${job.part} question=${job.asking} /></div>`
          : job.outcome &&
        html`${old && html`<p class="message caution" data-old>▲ ${t('What follows answers an earlier question. Run the study to answer the one on the left.')}</p>`}
        <div class=${old ? 'stale' : ''}><${Outcome} data=${job.outcome} question=${job.question} /></div>`
      }</section>`;
}

/** What there is of a study that runs, for whoever wants to know before its end. */
function Look({ look, again }) {
  const [busy, setBusy] = useState(false);
  return html`<button class="button" disabled=${busy} onClick=${() => {
    setBusy(true);
    look().finally(() => setBusy(false));
  }}>${busy ? t('Reading…') : again ? t('Show what there is by now') : t('Show what there is so far')}</button>`;
}

/** The figures that are watched, or those that are to be smallest or largest. */
function Sought({ setup, figures, set }) {
  const { kind, watched } = setup;
  const one = (sense, name, change) =>
    html`<div class="row" key=${name + sense}><select aria-label=${t('Sense')} value=${sense} onChange=${(e) => change({ sense: e.target.value })}><option value="minimize" selected=${sense === 'minimize'}>${t('smallest')}</option><option value="maximize" selected=${sense === 'maximize'}>${t('largest')}</option></select>
      <${Figures} label=${t('Figure')} value=${name} figures=${figures} onChange=${(next) => change({ name: next })} /></div>`;
  if (kind === 'optimize' || kind === 'pareto')
    return html`<h2>${t('What is sought')}</h2>${one(setup.sense, watched[0], ({ sense, name }) => set({ ...(sense && { sense }), ...(name && { watched: [name] }) }))}
      ${kind === 'pareto' && one(setup.sense_second, setup.second, ({ sense, name }) => set({ ...(sense && { sense_second: sense }), ...(name && { second: name }) }))}`;
  return html`<h2>${t('What is watched')}</h2><div key="watched" class="scroll watched" tabindex="0" role="group" aria-label=${t('What is watched')}>${figures.map((f) => html`<label class="choice"><input type="checkbox" checked=${watched.includes(f.name)} onChange=${(e) => set({ watched: e.target.checked ? [...watched, f.name] : watched.filter((n) => n !== f.name) })} /> ${f.label}</label>`)}</div>`;
}

/** Limits of figures: kept by an optimum, hatched on a map, their chance found by Monte Carlo. */
function Limits({ setup, figures, set }) {
  const { limits, kind } = setup;
  const limit = (index, part) => set({ limits: limits.map((l, i) => (i === index ? { ...l, ...part } : l)) });
  return html`${limits.length > 0 && html`<h2>${kind === 'monte_carlo' ? t('How likely is it that') : t('Limits to keep')}</h2>`}
    ${limits.map((l, i) => html`<${Limit} key=${i + l.name} limit=${l} figures=${figures} change=${(part) => limit(i, part)} remove=${() => set({ limits: limits.filter((_, k) => k !== i) })} />`)}
    <div class="row"><button class="button" onClick=${() => set({ limits: [...limits, { name: figures[0].name, low: '', high: '' }] })}>${t('Add a limit')}</button></div>`;
}

function Scenarios({ setup, choices, set }) {
  const { cases, rows } = setup;
  const change = (index, part) => set({ cases: cases.map((c, i) => (i === index ? { ...c, ...part } : c)) });
  return html`<h2>${t('Cases')}</h2>${cases.map(
    (c, i) =>
      html`<div class="varied" key=${i} data-case=${i}><div class="row"><input aria-label=${t('Name of the case')} value=${c.name} onInput=${(e) => change(i, { name: e.target.value })} />${cases.length > 1 && html`<button class="button" onClick=${() => set({ cases: cases.filter((_, k) => k !== i) })}>${t('Remove')}</button>`}</div>
      ${rows.map((r) => {
        const input = choices.inputs.find((x) => x.name === r.name);
        return html`<div class="small part" key=${r.name}><span>${input.label}</span> <div><${Quantity} p=${input.quantity} label=${`${c.name}, ${input.label}`} text=${c.values[r.name] ?? ''} onChange=${(text) => change(i, { values: { ...c.values, [r.name]: text } })} /></div></div>`;
      })}</div>`,
  )}
    <div class="row"><button class="button" onClick=${() => set({ cases: [...cases, newCase(setup, choices)] })}>${t('One more case')}</button></div>`;
}

function Varied({ kind, row: r, inputs, change, remove }) {
  const input = inputs.find((i) => i.name === r.name);
  const field = (name, label, quantity = input.quantity) =>
    html`<div class="small part"><span>${label}</span> <div data-part=${name}><${Quantity} p=${quantity} label=${`${input.label}, ${label}`} text=${r[name]} onChange=${(text) => change({ [name]: text })} /></div></div>`;
  return html`<div class="varied"><div class="row"><select aria-label=${t('Input')} value=${r.name} onChange=${(e) => change(row(inputs.find((i) => i.name === e.target.value)))}>${inputs.map((i) => html`<option value=${i.name} selected=${i.name === r.name}>${i.label}</option>`)}</select>
    <span class="small dim">${t('now')} ${input.shown}</span>${remove && html`<button class="button" onClick=${remove}>${t('Remove')}</button>`}</div>
    ${doubtful(kind) && html`<div class="row"><select aria-label=${t('Distribution')} value=${r.law} onChange=${(e) => change({ law: e.target.value })}><option value="normal" selected=${r.law === 'normal'}>${t('normal')}</option><option value="uniform" selected=${r.law === 'uniform'}>${t('uniform')}</option></select></div>`}
    ${kind === 'scenarios' ? '' : doubtful(kind) && r.law === 'normal' ? html`${field('mean', t('mean'))}${field('spread', t('standard deviation'), input.spread)}` : html`${field('low', t('from'))}${field('high', t('to'))}`}
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
