// Lines: build or open a case, work on its diagram and forms, see it solved after each step, compare, report.
import {
  Awaited,
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
  settings,
  useCopying,
  Working,
} from './core.js';
import { order } from './cards.js';
import { byTitle, caseAt, drafted, keepDraft, keepSteps, keptSteps, OwnLines, ownLines, packed } from './drafts.js';
import { Editor } from './line_editor.js';
import { fieldOf, Forms, learn, pretty } from './line_forms.js';
import { NewLine } from './line_new.js';
import { Outcome } from './line_outcome.js';
import { Palette } from './line_palette.js';
import { Panel } from './line_panel.js';
import { Sheet } from './line_sheet.js';
import { Specifications } from './line_specifications.js';
import { Substances } from './line_substances.js';

const MOST_KEPT = 2;
const stacked = matchMedia('(max-width: 62rem)'); // one column, as in the style sheet
const STEPS = 100; // that can be taken back
const NEW = 'computer:line.toml'; // the place of a text that is no file yet
const NOTHING = { sort: '', name: '' };
const address = (path) => `/api/workspace/${path.split('/').map(encodeURIComponent).join('/')}`;

/** The place of a line that was just begun, by its title; one that is there already is left alone. */
function freePlace(title) {
  const name =
    title
      .trim()
      .toLowerCase()
      .replace(/[^\p{L}\p{N}]+/gu, '-')
      .replace(/^-|-$/g, '') || 'line';
  for (let n = 1; ; n += 1) {
    const place = `computer:${name}${n > 1 ? '-' + n : ''}.toml`;
    if (drafted(place) === null) return place;
  }
}

/** The examples by domain, lines of several operations first, then in the order of the house. */
const byDomain = (list) =>
  ['', ...order]
    .map((domain) => [domain, (list?.shipped || []).filter((f) => list.domains[f] === domain)])
    .filter(([, files]) => files.length);

export function Lines({ state }) {
  const [list, setList] = useState(null);
  const [path, setPath] = useState(state.key || '');
  const [place, setPlace] = useState('');
  const [text, setText] = useState('');
  const [past, setPast] = useState([]);
  const [future, setFuture] = useState([]);
  const [outcome, setOutcome] = useState(null);
  const [solved, setSolved] = useState('');
  const [typing, setTyping] = useState(false);
  const [form, setForm] = useState(null);
  const [reading, setReading] = useState(false);
  const [error, setError] = useState(null);
  const [busy, setBusy] = useState(false);
  const [told, setTold] = useState('');
  const [carried, setCarried] = useState('');
  const [taken, setTaken] = useState(false);
  const [kept, setKept] = useState([]);
  const [making, setMaking] = useState(false);
  const [palette, setPalette] = useState(null);
  const [chosen, choose] = useState(NOTHING);
  const [writing, setWriting] = useState(false);
  const [setup, setSetup] = useState(!stacked.matches);
  const [removed, setRemoved] = useState(null);
  const [forgotten, setForgotten] = useState(null); // of the lines kept in this browser
  const [sized, setSized] = useState({ name: '', text: '' }); // for what a piece was sized
  const [copied, copy] = useCopying();
  const stop = useRef(null);
  const latest = useRef('');
  const saved = useRef('');
  const where = useRef('');
  const waiting = useRef(0);
  const across = useRef(5);
  const due = useRef(new Map());
  const flying = useRef([]);
  const written = useRef(Promise.resolve());
  const files = () =>
    Promise.all([ask('/api/workspace'), ask('/api/examples')]).then(([own, shipped]) =>
      setList({ own: own.files, shipped: shipped.files, titles: shipped.titles, domains: shipped.domains }),
    );
  useEffect(() => {
    files();
  }, [settings.language]);
  useEffect(() => () => stop.current?.abort(), []);
  useEffect(() => {
    const turned = () => setSetup(!stacked.matches); // beside the line there is room for all of it
    stacked.addEventListener('change', turned);
    return () => stacked.removeEventListener('change', turned);
  }, []);
  useEffect(() => {
    if (where.current && latest.current) keepSteps(where.current, latest.current, past, future);
  }, [past, future]);
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
  const forget = ({ place, title }) => {
    setForgotten({ place, title, text: drafted(place) });
    keepDraft(place, null);
  };
  const settle = (next) => {
    where.current = next;
    setPlace(next);
  };
  /** The text and its forms; gives them, or null where the text cannot be read. */
  const shown = async (next) => {
    latest.current = next;
    setText(next);
    setReading(true);
    const asked = across.current;
    try {
      const found = await ask('/api/case/form', { case: next, across: asked, place: where.current });
      if (latest.current === next && across.current === asked) {
        learn(found.names);
        setForm(found);
      }
      return found;
    } catch {
      if (latest.current === next) {
        setForm(null);
        setWriting(true);
      }
      return null;
    } finally {
      if (latest.current === next) setReading(false);
    }
  };
  /** Solve in a moment what is whole; what is not says what it needs. */
  const soon = (next, found) => {
    clearTimeout(waiting.current);
    if (!found || found.missing.length) return;
    waiting.current = setTimeout(() => solve(next), 400);
  };
  const change = async (next) => {
    if (!where.current) settle(NEW);
    setPast((before) => [...before.slice(1 - STEPS), latest.current]);
    setFuture([]);
    const found = shown(next);
    follow(next);
    soon(next, await found);
  };
  const open = async (wanted, link = '') => {
    if (!wanted) return;
    try {
      const found = await caseAt(wanted, link);
      // a link may bring a line of the name of another one that is kept here: what it takes the place of is one step back
      const before = wanted === where.current ? latest.current : wanted.startsWith('computer:') ? drafted(wanted) : null;
      const replaced = before && before !== found.text ? [before] : [];
      if (wanted === where.current) {
        if (replaced.length) {
          setPast((steps) => [...steps.slice(1 - STEPS), ...replaced]);
          setFuture([]);
        }
      } else {
        drop();
        setKept(recall('compared ' + wanted, []));
        setOutcome(null);
        const steps = keptSteps(wanted, found.text);
        setPast(steps?.past ?? (found.changed ? [found.saved] : replaced));
        setFuture(steps?.future ?? []);
        choose(NOTHING);
        setPalette(null);
      }
      settle(wanted);
      saved.current = found.saved;
      setPath(wanted.slice(wanted.indexOf(':') + 1));
      setError(null);
      setTaken(false);
      setMaking(false);
      setTold(
        found.changed
          ? t('With the changes of last time; Undo takes them back.')
          : replaced.length
            ? t('Another line was here under this name; Undo brings it back.')
            : '',
      );
      const forms = await shown(found.text);
      follow(found.text);
      if (!forms?.missing.length) solve(found.text);
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
  /** One change after the other, each on the text that the one before it left. */
  const next = (work) => {
    const made = written.current.then(work);
    written.current = made.catch(() => {});
    return made;
  };
  const edit = async (table, name, key, value) => {
    try {
      const found = await ask('/api/case/edit', { case: latest.current, table, name, key, text: value });
      setTyping(due.current.size > 0); // somebody may type in the next field by now
      setError(null);
      await change(found.case);
    } catch (problem) {
      problem.details = { ...problem.details, unit: name, name: key };
      setError(problem);
    }
  };
  /** A step of building; gives the name of what came to be, or true, and nothing where it was refused. */
  const build = async (operation, given, told = setError) => {
    await complete();
    return next(async () => {
      const before = form;
      setError(null);
      try {
        const found = await ask('/api/case/build', { case: latest.current, operation, arguments: given });
        if (operation === 'remove') setRemoved({ name: pretty(given.name), text: found.case });
        setSized({ name: '', text: found.told });
        await change(found.case);
        const now = await ask('/api/case/form', { case: found.case, across: across.current, place: where.current });
        const fresh = (table) => Object.keys(now[table]).find((name) => !(name in (before?.[table] || {})));
        const streams = (found) => (found?.ends.origins || []).map((end) => end.stream);
        const stream = () => streams(now).find((name) => !streams(before).includes(name));
        return operation === 'add_unit' || operation === 'rename'
          ? fresh('units') || fresh('feeds') || stream() || true
          : operation === 'add_feed'
            ? fresh('feeds') || true
            : true;
      } catch (problem) {
        told(problem);
        return null;
      }
    });
  };
  /** What is typed waits a moment before it goes into the case; whoever takes the case along takes all of it. */
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
    for (const { what } of drop()) {
      const spot = what.slice(0, 3).join(' ');
      flying.current.push(spot);
      next(() => edit(...what)).finally(() => flying.current.splice(flying.current.indexOf(spot), 1));
    }
    return written.current;
  };
  const waits = (...spot) => due.current.has(spot.join(' '));
  // what is on its way into the case is not yet in the forms that an answer before it brings
  const typedIn = { later, waits, keeps: (...spot) => waits(...spot) || flying.current.includes(spot.join(' ')) };
  const step = async (from, setFrom, setTo) => {
    if (!from.length) return;
    drop();
    const there = from.at(-1);
    setFrom(from.slice(0, -1));
    setTo((before) => [...before, latest.current]);
    setTyping(false);
    setError(null);
    const found = shown(there);
    follow(there);
    soon(there, await found);
  };
  const undo = () => step(past, setPast, setFuture);
  const redo = () => step(future, setFuture, setPast);
  useEffect(() => {
    const key = (e) => {
      if (!(e.ctrlKey || e.metaKey) || e.target.matches?.('input:not([type=radio], [type=checkbox]), textarea')) return;
      const letter = e.key.toLowerCase();
      if (letter === 'z' && !e.shiftKey) undo();
      else if (letter === 'y' || letter === 'z') redo();
      else return;
      e.preventDefault();
    };
    addEventListener('keydown', key);
    return () => removeEventListener('keydown', key);
  });
  const make = async (values, told) => {
    setError(null);
    try {
      const found = await ask('/api/case/build', { operation: 'begin', arguments: values });
      const begun = freePlace(values.title);
      keepDraft(begun, found.case);
      await open(begun);
      setPalette({ origin: Object.keys((await ask('/api/case/form', { case: found.case })).feeds)[0] });
    } catch (problem) {
      told(problem);
    }
  };
  /** What an open end brings, where the line as it stands is solved: a piece put on it is sized by that. */
  const brought = (origin) => {
    const name = form?.ends.origins.find((end) => end.value === origin)?.stream;
    const stream = latest.current === solved && outcome?.streams[name];
    if (!stream) return {};
    const [solvent] = Object.values(stream.liquid);
    const brings = { mass_flow: `${stream.mass_flow.value} kg/s`, ...(stream.size?.median > 0 && { median_size: `${stream.size.median} m` }) };
    return { brings: solvent === undefined ? brings : { ...brings, solvent: `${solvent} kg/s` } };
  };
  const add = async (model) => {
    const origin = palette.origin || '';
    setPalette(null);
    const made = await build('add_unit', { model, origin, ...brought(origin) });
    if (!made) return;
    setSized((before) => ({ ...before, name: made }));
    choose({ sort: 'unit', name: made });
  };
  /** The size of a piece for what enters it: a change like any other, which Undo takes back. */
  const size = (unit, wanted) =>
    working(async (signal) => {
      await complete();
      const given = latest.current;
      const found = await ask('/api/case/size', { case: given, unit, wanted, place: where.current }, { signal });
      if (latest.current !== given) return;
      await edit('units', unit, found.key, found.text);
      setSized({ name: unit, text: found.told, undo: latest.current });
    });
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
  /** The link of the line as it stands, unless it is too long for one. */
  const share = async () => {
    await complete();
    const own = latest.current !== saved.current || where.current.startsWith('computer:');
    if ((await follow(latest.current)) || !own) copy();
    else setTold(t('This line is too long for a link: download its file and send that.'));
  };
  const wider = (count) => {
    if (count === across.current) return;
    across.current = count;
    if (latest.current) shown(latest.current);
  };
  const old = Boolean(outcome && (busy || error || typing || text !== solved));
  const cases = outcome ? [...kept, { ...outcome, form }] : [];
  const missing = form?.missing || [];
  const refused = fieldOf(form, error); // told at its field, in the panel where that is open
  const inPanel = Boolean(refused && refused.unit === chosen.name);
  const labels = Object.fromEntries(
    (form?.ends.origins || []).map((end) => [end.stream, end.stream === end.value ? end.label : undefined]),
  );
  const tools = html`<button class="button" disabled=${busy || !outcome || missing.length > 0} onClick=${report}>${t('Report')}</button>
    <button class="button" onClick=${share}>${t('Copy link')}</button>
    <button class="button" disabled=${old || !outcome || kept.length >= MOST_KEPT} onClick=${() => compare([...kept, { units: outcome.units, form }])}>${t('Keep to compare')}</button>
    <a class="button" onClick=${study} href=${place ? link('studies', place, { case: carried }) : null}>${t('Study')}</a>`;
  return html`<main class="lines" id="main"><section aria-label=${t('Enter')}><h1>${t('Lines')}</h1>
    <div class="row"><button class="button ${text ? '' : 'main'}" onClick=${() => setMaking(true)}>${t('New line')}</button><select aria-label=${t('Open a case file')} onChange=${(e) => open(e.target.value)}><option value="" selected=${!place}>${t('Open…')}</option>
      <${OwnLines} place=${place} />
      ${list?.shipped?.length > 0 && html`<optgroup label=${t('Examples')}>${byTitle(list).map((f) => html`<option value=${'examples:' + f} selected=${place === 'examples:' + f}>${list.titles[f] || f}</option>`)}</optgroup>`}
      ${list?.own?.length > 0 && html`<optgroup label=${t('Workspace')}>${list.own.map((f) => html`<option value=${'workspace:' + f} selected=${place === 'workspace:' + f}>${f}</option>`)}</optgroup>`}</select></div>
    <div class="row"><button class="button main" disabled=${!text || busy} onClick=${async () => {
      await complete();
      clearTimeout(waiting.current);
      solve(latest.current);
    }}>${t('Solve')}</button>
      <button class="button" disabled=${!past.length} onClick=${undo}>${t('Undo')}</button><button class="button" disabled=${!future.length} onClick=${redo}>${t('Redo')}</button></div>
    <details class="setup" open=${setup} onToggle=${(e) => e.target.classList.contains('setup') && setSetup(e.target.open)}><summary>${t('File, substances, feeds and equipment')}</summary>
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
    ${form && html`<${Substances} form=${form} build=${build} /><${Forms} form=${form} typedIn=${typedIn} build=${build} refused=${inPanel ? null : refused} fault=${error?.details?.unit} /><${Specifications} key=${place} form=${form} build=${build} />`}
    <details open=${writing} onToggle=${(e) => setWriting(e.target.open)}><summary>${t('Case file')}</summary><${Editor} text=${text} write=${setText} done=${change} /></details></details></section>
    <section aria-label=${t('Believe')} aria-busy=${String(busy)}>
    ${making && html`<${NewLine} make=${make} cancel=${() => setMaking(false)} />`}
    ${text && html`<div class="row spread"><h2 class="first title">${form?.title || outcome?.title || ''}</h2><div class="row">${tools}</div></div><span class="small dim" role="status" data-copied>${copied}</span>`}
    ${reading && !form && html`<${Awaited} text=${t('Reading the line…')} />`}
    ${
      form &&
      html`<div class="row"><button class="button" onClick=${() => setPalette({ origin: '' })}>${t('Add equipment')}</button><button class="button" onClick=${async () => {
        const made = await build('add_feed', {});
        if (made) choose({ sort: 'stream', name: made });
      }}>${t('Add a feed')}</button></div>`
    }
    <${Working} busy=${busy} cancel=${() => {
      stop.current?.abort();
      setBusy(false);
    }} job=${() => stop.current?.signal.job} text=${t('Working… a new line takes a little while the first time.')} />
    ${error && !(refused && (inPanel || setup)) && html`<p class="message out" role="alert">${error.message}</p>`}
    ${removed?.text === text && html`<p class="row small" role="status" data-removed>${t('Deleted: {name}', { name: removed.name })} <button class="button" onClick=${undo}>${t('Undo')}</button></p>`}
    ${missing.length > 0 && html`<div class="message caution" data-missing>${missing.map((one) => html`<p>▲ ${one}</p>`)}</div>`}
    ${
      !text &&
      !making &&
      html`<h2 class="first">${t('Start a new line')}</h2><p>${t('Choose what enters, put equipment behind it, and see it solved after each step.')}</p><button class="button main" onClick=${() => setMaking(true)}>${t('New line')}</button>
    ${ownLines().length > 0 && html`<h2>${t('Kept in this browser')}</h2><div class="columns tiles" data-own-lines>${ownLines().map((row) => html`<div class="own" key=${row.place}><button class="tile" onClick=${() => open(row.place)}>${row.title}</button><button class="button" aria-label=${t('Delete {name}', { name: row.title })} onClick=${() => forget(row)}>×</button></div>`)}</div>`}
    ${forgotten && html`<p class="row small" role="status" data-forgotten>${t('Deleted: {name}', { name: forgotten.title })} <button class="button" onClick=${() => {
      keepDraft(forgotten.place, forgotten.text);
      setForgotten(null);
    }}>${t('Undo')}</button></p>`}
    <h2>${t('Start from an example')}</h2>${byDomain(list).map(([domain, files]) => html`<h3>${domain ? t(domain) : t('Several operations')}</h3><div class="columns tiles">${files.map((f) => html`<button class="tile" onClick=${() => open('examples:' + f)}>${list.titles[f] || f}</button>`)}</div>`)}`
    }
    ${
      form &&
      html`<div class="sheet ${old ? 'stale' : ''}"><${Sheet} svg=${form.diagram} streams=${outcome?.streams} old=${old || missing.length > 0} chosen=${chosen} choose=${choose} put=${(origin) => setPalette({ origin })} connect=${(origin, target) => build('connect', { origin, target })} setAcross=${wider} /></div>
    <p class="small dim screen">${t('Choose a unit or a stream; + puts equipment at an open end; drag a + to an inlet to connect it.')}</p>`
    }
    ${palette && form && html`<${Palette} key=${settings.language} origin=${palette.origin} pick=${add} close=${() => setPalette(null)} />`}
    ${sized.text && sized.name === chosen.name && html`<p class="row small" role="status" data-sized><span>${sized.text}</span> ${sized.undo === text && html`<button class="button" onClick=${undo}>${t('Undo')}</button>`}</p>`}
    <div aria-live="polite">${form && chosen.name && html`<${Panel} chosen=${chosen} choose=${choose} form=${form} data=${outcome} cases=${cases} old=${old} typedIn=${typedIn} build=${build} size=${size} refused=${refused} />`}</div>
    ${old && !busy && html`<p class="message caution" data-old>▲ ${t('What follows belongs to the line before the last change.')}</p>`}
    ${outcome && html`<div class=${old ? 'stale' : ''}><${Outcome} data=${outcome} cases=${cases} compared=${kept.length > 0} clear=${() => compare([])} choose=${choose} place=${place} text=${solved} labels=${labels} prices=${form?.prices} build=${build} /></div>`}</section></main>`;
}
