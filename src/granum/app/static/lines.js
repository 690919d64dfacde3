// Lines: open or write a case file, solve it, click through units and streams, report.
import { html, t, ask, number, useState, useEffect, useRef, replaceLink, Plot } from './core.js';

export function Lines({ state }) {
  const [list, setList] = useState(null);
  const [path, setPath] = useState(state.key || '');
  const [text, setText] = useState('');
  const [past, setPast] = useState([]);
  const [outcome, setOutcome] = useState(null);
  const [error, setError] = useState(null);
  const [busy, setBusy] = useState(false);
  const [told, setTold] = useState('');
  const [kept, setKept] = useState([]);
  const stop = useRef(null);
  useEffect(() => { Promise.all([ask('/api/workspace'), ask('/api/examples')]).then(([own, shipped]) => setList({ own: own.files, shipped: shipped.files })); }, []);
  useEffect(() => { if (state.key.includes(':')) open(state.key); }, [state.visit]);
  const open = async (place) => {
    if (!place) return;
    const [sort, ...rest] = place.split(':');
    try {
      const found = await ask(`/api/${sort}/${rest.join(':').split('/').map(encodeURIComponent).join('/')}`);
      setPast([...past, text]); setText(found.text); setPath(sort === 'workspace' ? found.path : ''); setError(null); setOutcome(null);
      replaceLink('lines', place, {});
      solve(found.text);
    } catch (problem) { setError(problem); }
  };
  const solve = async (given) => {
    stop.current?.abort();
    stop.current = new AbortController();
    setBusy(true); setError(null);
    try { setOutcome(await ask('/api/run', { case: given }, { signal: stop.current.signal })); }
    catch (problem) { if (problem.name !== 'AbortError') setError(problem); }
    finally { setBusy(false); }
  };
  const save = async () => {
    try { await ask(`/api/workspace/${path}`, { text }, { method: 'PUT' }); setTold(t('Saved.')); setTimeout(() => setTold(''), 3000); }
    catch (problem) { setError(problem); }
  };
  const report = async () => {
    setBusy(true);
    try {
      const page = await ask('/api/report', { case: text }, { text: true });
      const place = URL.createObjectURL(new Blob([page], { type: 'text/html' }));
      Object.assign(document.createElement('a'), { href: place, download: 'report.html' }).click();
      URL.revokeObjectURL(place);
    } catch (problem) { setError(problem); } finally { setBusy(false); }
  };
  return html`<main class="lines" id="main"><section aria-label=${t('Enter')}><h1>${t('Lines')}</h1>
    <div class="row"><select aria-label=${t('Open a case file')} onChange=${(e) => open(e.target.value)}><option value="">${t('Open…')}</option>
      ${list?.shipped?.length > 0 && html`<optgroup label=${t('Examples')}>${list.shipped.map((f) => html`<option value=${'examples:' + f}>${f}</option>`)}</optgroup>`}
      ${list?.own?.length > 0 && html`<optgroup label=${t('Workspace')}>${list.own.map((f) => html`<option value=${'workspace:' + f}>${f}</option>`)}</optgroup>`}</select>
      <button class="button main" disabled=${!text || busy} onClick=${() => solve(text)}>${t('Solve')}</button>
      <button class="button" disabled=${!past.length} onClick=${() => { setText(past.at(-1)); setPast(past.slice(0, -1)); }}>${t('Undo')}</button></div>
    <label class="small dim" for="case">${t('Case file')}</label>
    <textarea id="case" rows="30" spellcheck="false" value=${text} placeholder=${t('Open an example, or write a case file here.')} onChange=${() => setPast([...past, text])} onInput=${(e) => setText(e.target.value)}></textarea>
    ${list?.own && html`<div class="row"><input type="text" aria-label=${t('File name')} placeholder="line.toml" value=${path} onInput=${(e) => setPath(e.target.value)} /><button class="button" disabled=${!path.endsWith('.toml') || !text} onClick=${save}>${t('Save')}</button> <span role="status">${told}</span></div>`}</section>
    <section aria-label=${t('Believe')}>
    ${busy && html`<div class="row" aria-busy="true"><span role="status">${t('Working… a new line takes a little while the first time.')}</span> <button class="button" onClick=${() => { stop.current?.abort(); setBusy(false); }}>${t('Cancel')}</button></div>`}
    ${error && html`<p class="message out" role="alert">${error.message}</p>`}
    ${!outcome && !busy && !error && html`<h2 class="first">${t('Start from an example')}</h2><div class="columns">${(list?.shipped || []).map((f) => html`<button class="tile" onClick=${() => open('examples:' + f)}>${f.replace(/\/[^/]*$/, '').replaceAll('-', ' ')}<span class="small dim">${f}</span></button>`)}</div>`}
    ${outcome && html`<div class=${busy ? 'stale' : ''}><${Outcome} data=${outcome} kept=${kept} tools=${html`<button class="button" disabled=${busy} onClick=${report}>${t('Report')}</button>
      <button class="button" disabled=${kept.length >= 2} onClick=${() => setKept([...kept, outcome])}>${t('Keep to compare')}</button>`} /></div>`}</section></main>`;
}

function Outcome({ data, kept, tools }) {
  const [chosen, choose] = useState({ sort: '', name: '' });
  const pick = (event) => {
    if (event.type === 'keydown' && event.key !== 'Enter' && event.key !== ' ') return;
    const place = event.target.closest?.('[data-unit],[data-stream]');
    if (!place) return;
    event.preventDefault();
    choose(place.dataset.unit ? { sort: 'unit', name: place.dataset.unit } : { sort: 'stream', name: place.dataset.stream });
  };
  const closes = Math.max(data.audit.mass_closure, data.audit.energy_closure) <= 1e-9;
  const cases = [...kept, data];
  return html`<div class="row spread"><h2 class="first">${data.title}</h2><div class="row">${tools}</div></div>
    <p class=${closes ? 'ok' : 'out'}>${closes ? '● ' : '▲ '}${t('mass closes to {mass}, energy to {energy}', { mass: number(data.audit.mass_closure, 2), energy: number(data.audit.energy_closure, 2) })}</p>
    <div class="diagram" onClick=${pick} onKeyDown=${pick} dangerouslySetInnerHTML=${{ __html: data.diagram }} />
    ${data.flags.map((flag) => html`<p class="message caution"><strong>${flag.unit}</strong> ${flag.message}</p>`)}
    ${chosen.sort === 'stream' && data.streams[chosen.name] && html`<div class="card"><h3>${chosen.name}</h3><${StreamPanel} stream=${data.streams[chosen.name]} /></div>`}
    ${chosen.sort === 'unit' && data.units[chosen.name] && html`<div class="card"><${UnitPanel} name=${chosen.name} unit=${data.units[chosen.name]} cases=${cases} /></div>`}
    <h2>${t('Streams')}</h2><div class="wide"><table><thead><tr><th scope="col">${t('stream')}</th><th class="n" scope="col">${t('solid')} kg/h</th><th class="n" scope="col">${t('liquid')} kg/h</th><th class="n" scope="col">${t('gas')} kg/h</th><th class="n" scope="col"><i>T</i> °C</th><th class="n" scope="col"><i>d</i><sub>50</sub> µm</th></tr></thead>
      <tbody>${Object.entries(data.stream_rows).map(([name, row]) => html`<tr><td>${name}</td>${['solid', 'liquid', 'gas', 'temperature', 'median'].map((k) => html`<td class="n">${row[k] === null ? '' : number(row[k])}</td>`)}</tr>`)}</tbody></table></div>
    <h2>${t('Equipment')}</h2><div class="columns">${Object.entries(data.units).map(([name, unit]) => html`<div class="card"><${UnitPanel} name=${name} unit=${unit} cases=${cases} /></div>`)}</div>`;
}

function UnitPanel({ name, unit, cases }) {
  return html`<h3>${name} <span class="dim">${unit.title || unit.model}</span></h3><div class="wide"><table><tbody>
    ${Object.entries(unit.results).map(([figure, row]) => html`<tr><td>${row.label || figure.replaceAll('_', ' ')}</td>${cases.map((c) => html`<td class="n" data-figure=${name + '.' + figure}>${c.units[name]?.results[figure]?.text ?? number(c.units[name]?.results[figure]?.value)}</td>`)}</tr>`)}
    ${unit.checks.map((c) => html`<tr class=${c.ok ? 'ok' : 'out'}><td>${c.ok ? '✓' : '✗'} ${c.name}</td><td class="n">${c.low !== null ? `${number(c.low)} ≤ ` : ''}${number(c.value)}${c.high !== null ? ` ≤ ${number(c.high)}` : ''} ${c.unit === 'dimensionless' ? '' : c.unit}</td></tr>`)}</tbody></table></div>`;
}

function StreamPanel({ stream: s }) {
  const phases = ['solid', 'liquid', 'gas'].flatMap((phase) => Object.entries(s[phase]).filter(([, flow]) => flow > 0).map(([name, flow]) => [phase, name, flow]));
  const figure = s.size && s.size.median !== null && {
    data: [{ type: 'scatter', mode: 'lines', line: { shape: 'hv', color: '#b7791f' }, x: s.size.boundaries.map((x) => x * 1e6), y: [...s.size.mass_fractions, 0].map((y) => y * 100) }],
    layout: { height: 260, margin: { l: 55, r: 15, t: 10, b: 45 }, xaxis: { type: 'log', dtick: 1, title: { text: t('particle diameter') + ' / µm' } }, yaxis: { title: { text: '% ' + t('by mass') } } },
  };
  return html`<div class="columns"><table><tbody><tr><td>${t('temperature')}</td><td class="n">${number(s.temperature.value - 273.15)} °C</td></tr><tr><td>${t('pressure')}</td><td class="n">${number(s.pressure.value / 1e5)} bar</td></tr>
    ${phases.map(([phase, name, flow]) => html`<tr><td>${t(phase)}: ${name}</td><td class="n">${number(flow * 3600)} kg/h</td></tr>`)}</tbody></table>${figure && html`<${Plot} figure=${figure} label=${t('Particle sizes')} />`}</div>`;
}
