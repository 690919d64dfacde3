// Studies: what varies, what is watched; progress, cancel, and the outcome as charts and tables.
import { html, t, ask, useAnswer, useState, useEffect, useRef, settings, Plot } from './core.js';

const KINDS = [['sweep', 'Sweep of one input'], ['map', 'Map of two inputs'], ['monte_carlo', 'Monte Carlo'], ['sobol', 'Where the variance comes from'], ['optimize', 'Optimum']];
const joined = (number, unit) => `${number} ${unit}`.trim();
const times = (text, factor) => { const value = Number(String(text).replace(',', '.')); return Number.isFinite(value) ? String(Number((value * factor).toPrecision(4))) : ''; };

/** A fresh row for an input: bounds a tenth below and above its present value, in its own unit. */
function row(input) {
  const celsius = input.unit === 'degC';
  const low = celsius ? String(Number(input.value) - 5) : times(input.value, 0.9);
  const high = celsius ? String(Number(input.value) + 5) : times(input.value, 1.1);
  return { name: input.name, unit: input.unit, low, high, mean: input.value, spread: celsius ? '1' : times(input.value, 0.05), law: 'normal', steps: '21' };
}

export function Studies({ state }) {
  const [list, setList] = useState(null);
  useEffect(() => { Promise.all([ask('/api/workspace'), ask('/api/examples')]).then(([own, shipped]) => setList({ own: own.files || [], shipped: shipped.files })); }, []);
  const place = state.key || 'card:particles.terminal_velocity';
  const { data: found, error } = useAnswer((signal) => subjectOf(place, state.values, signal), [place, state.visit, settings.language, settings.units], 0);
  const go = (value) => { location.hash = `#/studies/${encodeURIComponent(value)}`; };
  const head = html`<h1>${t('Studies')}</h1>
    <div class="row"><label>${t('Study of')} <select value=${place} onChange=${(e) => go(e.target.value)}>
      <option value=${place.startsWith('card:') ? place : 'card:particles.terminal_velocity'}>${found?.choices.title && place.startsWith('card:') ? found.choices.title : t('Terminal velocity')}</option>
      ${list?.shipped.length > 0 && html`<optgroup label=${t('Examples')}>${list.shipped.map((f) => html`<option value=${'examples:' + f} selected=${place === 'examples:' + f}>${f}</option>`)}</optgroup>`}
      ${list?.own.length > 0 && html`<optgroup label=${t('Workspace')}>${list.own.map((f) => html`<option value=${'workspace:' + f} selected=${place === 'workspace:' + f}>${f}</option>`)}</optgroup>`}</select></label></div>`;
  const ready = found && found.place === place;
  return html`<main class="studies" id="main">${ready ? html`<${Form} key=${place + settings.language + settings.units + state.visit} head=${head} subject=${found.subject} choices=${found.choices} />`
    : html`<section aria-label=${t('Enter')}>${head}${error ? html`<p class="message out" role="alert">${error.message}</p>` : html`<p class="dim" aria-busy="true">${t('Loading…')}</p>`}</section><section aria-label=${t('Believe')} />`}</main>`;
}

async function subjectOf(place, values, signal) {
  const [sort, ...rest] = place.split(':');
  const name = rest.join(':');
  let subject = { card: name, inputs: values };
  if (sort !== 'card') subject = { case: (await ask(`/api/${sort}/${name.split('/').map(encodeURIComponent).join('/')}`, undefined, { signal })).text };
  else if (!Object.keys(values).length) {
    const card = await ask(`/api/cards/${encodeURIComponent(name)}`, undefined, { signal });
    subject.inputs = Object.fromEntries(card.parameters.filter((p) => p.example).map((p) => [p.name, joined(p.example.number, p.example.unit)]));
  }
  return { place, subject, choices: await ask('/api/studies/choices', subject, { signal }) };
}

function Form({ head, subject, choices }) {
  const usable = choices.inputs.filter((i) => i.value !== '');
  const [kind, setKind] = useState('sweep');
  const [rows, setRows] = useState(usable.slice(0, 1).map(row));
  const [watched, setWatched] = useState(choices.figures.slice(0, 1).map((f) => f.name));
  const [samples, setSamples] = useState('1000');
  const [sense, setSense] = useState('minimize');
  const [limits, setLimits] = useState([]);
  const wanted = kind === 'map' ? 2 : kind === 'sweep' ? 1 : null;
  const pick = (next) => {
    setKind(next);
    const count = next === 'map' ? 2 : next === 'sweep' ? 1 : rows.length;
    const spare = usable.filter((i) => !rows.some((r) => r.name === i.name));
    setRows([...rows, ...spare.map(row)].slice(0, count));
  };
  const change = (index, part) => setRows(rows.map((r, i) => (i === index ? { ...r, ...part } : r)));
  const table = () => declared(kind, rows, watched, samples, sense, limits);
  const job = useJob();
  return html`<section aria-label=${t('Enter')}>${head}<div class="row" role="radiogroup" aria-label=${t('Kind of study')}>${KINDS.map(([name, label]) => html`<label class="choice"><input type="radio" name="kind" checked=${kind === name} onChange=${() => pick(name)} /> ${t(label)}</label>`)}</div>
    <h2>${t('What varies')}</h2>${rows.map((r, i) => html`<${Varied} key=${i} kind=${kind} row=${r} inputs=${usable} change=${(part) => change(i, part)} remove=${wanted || rows.length === 1 ? null : () => setRows(rows.filter((_, k) => k !== i))} />`)}
    ${!wanted && rows.length < usable.length && html`<div class="row"><button class="button" onClick=${() => setRows([...rows, row(usable.find((x) => !rows.some((r) => r.name === x.name)))])}>${t('One more input')}</button></div>`}
    <h2>${kind === 'optimize' ? t('What is sought') : t('What is watched')}</h2>
    ${kind === 'optimize' ? html`<div class="row"><select aria-label=${t('Sense')} value=${sense} onChange=${(e) => setSense(e.target.value)}><option value="minimize">${t('smallest')}</option><option value="maximize">${t('largest')}</option></select>
        <${Figures} label=${t('Figure')} value=${watched[0]} figures=${choices.figures} onChange=${(name) => setWatched([name])} /></div>
        ${limits.map((l, i) => html`<div class="row" key=${i}><${Figures} label=${t('Figure')} value=${l.name} figures=${choices.figures} onChange=${(name) => setLimits(limits.map((x, k) => (k === i ? { ...x, name } : x)))} />
          <input class="short" aria-label=${t('at least')} placeholder=${t('at least')} value=${l.low} onInput=${(e) => setLimits(limits.map((x, k) => (k === i ? { ...x, low: e.target.value } : x)))} />
          <input class="short" aria-label=${t('at most')} placeholder=${t('at most')} value=${l.high} onInput=${(e) => setLimits(limits.map((x, k) => (k === i ? { ...x, high: e.target.value } : x)))} />
          <button class="button" onClick=${() => setLimits(limits.filter((_, k) => k !== i))}>${t('Remove')}</button></div>`)}
        <div class="row"><button class="button" onClick=${() => setLimits([...limits, { name: choices.figures[0].name, low: '', high: '' }])}>${t('Add a limit')}</button></div>`
      : html`<div class="scroll watched" tabindex="0" role="group" aria-label=${t('What is watched')}>${choices.figures.map((f) => html`<label class="choice"><input type="checkbox" checked=${watched.includes(f.name)} onChange=${(e) => setWatched(e.target.checked ? [...watched, f.name] : watched.filter((n) => n !== f.name))} /> ${f.label}</label>`)}</div>`}
    ${(kind === 'monte_carlo' || kind === 'sobol') && html`<div class="row"><label>${t('Samples')} <input class="short" inputmode="numeric" value=${samples} onInput=${(e) => setSamples(e.target.value)} /></label></div>`}
    <div class="row"><button class="button main" disabled=${job.running || !rows.length || !watched.length} onClick=${() => job.start({ ...subject, varied: rows.map((r) => r.name), table: table() })}>${t('Run the study')}</button></div></section>
    <section aria-label=${t('Believe')}>${job.running && html`<div class="row"><label>${t('Working…')} <progress max="1" value=${job.share || null}></progress></label> <span class="n" role="status">${job.share ? `${Math.round(100 * job.share)} %` : ''}</span> <button class="button" onClick=${job.cancel}>${t('Cancel')}</button></div>`}
      ${job.error && html`<p class="message out" role="alert">${job.error}</p>`}
      ${!job.outcome && !job.running && !job.error && html`<p class="dim">${t('Choose what varies and what is watched, then run the study. Charts and tables appear here.')}</p>`}
      ${job.outcome && html`<div class=${job.running ? 'stale' : ''}><${Outcome} data=${job.outcome} /></div>`}</section>`;
}

function declared(kind, rows, watched, samples, sense, limits) {
  const by = (make) => Object.fromEntries(rows.map((r) => [r.name, make(r)]));
  const at = (r, number) => joined(String(number).replace(',', '.'), r.unit);
  if (kind === 'sweep' || kind === 'map') return { kind, outputs: watched, over: by((r) => ({ from: at(r, r.low), to: at(r, r.high), steps: Number(r.steps) || 21 })) };
  if (kind === 'optimize') return {
    kind, [sense]: watched[0], over: by((r) => ({ lower: at(r, r.low), upper: at(r, r.high) })),
    ...(limits.length ? { limits: Object.fromEntries(limits.map((l) => [l.name, { ...(l.low && { lower: l.low }), ...(l.high && { upper: l.high }) }])) } : {}),
  };
  const uncertain = by((r) => (r.law === 'uniform' ? { distribution: 'uniform', lower: at(r, r.low), upper: at(r, r.high) }
    : { distribution: 'normal', mean: at(r, r.mean), standard_deviation: joined(String(r.spread).replace(',', '.'), r.unit === 'degC' ? 'K' : r.unit) }));
  return { kind, outputs: watched, samples: Number(samples) || 1000, uncertain };
}

function Varied({ kind, row: r, inputs, change, remove }) {
  const input = inputs.find((i) => i.name === r.name);
  const shown = (text) => (settings.language === 'fr' ? String(text).replace('.', ',') : text);
  const field = (name, label) => html`<label class="small">${label} <input class="short" inputmode="decimal" data-part=${name} value=${shown(r[name])} onInput=${(e) => change({ [name]: e.target.value.replace(',', '.') })} /></label>`;
  const doubtful = kind === 'monte_carlo' || kind === 'sobol';
  return html`<div class="varied"><div class="row"><select aria-label=${t('Input')} value=${r.name} onChange=${(e) => change(row(inputs.find((i) => i.name === e.target.value)))}>${inputs.map((i) => html`<option value=${i.name} selected=${i.name === r.name}>${i.label}</option>`)}</select>
    <span class="small dim">${t('now')} ${shown(input?.value)} ${input?.units[0]?.label}</span>${remove && html`<button class="button" onClick=${remove}>${t('Remove')}</button>`}</div>
    <div class="row">${doubtful && html`<select aria-label=${t('Distribution')} value=${r.law} onChange=${(e) => change({ law: e.target.value })}><option value="normal">${t('normal')}</option><option value="uniform">${t('uniform')}</option></select>`}
      ${doubtful && r.law === 'normal' ? html`${field('mean', t('mean'))}${field('spread', t('standard deviation'))}` : html`${field('low', t('from'))}${field('high', t('to'))}`}
      <select aria-label=${t('Unit of {name}', { name: input?.label || '' })} value=${r.unit} onChange=${(e) => change({ unit: e.target.value })}>${input?.units.map((u) => html`<option value=${u.unit} selected=${u.unit === r.unit}>${u.label || '1'}</option>`)}</select>
      ${(kind === 'sweep' || kind === 'map') && field('steps', t('steps'))}</div></div>`;
}

function Figures({ label, value, figures, onChange }) {
  return html`<select aria-label=${label} value=${value} onChange=${(e) => onChange(e.target.value)}>${figures.map((f) => html`<option value=${f.name} selected=${f.name === value}>${f.label}</option>`)}</select>`;
}

/** One job on the server: started, asked about, cancelled; leaving the page cancels it. */
function useJob() {
  const [state, setState] = useState({ running: false, share: 0, outcome: null, error: '' });
  const now = useRef(null);
  const cancel = () => {
    const id = now.current;
    now.current = null;
    if (id && id !== 'new') ask(`/api/studies/${id}`, undefined, { method: 'DELETE' }).catch(() => {});
    setState((s) => ({ ...s, running: false }));
  };
  useEffect(() => cancel, []);
  const start = async (study) => {
    cancel();
    now.current = 'new';
    setState((s) => ({ ...s, running: true, share: 0, error: '' }));
    try {
      const { id } = await ask('/api/studies', study);
      if (now.current !== 'new') { ask(`/api/studies/${id}`, undefined, { method: 'DELETE' }).catch(() => {}); return; }
      now.current = id;
      for (;;) {
        const found = await ask(`/api/studies/${id}`);
        if (now.current !== id) return;
        if (found.state === 'done') { setState({ running: false, share: 1, outcome: found.outcome, error: '' }); return; }
        setState((s) => ({ ...s, share: found.share }));
        await new Promise((done) => setTimeout(done, 400));
      }
    } catch (problem) { setState((s) => ({ ...s, running: false, error: problem.message })); }
  };
  return { ...state, start, cancel };
}

function Outcome({ data }) {
  const counts = data.counts;
  const save = () => {
    const names = Object.keys(data.cases);
    const unit = Object.fromEntries([...data.inputs, ...data.outputs].map((v) => [v.name, v.unit]));
    const lines = [names.map((n) => `${n} [${unit[n] || '1'}]`).join(','), ...data.cases[names[0]].map((_, i) => names.map((n) => data.cases[n][i] ?? '').join(','))];
    const place = URL.createObjectURL(new Blob([lines.join('\n') + '\n'], { type: 'text/csv' }));
    Object.assign(document.createElement('a'), { href: place, download: 'cases.csv' }).click();
    URL.revokeObjectURL(place);
  };
  return html`<div class="row spread"><h2 class="first">${data.model}</h2>${data.cases && html`<button class="button" onClick=${save}>${t('Download the cases')}</button>`}</div>
    <p class=${counts.failed ? 'caution' : 'ok'} data-study=${data.study}>${counts.failed ? '▲' : '●'} ${t('{run} cases, {failed} without a result', { run: counts.run, failed: counts.failed })}</p>
    ${Object.entries(counts.reasons).map(([reason, count]) => html`<p class="small caution">${count} × ${reason}</p>`)}
    ${data.charts.map((c) => html`<${Plot} key=${c.name} figure=${c.figure} label=${c.figure.layout.title?.text || c.name} />`)}
    ${data.tables.map((table) => html`<h3>${table.title}</h3><div class="wide" tabindex="0" role="region" aria-label=${table.title}><table><thead><tr>${table.columns.map((c, i) => html`<th scope="col" class=${i ? 'n' : ''}>${c}</th>`)}</tr></thead>
      <tbody>${table.rows.map((r) => html`<tr>${r.map((text, i) => html`<td class=${i ? 'n' : ''}>${text}</td>`)}</tr>`)}</tbody></table></div>`)}`;
}
