// Lines: open or write a case file, edit it through forms made from the declarations, solve it, click through units and streams, compare, report.
import {
  html,
  t,
  ask,
  link,
  useState,
  useEffect,
  useRef,
  remember,
  recall,
  replaceLink,
  download,
  stoppable,
  Working,
} from './core.js';
import { Plot } from './plot.js';
import { caseAt, keepDraft, packed } from './drafts.js';
import { Field } from './form.js';
import { Utilities } from './utilities.js';

const MOST_KEPT = 2;
const NEW = 'computer:line.toml'; // the place of a text that is no file yet
const address = (path) => `/api/workspace/${path.split('/').map(encodeURIComponent).join('/')}`;

export function Lines({ state }) {
  const [list, setList] = useState(null);
  const [path, setPath] = useState(state.key || '');
  const [place, setPlace] = useState('');
  const [text, setText] = useState('');
  const [past, setPast] = useState([]);
  const [outcome, setOutcome] = useState(null);
  const [solved, setSolved] = useState('');
  const [typing, setTyping] = useState(false);
  const [form, setForm] = useState(null);
  const [error, setError] = useState(null);
  const [busy, setBusy] = useState(false);
  const [told, setTold] = useState('');
  const [carried, setCarried] = useState('');
  const [taken, setTaken] = useState(false);
  const [kept, setKept] = useState([]);
  const stop = useRef(null);
  const latest = useRef('');
  const saved = useRef('');
  const where = useRef('');
  const waiting = useRef(0);
  const due = useRef(new Map());
  const written = useRef(Promise.resolve());
  const files = () =>
    Promise.all([ask('/api/workspace'), ask('/api/examples')]).then(([own, shipped]) =>
      setList({ own: own.files, shipped: shipped.files, titles: shipped.titles }),
    );
  useEffect(() => {
    files();
    return () => stop.current?.abort();
  }, []);
  useEffect(() => {
    if (state.key.includes(':')) open(state.key, state.values.case);
  }, [state.visit]);
  /** The link and the draft follow what is on the screen, so that a reload, another page or another person finds it. */
  const follow = async (next) => {
    const changed = next !== saved.current || where.current.startsWith('computer:');
    keepDraft(where.current, changed ? next : null);
    const short = changed ? await packed(next) : '';
    if (latest.current !== next) return short;
    setCarried(short);
    replaceLink('lines', where.current, { case: short });
    return short;
  };
  const settle = (next) => {
    where.current = next;
    setPlace(next);
  };
  const shown = (next) => {
    latest.current = next;
    setText(next);
    ask('/api/case/form', { case: next }).then(
      (found) => {
        if (latest.current === next) setForm(found);
      },
      () => setForm(null),
    );
  };
  const change = (next) => {
    if (!where.current) settle(NEW);
    setPast((before) => [...before.slice(-50), latest.current]);
    shown(next);
    follow(next);
  };
  const open = async (wanted, link = '') => {
    if (!wanted) return;
    try {
      const found = await caseAt(wanted, link);
      if (wanted !== where.current) {
        drop();
        setKept(recall('compared ' + wanted, []));
        setOutcome(null);
        setPast(found.changed ? [found.saved] : []);
      }
      settle(wanted);
      saved.current = found.saved;
      setPath(wanted.slice(wanted.indexOf(':') + 1));
      setError(null);
      setTaken(false);
      setTold(found.changed ? t('With the changes of last time; Undo takes them back.') : '');
      shown(found.text);
      follow(found.text);
      solve(found.text);
    } catch (problem) {
      setError(problem);
    }
  };
  const read = async (list) => {
    if (!list?.length) return;
    const next = await list[0].text();
    keepDraft('computer:' + list[0].name, next);
    open('computer:' + list[0].name);
  };
  const working = async (work) => {
    stop.current?.abort();
    const mine = stoppable();
    stop.current = mine;
    setBusy(true);
    setError(null);
    try {
      await work(mine.signal, () => stop.current === mine);
    } catch (problem) {
      if (problem.name !== 'AbortError') setError(problem);
    } finally {
      if (stop.current === mine) setBusy(false);
    }
  };
  const solve = (given) =>
    working(async (signal, current) => {
      const found = await ask('/api/run', { case: given, place: where.current }, { signal });
      if (current()) {
        setOutcome(found);
        setSolved(given);
      }
    });
  const edit = async (table, name, key, value) => {
    try {
      const found = await ask('/api/case/edit', { case: latest.current, table, name, key, text: value });
      change(found.case);
      setTyping(false);
      clearTimeout(waiting.current);
      waiting.current = setTimeout(() => solve(found.case), 400);
    } catch (problem) {
      setError(problem);
    }
  };
  /** What is typed waits a moment before it goes into the case, one change after the other; whoever takes the case along takes all of it. */
  const later = (...what) => {
    const spot = what.slice(0, 3).join(' ');
    setTyping(true);
    clearTimeout(due.current.get(spot)?.timer);
    due.current.set(spot, { what, timer: setTimeout(complete, 500) });
  };
  const drop = () => {
    const open = [...due.current.values()];
    open.forEach((one) => clearTimeout(one.timer));
    due.current.clear();
    return open;
  };
  const complete = () => {
    for (const { what } of drop()) written.current = written.current.then(() => edit(...what));
    return written.current;
  };
  const typedIn = { later, waits: (...spot) => due.current.has(spot.join(' ')) };
  const undo = () => {
    drop();
    const before = past.at(-1);
    setPast(past.slice(0, -1));
    setTyping(false);
    shown(before);
    follow(before);
    if (outcome) solve(before);
  };
  const save = async (replace) => {
    try {
      await complete();
      const text = latest.current;
      await ask(address(path), { text, replace }, { method: 'PUT' });
      keepDraft(where.current, null);
      saved.current = text;
      settle('workspace:' + path);
      follow(text);
      setTaken(false);
      setTold(t('Saved.'));
      files();
      setTimeout(() => setTold(''), 3000);
    } catch (problem) {
      if (problem.details?.exists) setTaken(true);
      else setError(problem);
    }
  };
  const compare = (cases) => {
    setKept(cases);
    remember('compared ' + where.current, cases);
  };
  const report = () =>
    working(async (signal) =>
      download(
        'report.html',
        await ask('/api/report', { case: (await complete(), latest.current), place }, { text: true, signal }),
        'text/html',
      ),
    );
  const study = async (e) => {
    if (!due.current.size) return;
    e.preventDefault();
    await complete();
    location.hash = link('studies', where.current, { case: await follow(latest.current) });
  };
  const old = outcome && (busy || error || typing || text !== solved);
  return html`<main class="lines" id="main"><section aria-label=${t('Enter')}><h1>${t('Lines')}</h1>
    <div class="row"><select aria-label=${t('Open a case file')} onChange=${(e) => open(e.target.value)}><option value="" selected=${!place}>${t('Open…')}</option>
      ${place.startsWith('computer:') && html`<option value=${place} selected>${place.slice(9)}</option>`}
      ${list?.shipped?.length > 0 && html`<optgroup label=${t('Examples')}>${list.shipped.map((f) => html`<option value=${'examples:' + f} selected=${place === 'examples:' + f}>${f}</option>`)}</optgroup>`}
      ${list?.own?.length > 0 && html`<optgroup label=${t('Workspace')}>${list.own.map((f) => html`<option value=${'workspace:' + f} selected=${place === 'workspace:' + f}>${f}</option>`)}</optgroup>`}</select>
      <button class="button main" disabled=${!text || busy} onClick=${async () => {
        await complete();
        clearTimeout(waiting.current);
        solve(latest.current);
      }}>${t('Solve')}</button>
      <button class="button" disabled=${!past.length} onClick=${undo}>${t('Undo')}</button></div>
    <div class="row"><label class="button">${t('Open from this computer')}<input class="hidden" type="file" accept=".toml" aria-label=${t('Open from this computer')} onChange=${(e) => read(e.target.files)} /></label>
      <button class="button" disabled=${!text} onClick=${async () => {
        await complete();
        download(
          (path.split('/').at(-1) || 'line').replace(/(\.toml)?$/, '.toml'),
          latest.current,
          'application/toml',
        );
      }}>${t('Download the file')}</button></div>
    ${list && !list.own && html`<p class="small dim">${t('To save on the server, start it with --workspace FOLDER.')}</p>`}
    ${
      list?.own &&
      html`<div class="row"><input type="text" aria-label=${t('File name')} placeholder="line.toml" value=${path} onInput=${(
        e,
      ) => {
        setPath(e.target.value);
        setTaken(false);
      }} /><button class="button" disabled=${!path.endsWith('.toml') || !text} onClick=${() => save(place === 'workspace:' + path)}>${t('Save')}</button></div>
      ${taken && html`<div class="row caution" role="alert">▲ ${t('There is another file of this name: {path}', { path })} <button class="button" onClick=${() => save(true)}>${t('Overwrite it')}</button> <button class="button" onClick=${() => setTaken(false)}>${t('Keep it')}</button></div>`}`
    }<span class="small dim" role="status">${told}</span>
    ${form && html`<${Forms} form=${form} typedIn=${typedIn} problem=${error?.details} message=${error?.message} />`}
    <details open=${!form}><summary>${t('Case file')}</summary>
    <textarea id="case" aria-label=${t('Case file')} rows="30" spellcheck="false" value=${text} placeholder=${t('Open an example, or write a case file here.')} onChange=${(e) => change(e.target.value)} onInput=${(e) => setText(e.target.value)}></textarea></details></section>
    <section aria-label=${t('Believe')} aria-busy=${String(busy)}>
    <${Working} busy=${busy} cancel=${() => {
      stop.current?.abort();
      setBusy(false);
    }} job=${() => stop.current?.signal.job} text=${t('Working… a new line takes a little while the first time.')} />
    ${error && html`<p class="message out" role="alert">${error.message}</p>`}
    ${!outcome && !busy && !error && html`<h2 class="first">${t('Start from an example')}</h2><div class="columns">${(list?.shipped || []).map((f) => html`<button class="tile" onClick=${() => open('examples:' + f)}>${list.titles[f] || f}<span class="small dim">${f}</span></button>`)}</div>`}
    ${old && !busy && html`<p class="message caution" data-old>▲ ${t('What follows belongs to the line before the last change.')}</p>`}
    ${
      outcome &&
      html`<div class=${old ? 'stale' : ''}><${Outcome} data=${outcome} kept=${kept} form=${form} typedIn=${typedIn} clear=${() => compare([])} tools=${html`<button class="button" disabled=${busy} onClick=${report}>${t('Report')}</button>
      <button class="button" disabled=${Boolean(old) || kept.length >= MOST_KEPT} onClick=${() => compare([...kept, { units: outcome.units, form }])}>${t('Keep to compare')}</button>
      <a class="button" onClick=${study} href=${place ? link('studies', place, { case: carried }) : null}>${t('Study')}</a>`} /></div>`
    }</section></main>`;
}

/** Feeds and units, each a closed form that opens when asked. */
function Forms({ form, typedIn, problem, message }) {
  const groups = [
    ['feeds', t('Feeds'), form.feeds],
    ['units', t('Units'), form.units],
  ];
  return groups.map(
    ([table, label, items]) =>
      Object.keys(items).length > 0 &&
      html`<h2>${label}</h2>${Object.entries(items).map(
        ([
          name,
          item,
        ]) => html`<details key=${table + name} open=${problem?.unit === name} data-form=${name}><summary><strong>${name}</strong> <span class="dim">${item.title || ''}</span></summary>
    <${ItemForm} table=${table} name=${name} item=${item} typedIn=${typedIn} wrong=${problem?.unit === name ? problem.name : ''} message=${message} /></details>`,
      )}`,
  );
}

/** The form of one unit or feed. */
function ItemForm({ table, name, item, typedIn, wrong, message, spot = 'form' }) {
  const [typed, setTyped] = useState({});
  useEffect(
    () =>
      setTyped((before) =>
        Object.fromEntries(Object.entries(before).filter(([key]) => typedIn.waits(table, name, key))),
      ),
    [JSON.stringify(item.values)],
  );
  const set = (key, value) => {
    setTyped((before) => ({ ...before, [key]: value }));
    typedIn.later(table, name, key, value);
  };
  if (!item.parameters.length) return html`<p class="small dim">${item.summary || t('No parameters.')}</p>`;
  return html`<form onSubmit=${(e) => e.preventDefault()}>${item.parameters.map((p) => html`<${Field} key=${p.name} parameter=${p} id=${`field-${spot}-${name}-${p.name}`} text=${typed[p.name] ?? item.values[p.name]} onChange=${(value) => set(p.name, value)} problem=${wrong === p.name ? message : ''} />`)}
    ${item.limits?.length > 0 && html`<details data-limits=${name}><summary>${t('Practical limits')}</summary><div class="wide small"><table><tbody>${item.limits.map((limit) => html`<tr><td>${limit.name}</td><td>${limit.allowed}</td><td class="dim">${limit.source}</td></tr>`)}</tbody></table></div></details>`}</form>`;
}

function Outcome({ data, kept, form, typedIn, tools, clear }) {
  const [chosen, choose] = useState({ sort: '', name: '' });
  const panel = useRef(null);
  const pick = (event) => {
    if (event.type === 'keydown' && event.key !== 'Enter' && event.key !== ' ') return;
    const found = event.target.closest?.('[data-unit],[data-stream]');
    if (!found) return;
    event.preventDefault();
    choose(
      found.dataset.unit
        ? { sort: 'unit', name: found.dataset.unit }
        : { sort: 'stream', name: found.dataset.stream },
    );
  };
  const cases = [...kept, { ...data, form }];
  return html`<div class="row spread"><h2 class="first">${data.title}</h2><div class="row">${tools}</div></div>
    <p class="ok">● ${data.audit.text}</p><div>
    <div class="diagram" tabindex="0" role="region" aria-label=${t('Flow diagram')} onClick=${pick} onKeyDown=${pick} dangerouslySetInnerHTML=${{ __html: data.diagram }} />
    <p class="small dim">${t('Click a unit or a stream, or reach it with the tabulator key and press Enter.')}</p>
    <div ref=${panel} aria-live="polite">${chosen.sort === 'stream' && data.streams[chosen.name] && html`<div class="card" data-panel=${chosen.name}><h3>${chosen.name}</h3><${StreamPanel} stream=${data.streams[chosen.name]} /></div>`}
    ${
      chosen.sort === 'unit' &&
      data.units[chosen.name] &&
      html`<div class="card columns" data-panel=${chosen.name}><div><${UnitPanel} name=${chosen.name} unit=${data.units[chosen.name]} cases=${cases} /></div>
      ${form?.units[chosen.name] && html`<div><${ItemForm} key=${chosen.name} table="units" name=${chosen.name} item=${form.units[chosen.name]} typedIn=${typedIn} spot="panel" /></div>`}</div>`
    }</div>
    ${data.flags.map((flag) => html`<p class="message caution"><strong>${flag.unit}</strong> ${flag.message}</p>`)}
    ${kept.length > 0 && html`<${Comparison} cases=${cases} clear=${clear} />`}
    <h2>${t('Streams')}</h2><div class="wide" tabindex="0" role="region" aria-label=${t('Streams')}><table><thead><tr><th scope="col">${t('stream')}</th>${data.stream_table.heads.map((head) => html`<th class="n" scope="col">${head}</th>`)}</tr></thead>
      <tbody>${data.stream_table.rows.map(([name, cells]) => html`<tr><td>${name}</td>${cells.map((text) => html`<td class="n">${text}</td>`)}</tr>`)}</tbody></table></div>
    <${Utilities} table=${data.utility_table} />
    <h2>${t('Equipment')}</h2><div class="columns">${Object.entries(data.units).map(([name, unit]) => html`<div class="card"><${UnitPanel} name=${name} unit=${unit} cases=${cases} /></div>`)}</div></div>`;
}

/** What was changed between the kept cases, and what it did to the figures. */
function Comparison({ cases, clear }) {
  const inputs = new Map();
  const figures = new Map();
  cases.forEach((c, i) => {
    for (const [sort, items] of [
      ['feeds', c.form?.feeds],
      ['units', c.form?.units],
    ]) {
      for (const [name, item] of Object.entries(items || {})) {
        for (const p of item.parameters)
          put(inputs, `${sort}.${name}.${p.name}`, `${name}: ${p.label}`, i, item.values[p.name] ?? '—');
      }
    }
    for (const [name, unit] of Object.entries(c.units))
      for (const [key, row] of Object.entries(unit.results))
        put(figures, `${name}.${key}`, `${name}: ${row.label}`, i, row.text);
  });
  const differ = ([, row]) => cases.some((_, i) => row.values[i] !== row.values[0]);
  const body = (rows, strong) =>
    [...rows]
      .filter(differ)
      .map(
        ([key, row]) =>
          html`<tr key=${key} class=${strong ? '' : 'dim'}><td>${row.label}</td>${cases.map((_, i) => html`<td class="n">${strong ? html`<strong>${row.values[i] ?? '—'}</strong>` : (row.values[i] ?? '—')}</td>`)}</tr>`,
      );
  const rows = [body(inputs, false), body(figures, true)];
  return html`<h2>${t('Comparison')}</h2>${
    rows.flat().length === 0
      ? html`<p class="small dim">${t('Nothing differs yet: change a parameter.')}</p>`
      : html`<div class="wide" tabindex="0" role="region" aria-label=${t('Comparison')}><table data-comparison><thead><tr><td></td>${cases.map((_, i) => html`<th class="n" scope="col">${t('case {number}', { number: i + 1 })}</th>`)}</tr></thead><tbody>${rows}</tbody></table></div>`
  }
    <div class="row"><button class="button" onClick=${clear}>${t('Clear')}</button></div>`;
}

function put(rows, key, label, index, value) {
  if (!rows.has(key)) rows.set(key, { label, values: [] });
  rows.get(key).values[index] = value;
}

function UnitPanel({ name, unit, cases }) {
  return html`<h3>${name} <span class="dim">${unit.title || unit.model}</span></h3><div class="wide" tabindex="0" role="region" aria-label=${name}><table>${cases.length > 1 && html`<thead><tr><td></td>${cases.map((_, i) => html`<th class="n" scope="col">${i + 1}</th>`)}</tr></thead>`}<tbody>
    ${Object.entries(unit.results).map(([figure, row]) => html`<tr><td>${row.label || figure.replaceAll('_', ' ')}</td>${cases.map((c) => html`<td class="n" data-figure=${name + '.' + figure}>${c.units[name]?.results[figure]?.text ?? '—'}</td>`)}</tr>`)}
    ${unit.checks.map((c) => html`<tr class=${c.ok ? 'ok' : 'out'}><td>${c.ok ? '✓' : '✗'} ${c.name}</td><td class="n" colspan=${cases.length}>${c.text} <span class="dim">(${c.allowed})</span></td></tr>`)}</tbody></table></div>`;
}

function StreamPanel({ stream: s }) {
  const figure = s.size &&
    s.size.median !== null && {
      data: [
        {
          type: 'scatter',
          mode: 'lines',
          line: { shape: 'hv', color: '#b7791f' },
          x: s.size.boundaries.map((x) => x * 1e6),
          y: [...s.size.mass_fractions, 0].map((y) => y * 100),
        },
      ],
      layout: {
        height: 260,
        margin: { l: 55, r: 15, t: 10, b: 45 },
        xaxis: { type: 'log', dtick: 1, title: { text: t('particle diameter') + ' / µm' } },
        yaxis: { title: { text: '% ' + t('by mass') } },
      },
    };
  return html`<div class="columns"><table><tbody>${s.shown.map(([label, text]) => html`<tr><td>${label}</td><td class="n">${text}</td></tr>`)}</tbody></table>${figure && html`<${Plot} figure=${figure} label=${t('Particle sizes')} />`}</div>`;
}
