// Lab data: drop a table, give the conditions, read parameters with intervals.
import {
  Awaited,
  html,
  t,
  ask,
  useAnswer,
  useState,
  useKept,
  recall,
  remember,
  settings,
  replaceLink,
  useEffect,
  useRef,
  download,
  Working,
} from './core.js';
import { Chapter } from './chapter.js';
import { Plot, decoded } from './plot.js';
import { UseInLine } from './lab_line.js';
import { Field, changed, fields, missingOf } from './form.js';
import { Finder, NoCard, useCards } from './cards.js';
import { inLanguage, unitLabel } from './quantity.js';

export function Lab({ state }) {
  const cards = useCards((c) => c.sort === 'lab test');
  const key =
    state.key ||
    (cards?.some((c) => c.card === 'filtration.leaf_test') ? 'filtration.leaf_test' : cards?.[0]?.card);
  const { data: card, error } = useAnswer(
    (signal) => (key ? ask(`/api/cards/${key}`, undefined, { signal }) : Promise.resolve(null)),
    [key, settings.language, settings.units],
    0,
  );
  return html`<main class="three" id="main"><${Finder} page="lab" current=${key} cards=${cards} />
    ${card && card.card === key ? html`<${Test} key=${key + settings.language + settings.units} card=${card} given=${state.values} />` : error?.details ? html`<${NoCard} heading=${t('Lab data')} error=${error} />` : html`<section aria-label=${t('Enter')}><${Awaited} text=${key ? t('The card is on its way…') : t('The list of cards is on its way…')} /></section><section />`}</main>`;
}

function Test({ card, given }) {
  const columns = card.parameters.filter((p) => p.series);
  const [values, setValues] = useState(
    Object.keys(given).length ? given : recall('conditions ' + card.card, {}),
  );
  const conditions = card.parameters
    .filter((p) => !p.series)
    .map((p) => ({
      ...p,
      hint:
        p.example && !p.default_shown
          ? t('e.g. {value}', { value: inLanguage(p.example.number) })
          : undefined,
    }));
  const example = columns.map((p) => `${p.label} [${p.units?.[0]?.unit || '1'}]`).join(',');
  const [table, setTable, tableKept] = useKept('table ' + card.card, '');
  const [told, setTold] = useKept('told ' + card.card, '');
  const [trial, setTrial] = useKept('trial ' + card.card, null);
  const [over, setOver] = useState(false);
  const [turn, setTurn] = useState(0); // of what is asked: that a text was understood asks nothing new
  const dropped = useRef(0);
  const give = (next) => {
    setTurn((before) => before + 1);
    setValues(next);
  };
  useEffect(() => {
    replaceLink('lab', card.card, values);
    remember('conditions ' + card.card, values);
  }, [values]);
  const missing = missingOf(card, conditions, values);
  const answer = useAnswer(
    async (signal) => {
      if (!table.trim() || missing.length) return null;
      const form = new FormData();
      form.append('file', new File([table], 'data.csv', { type: 'text/csv' }));
      form.append('conditions', JSON.stringify(values));
      return ask(`/api/fit/${card.card}`, form, { signal });
    },
    [table, turn],
    250,
  );
  const [workbook, setWorkbook] = useState(null);
  const take = async (list, sheet = '') => {
    if (!list?.length) return;
    const mine = ++dropped.current;
    const form = new FormData();
    form.append('file', list[0]);
    form.append('sheet', sheet);
    try {
      const { text, sheets } = await ask('/api/table', form);
      if (dropped.current !== mine) return; // another table came meanwhile
      setTold(list[0].name);
      setWorkbook(sheets.length > 1 ? { file: list[0], sheets, sheet: sheet || sheets[0] } : null);
      now.current(text);
    } catch (problem) {
      if (dropped.current === mine) setTold(problem.message);
    }
  };
  const own = (text) => {
    // a table of one's own: what an example said of its test does not hold for it
    dropped.current += 1;
    if (trial) {
      give((before) =>
        Object.fromEntries(Object.entries(before).filter(([name, value]) => trial.values[name] !== value)),
      );
      setTrial(null);
      setTold(t('The conditions of the example were taken out: give those of your test.'));
    }
    setTable(text);
  };
  const now = useRef(own);
  now.current = own;
  const tryIt = () => {
    dropped.current += 1;
    setTable(card.trial.table);
    give(card.trial.values);
    setTrial(card.trial);
    setTold('');
    setWorkbook(null);
  };
  const left = answer.data && !answer.pending ? leftOutAtStart(answer.data.kept) : 0;
  const shown = conditions.map((p) =>
    p.name === 'first_points_excluded' && left > 0
      ? { ...p, allowed: t('{count} (found automatically)', { count: left }) }
      : p,
  );
  const wrong = fields(card, conditions).find((p) => p.name === answer.error?.details?.name);
  return html`<section aria-label=${t('Enter')}><h1>${card.title}</h1><p class="dim">${card.summary} <${Chapter} card=${card.card} /></p>
      <div class=${'drop' + (over ? ' over' : '')} onDragOver=${(e) => {
        e.preventDefault();
        setOver(true);
      }} onDragLeave=${() => setOver(false)} onDrop=${(e) => {
        e.preventDefault();
        setOver(false);
        take(e.dataTransfer.files);
      }}>
        <p>${t('Drop a CSV or Excel file here, or choose one:')}</p><label class="button">${t('Choose a file')}<input class="hidden" type="file" accept=".csv,.tsv,.txt,.xlsx" onChange=${(e) => take(e.target.files)} /></label>
        <div role="status">${told}</div>
        ${workbook && html`<label class="end" for="sheet"><span>${t('One of {count} sheets', { count: workbook.sheets.length })}</span><select id="sheet" value=${workbook.sheet} onChange=${(e) => take([workbook.file], e.target.value)}>${workbook.sheets.map((name) => html`<option value=${name} selected=${name === workbook.sheet}>${name}</option>`)}</select></label>`}</div>
      ${card.trial && html`<div class="row"><button class="button" onClick=${tryIt}>${t('Try with example data')}</button>${trial && html` <span class="caution" role="status" data-trial>▲ ${t('Example: data and conditions of {name}', { name: trial.name })}</span>`}</div>`}
      <h2 class="screen"><label for="table">${t('or paste the table')}</label></h2>
      <textarea id="table" rows="9" placeholder=${example + '\n…'} value=${table} onInput=${(e) => own(e.target.value)}></textarea>
      ${!tableKept && html`<p class="message caution" role="status">▲ ${t('This table is too large to be kept here: it is gone after a reload.')}</p>`}
      <${Columns} columns=${columns} table=${table} change=${setTable} />
      <${Rows} table=${table} change=${setTable} />
      <p class="small dim screen">${t('The first line names the columns with their units:')} <code>${example}</code></p>
      <h2>${t('Conditions')}</h2><form onSubmit=${(e) => e.preventDefault()}>${fields(card, shown).map((p) => html`<${Field} key=${p.name} parameter=${p} text=${values[p.name]} onChange=${(text, understood) => (understood ? setValues : give)((before) => changed(before, p, text))} problem=${wrong?.name === p.name ? answer.error.message : ''} />`)}</form></section>
    <section aria-label=${t('Believe')} aria-live="polite">${answer.error && (wrong ? html`<p class="message out told">${t('Nothing is calculated before this is mended: {name}', { name: wrong.label })}</p>` : html`<p class="message out">${answer.error.message}</p>`)}
      ${table.trim() && missing.length > 0 && html`<p class="message dim">${t('Still to be given: {names}', { names: missing.map((p) => p.label).join(', ') })}</p>`}
      <${Working} busy=${answer.pending} cancel=${answer.cancel} job=${answer.job} />
      ${!answer.data && !answer.error && html`<p class="dim">${t('Parameters with their 95 % intervals appear here.')}</p>`}
      <div class=${answer.pending || answer.error ? 'stale' : ''} aria-busy=${String(answer.pending)}>${answer.data && html`<${Fitted} data=${answer.data} values=${values} table=${table} leave=${(point) => setTable(toggled(table, point, answer.data.kept.length))} />`}</div>
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

const bared = (text) =>
  text
    .normalize('NFD')
    .replace(/[\u0300-\u036f]/g, '')
    .toLowerCase()
    .replace(/[\s\-'’]+/g, '_');
/** Whether a heading is a column's name, or its label in either language. */
const means = (cell, p) => [p.name, ...(p.headings || [])].includes(bared(heading(cell).name));

/** The rows of values under the heading: where they are, and whether they are left out (a # before them). */
function rowsOf(table) {
  const head = headOf(table);
  if (!head) return [];
  return head.lines
    .map((line, at) => ({
      at,
      out: line.trimStart().startsWith('#'),
      text: line.replace(/^\s*#\s*/, '').trim(),
    }))
    .filter(({ at, text }) => at >= head.at + (head.bare ? 0 : 1) && /^[-+−.,\d]/.test(text));
}
const flipped = (table, { at, out, text }) => {
  const lines = table.split('\n');
  lines[at] = out ? text : `# ${text}`;
  return lines.join('\n');
};
/** The table with a point of the fit left out; unchanged where points and rows do not match one for one. */
function toggled(table, point, points) {
  const used = rowsOf(table).filter((row) => !row.out);
  return used.length === points && used[point] ? flipped(table, used[point]) : table;
}
const leftOutAtStart = (kept) => {
  const first = kept.indexOf(true);
  return first > 0 && kept.slice(first).every(Boolean) ? first : 0;
};

/** Every row with a tick: those without one do not take part in the fit. */
function Rows({ table, change }) {
  const rows = rowsOf(table);
  if (!rows.length) return null;
  const out = rows.filter((row) => row.out).length;
  return html`<details class="rows" data-rows><summary>${t('Points')} <span class="dim">${rows.length}</span>${out > 0 && html` <span class="caution" data-left-out>${t('{count} left out by you', { count: out })}</span>`}</summary>
    <div class="scroll" tabindex="0" role="group" aria-label=${t('Points')}>${rows.map((row) => html`<label class="choice line small"><input type="checkbox" checked=${!row.out} onChange=${() => change(flipped(table, row))} /> <span class=${row.out ? 'dim' : ''}>${row.text}</span></label>`)}</div></details>`;
}

/** Which column of the table is what, in which unit; a choice rewrites the first line of the table. */
function Columns({ columns, table, change }) {
  const head = headOf(table);
  if (!head) return null;
  const set = (p, place, unit) => {
    const cells = head.cells.map((cell, i) =>
      i === place ? `${p.name}${unit ? ` [${unit}]` : ''}` : means(cell, p) ? `(${cell})` : cell,
    );
    const lines = [...head.lines];
    lines.splice(head.at, head.bare ? 0 : 1, cells.join(head.mark));
    change(lines.join('\n'));
  };
  return html`<div class="mapping screen"><h2>${t('Which column is what')}</h2>${columns.map((p) => {
    const place = head.bare ? -1 : head.cells.findIndex((cell) => means(cell, p));
    const unit = place < 0 ? '' : heading(head.cells[place]).unit;
    const usual = p.units?.[0]?.unit === 'dimensionless' ? '' : p.units?.[0]?.unit || '';
    return html`<div class="field" key=${p.name}><label for=${'column-' + p.name}>${p.label} <span class="symbol" dangerouslySetInnerHTML=${{ __html: p.symbol_shown || '' }} />${!p.required && html` <span class="small dim">${t('optional')}</span>`}</label>
      <div class="entry"><select id=${'column-' + p.name} class="alone" value=${String(place)} onChange=${(e) => Number(e.target.value) >= 0 && set(p, Number(e.target.value), heading(head.cells[Number(e.target.value)]).unit || usual)}>
        <option value="-1">—</option>${head.cells.map((cell, i) => html`<option value=${String(i)} selected=${i === place}>${cell || t('column {number}', { number: i + 1 })}</option>`)}</select>
      ${
        p.units?.length > 0 &&
        html`<select aria-label=${t('Unit of {name}', { name: p.label })} value=${unit} disabled=${place < 0} onChange=${(e) => set(p, place, e.target.value)}>
        ${!p.units.some((u) => u.unit === unit) && html`<option value=${unit} selected>${unit || '—'}</option>`}${p.units.map((u) => html`<option value=${u.unit} selected=${u.unit === unit}>${unitLabel(u)}</option>`)}</select>`
      }</div></div>`;
  })}</div>`;
}

/** Residuals by themselves, where the chart has no room of its own for them. */
const residuals = (data) => ({
  data: [
    {
      type: 'scatter',
      mode: 'markers',
      x: data.residuals.map((_, i) => i + 1),
      y: data.residuals,
      name: t('residuals'),
      marker: {
        color: data.kept.map((kept) => (kept ? '#1c2430' : 'white')),
        size: 6,
        line: { color: '#1c2430', width: 1.5 },
      },
    },
  ],
  layout: {
    template: data.chart.layout.template,
    height: 240,
    margin: { l: 70, r: 15, t: 10, b: 45 },
    xaxis: { title: { text: t('point') }, dtick: Math.ceil(data.residuals.length / 12) },
    yaxis: {
      title: { text: `${t('measured − model')}${data.residual_unit && ` / ${data.residual_unit}`}` },
      zeroline: true,
      zerolinecolor: '#1c2430',
    },
  },
});

/** The point of the fit that a mark of the chart stands for; null where the chart shows something else. */
function pointOf(mark, data) {
  const { x, type } = mark.data;
  const places = data.kept.map((_, i) => i);
  const traces = [places, places.filter((i) => data.kept[i]), places.filter((i) => !data.kept[i])];
  const shown = type === 'scatter' && mark.data.mode?.includes('markers') && decoded(x);
  const found = shown && traces.find((trace) => trace.length === shown.length);
  return found ? found[mark.pointIndex] : null;
}

function Fitted({ data, values, table, leave }) {
  const mark = (found) => {
    const point = pointOf(found, data);
    if (point !== null) leave(point);
  };
  const apart = data.residuals?.length > 0 && !Array.isArray(data.residuals[0]) && !data.chart.layout.yaxis2;
  const save = () => {
    const { chart: _chart, ...rest } = data;
    download(`${data.card}.json`, JSON.stringify(rest, null, 1), 'application/json');
  };
  return html`<div class="wide" tabindex="0" role="region" aria-label=${t('Parameters')}><table class="stack"><thead><tr><th scope="col">${t('parameter')}</th><th class="n" scope="col">${t('value ± standard error')}</th><th class="n" scope="col">${t('95 % interval')}</th></tr></thead>
    <tbody>${data.shown.map((row) => html`<tr data-parameter=${row.name} class=${row.derived ? 'dim' : ''}><td>${row.label}${row.unit && html` <span class="dim">/ ${row.unit}</span>`}</td><td class="n" data-head=${t('value ± standard error')}>${row.derived ? row.together : html`<strong>${row.together}</strong>`}</td><td class="n" data-head=${t('95 % interval')}>${row.between}</td></tr>`)}</tbody></table></div>
    ${data.flags.map((flag) => html`<p class="message caution">${flag.message || flag}</p>`)}
    ${data.chart && html`<${Plot} figure=${data.chart} label=${t('Data and fit')} name=${data.card} onMark=${mark} />`}
    ${apart && html`<h2>${t('Residuals')}</h2><${Plot} figure=${residuals(data)} label=${t('Residuals')} files=${false} onMark=${mark} />`}
    <p class="small dim screen">${t('Click a point to leave it out of the fit.')}</p>
    <details><summary>${t('Statistics')}</summary><table class="small" data-statistics><tbody>${data.statistics_rows.map(([label, text]) => html`<tr><td>${label}</td><td class="n">${text}</td></tr>`)}</tbody></table></details>
    ${data.remarks.map((text) => html`<p class="small dim">${text}</p>`)}
    <${UseInLine} data=${data} values=${values} table=${table} />
    <div class="row"><button class="button" onClick=${save}>${t('Download the result')}</button></div>`;
}
