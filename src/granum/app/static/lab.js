// Lab data: drop a table, give the conditions, read parameters with intervals.
import {
  html,
  t,
  ask,
  useAnswer,
  useState,
  useKept,
  settings,
  replaceLink,
  useEffect,
  download,
  Working,
} from './core.js';
import { Plot } from './plot.js';
import { UseInLine } from './lab_line.js';
import { Field, changed, fields, missingOf } from './form.js';
import { Finder, useCards } from './cards.js';
import { inLanguage } from './quantity.js';

export function Lab({ state }) {
  const cards = useCards((c) => c.sort === 'lab test');
  const key =
    state.key ||
    (cards?.some((c) => c.card === 'filtration.leaf_test') ? 'filtration.leaf_test' : cards?.[0]?.card);
  const { data: card } = useAnswer(
    (signal) => (key ? ask(`/api/cards/${key}`, undefined, { signal }) : Promise.resolve(null)),
    [key, settings.language, settings.units],
    0,
  );
  return html`<main class="three" id="main"><${Finder} page="lab" current=${key} cards=${cards} />
    ${card && card.card === key ? html`<${Test} key=${key + settings.language + settings.units} card=${card} given=${state.values} />` : html`<section aria-busy="true"><p class="dim">${t('Loading…')}</p></section><section />`}</main>`;
}

function Test({ card, given }) {
  const columns = card.parameters.filter((p) => p.series);
  const conditions = card.parameters
    .filter((p) => !p.series)
    .map((p) => ({
      ...p,
      hint:
        p.example && !p.default_shown
          ? t('e.g. {value}', { value: inLanguage(p.example.number) })
          : undefined,
    }));
  const example = columns.map((p) => `${p.name} [${p.units?.[0]?.unit || '1'}]`).join(',');
  const [values, setValues] = useState(given);
  const [table, setTable] = useKept('table ' + card.card, '');
  const [told, setTold] = useKept('told ' + card.card, '');
  const [trial, setTrial] = useKept('trial ' + card.card, null);
  const [over, setOver] = useState(false);
  useEffect(() => replaceLink('lab', card.card, values), [values]);
  const missing = missingOf(card, conditions, values);
  const answer = useAnswer(
    async (signal) => {
      if (!table.trim() || missing.length) return null;
      const form = new FormData();
      form.append('file', new File([table], 'data.csv', { type: 'text/csv' }));
      form.append('conditions', JSON.stringify(values));
      return ask(`/api/fit/${card.card}`, form, { signal });
    },
    [table, JSON.stringify(values)],
    250,
  );
  const take = async (list) => {
    if (!list?.length) return;
    const form = new FormData();
    form.append('file', list[0]);
    try {
      const { text } = await ask('/api/table', form);
      setTold(list[0].name);
      own(text);
    } catch (problem) {
      setTold(problem.message);
    }
  };
  const own = (text) => {
    // a table of one's own: what an example said of its test does not hold for it
    if (trial) {
      setValues(
        Object.fromEntries(Object.entries(values).filter(([name, value]) => trial.values[name] !== value)),
      );
      setTrial(null);
      setTold(t('The conditions of the example were taken out: give those of your test.'));
    }
    setTable(text);
  };
  const tryIt = () => {
    setTable(card.trial.table);
    setValues(card.trial.values);
    setTrial(card.trial);
    setTold('');
  };
  const wrong = fields(card, conditions).find((p) => p.name === answer.error?.details?.name);
  return html`<section aria-label=${t('Enter')}><h1>${card.title}</h1><p class="dim">${card.summary}</p>
      <div class=${'drop' + (over ? ' over' : '')} onDragOver=${(e) => {
        e.preventDefault();
        setOver(true);
      }} onDragLeave=${() => setOver(false)} onDrop=${(e) => {
        e.preventDefault();
        setOver(false);
        take(e.dataTransfer.files);
      }}>
        <label>${t('Drop a CSV or Excel file here, or choose one:')} <input type="file" accept=".csv,.tsv,.txt,.xlsx" onChange=${(e) => take(e.target.files)} /></label>
        <div role="status">${told}</div></div>
      ${card.trial && html`<div class="row"><button class="button" onClick=${tryIt}>${t('Try with example data')}</button>${trial && html` <span class="caution" role="status" data-trial>▲ ${t('Example: data and conditions of {name}', { name: trial.name })}</span>`}</div>`}
      <h2><label for="table">${t('or paste the table')}</label></h2>
      <textarea id="table" rows="9" placeholder=${example + '\n…'} value=${table} onInput=${(e) => own(e.target.value)}></textarea>
      <${Columns} columns=${columns} table=${table} change=${setTable} />
      <p class="small dim">${t('The first line names the columns with their units:')} <code>${example}</code></p>
      <h2>${t('Conditions')}</h2><form onSubmit=${(e) => e.preventDefault()}>${fields(card, conditions).map((p) => html`<${Field} key=${p.name} parameter=${p} text=${values[p.name]} onChange=${(text) => setValues(changed(values, p, text))} problem=${wrong?.name === p.name ? answer.error.message : ''} />`)}</form></section>
    <section aria-label=${t('Believe')} aria-live="polite">${answer.error && (wrong ? html`<p class="message out told">${t('Nothing is calculated before this is mended: {name}', { name: wrong.label })}</p>` : html`<p class="message out">${answer.error.message}</p>`)}
      ${table.trim() && missing.length > 0 && html`<p class="message dim">${t('Still to be given: {names}', { names: missing.map((p) => p.label).join(', ') })}</p>`}
      <${Working} busy=${answer.pending} cancel=${answer.cancel} job=${answer.job} />
      ${!answer.data && !answer.error && html`<p class="dim">${t('Parameters with their 95 % intervals appear here.')}</p>`}
      <div class=${answer.pending || answer.error ? 'stale' : ''} aria-busy=${String(answer.pending)}>${answer.data && html`<${Fitted} data=${answer.data} values=${values} table=${table} />`}</div>
      <p class="small dim">${card.citation}</p></section>`;
}

const MARKS = ['\t', ';', ','];
const HEADING = /^\s*(.*?)\s*(?:[[(]\s*(.*?)\s*[\])]|\s\/\s*(.+?))?\s*$/;

/** The first line of a table: where it is, its separator, its cells; a table without names gets numbered columns. */
function headOf(table) {
  const lines = table.split('\n');
  const at = lines.findIndex((line) => line.trim() && !line.trimStart().startsWith('#'));
  if (at < 0) return null;
  const mark = MARKS.reduce((best, one) =>
    lines[at].split(one).length > lines[at].split(best).length ? one : best,
  );
  const cells = lines[at].split(mark).map((cell) => cell.trim().replace(/^"|"$/g, ''));
  const bare = cells.every((cell) => cell !== '' && Number.isFinite(Number(cell.replace(',', '.'))));
  return {
    lines,
    at,
    mark,
    bare,
    cells: bare ? cells.map((_, i) => t('column {number}', { number: i + 1 })) : cells,
  };
}
const heading = (cell) => {
  const [, name, one, other] = HEADING.exec(cell);
  return { name: name.toLowerCase().replace(/[ -]/g, '_'), unit: one ?? other ?? '' };
};

/** Which column of the table is what, in which unit; a choice rewrites the first line of the table. */
function Columns({ columns, table, change }) {
  const head = headOf(table);
  if (!head) return null;
  const set = (p, place, unit) => {
    const cells = head.cells.map((cell, i) =>
      i === place
        ? `${p.name}${unit ? ` [${unit}]` : ''}`
        : heading(cell).name === p.name
          ? `(${cell})`
          : cell,
    );
    const lines = [...head.lines];
    lines.splice(head.at, head.bare ? 0 : 1, cells.join(head.mark));
    change(lines.join('\n'));
  };
  return html`<h2>${t('Which column is what')}</h2>${columns.map((p) => {
    const place = head.bare ? -1 : head.cells.findIndex((cell) => heading(cell).name === p.name);
    const unit = place < 0 ? '' : heading(head.cells[place]).unit;
    const usual = p.units?.[0]?.unit === 'dimensionless' ? '' : p.units?.[0]?.unit || '';
    return html`<div class="field" key=${p.name}><label for=${'column-' + p.name}>${p.label} <span class="symbol" dangerouslySetInnerHTML=${{ __html: p.symbol_shown || '' }} />${!p.required && html` <span class="small dim">${t('optional')}</span>`}</label>
      <div class="entry"><select id=${'column-' + p.name} class="alone" value=${String(place)} onChange=${(e) => Number(e.target.value) >= 0 && set(p, Number(e.target.value), heading(head.cells[Number(e.target.value)]).unit || usual)}>
        <option value="-1">—</option>${head.cells.map((cell, i) => html`<option value=${String(i)} selected=${i === place}>${cell || t('column {number}', { number: i + 1 })}</option>`)}</select>
      ${
        p.units?.length > 0 &&
        html`<select aria-label=${t('Unit of {name}', { name: p.label })} value=${unit} disabled=${place < 0} onChange=${(e) => set(p, place, e.target.value)}>
        ${!p.units.some((u) => u.unit === unit) && html`<option value=${unit} selected>${unit || '—'}</option>`}${p.units.map((u) => html`<option value=${u.unit} selected=${u.unit === unit}>${u.label || '1'}</option>`)}</select>`
      }</div></div>`;
  })}`;
}

const residuals = (data) => ({
  data: [
    {
      type: 'scatter',
      mode: 'markers',
      x: data.residuals.map((_, i) => i + 1),
      y: data.residuals,
      marker: { color: '#0b6e6e', symbol: data.kept.map((kept) => (kept ? 'circle' : 'circle-open')) },
    },
  ],
  layout: {
    height: 240,
    margin: { l: 70, r: 15, t: 10, b: 45 },
    plot_bgcolor: 'white',
    xaxis: { title: { text: t('point') }, dtick: Math.ceil(data.residuals.length / 12) },
    yaxis: { title: { text: t('measured less model (SI)') }, zeroline: true, zerolinecolor: '#1c2430' },
  },
});

function Fitted({ data, values, table }) {
  const save = () => {
    const { chart: _chart, ...rest } = data;
    download(`${data.card}.json`, JSON.stringify(rest, null, 1), 'application/json');
  };
  return html`<div class="wide"><table><thead><tr><th scope="col">${t('parameter')}</th><th class="n" scope="col">${t('value')}</th><th class="n" scope="col">${t('standard error')}</th><th class="n" scope="col">${t('95 % interval')}</th></tr></thead>
    <tbody>${data.shown.map((row) => html`<tr data-parameter=${row.name} class=${row.derived ? 'dim' : ''}><td>${row.label}${row.unit && html` <span class="dim">/ ${row.unit}</span>`}</td><td class="n">${row.derived ? row.value : html`<strong>${row.value}</strong>`}</td><td class="n">${row.error}</td><td class="n wrap">${row.interval}</td></tr>`)}</tbody></table></div>
    ${data.flags.map((flag) => html`<p class="message caution">${flag.message || flag}</p>`)}
    ${data.chart && html`<${Plot} figure=${data.chart} label=${t('Data and fit')} />`}
    ${data.residuals?.length > 0 && !Array.isArray(data.residuals[0]) && html`<h2>${t('Residuals')}</h2><${Plot} figure=${residuals(data)} label=${t('Residuals')} />`}
    <p class="small dim">${data.statistics_shown}</p>
    <${UseInLine} data=${data} values=${values} table=${table} />
    <button class="button" onClick=${save}>${t('Download the result')}</button>`;
}
