// Results that run along an axis: every row in a table, one of the columns as a chart, all of it as a file.
import { html, t, download, useState } from './core.js';
import { Plot } from './plot.js';

const rising = (values) =>
  values.every((x, i) => i === 0 || x === null || values[i - 1] === null || x >= values[i - 1]) &&
  values.at(-1) > values[0];
const titled = (column) => (column.unit ? `${column.label} / ${column.unit}` : column.label);

export function Series({ card, tables }) {
  return tables.map(
    (table, i) => html`<${Table} key=${i} name=${card.card + (i ? `-${i + 1}` : '')} ...${table} />`,
  );
}

function Table({ name, columns, rows }) {
  const axis = columns.length > 1 && rising(columns[0].values) ? columns[0] : null;
  const [drawn, draw] = useState(columns[axis ? 1 : 0].name);
  const column = columns.find((c) => c.name === drawn) || columns.at(-1);
  const label = columns.map((c) => c.label).join(', ');
  const save = () => {
    const head = columns.map((c) => (c.file_unit ? `${c.name} [${c.file_unit}]` : c.name)).join(',');
    download(
      `${name}.csv`,
      [head, ...rows.map((_, i) => columns.map((c) => c.values[i] ?? '').join(','))].join('\n') + '\n',
      'text/csv',
    );
  };
  return html`<section class="series" data-series=${name}>
    ${
      axis &&
      html`<div class="row"><label>${t('Draw')} <select value=${drawn} onChange=${(e) => draw(e.target.value)}>${columns.slice(1).map((c) => html`<option value=${c.name} selected=${c.name === drawn}>${c.label}</option>`)}</select></label></div>
      <${Plot} figure=${figure(axis, column)} label=${titled(column)} files=${false} />`
    }
    <div class="row spread"><span class="small dim">${t('{count} rows', { count: rows.length })}</span><button class="button" onClick=${save}>${t('Download as CSV')}</button></div>
    <div class="wide tall" tabindex="0" role="region" aria-label=${label}><table><thead><tr>${columns.map((c) => html`<th scope="col" class="n">${c.label}${c.unit && html` <span class="dim">/ ${c.unit}</span>`}</th>`)}</tr></thead>
      <tbody>${rows.map((row) => html`<tr>${row.map((text) => html`<td class="n">${text}</td>`)}</tr>`)}</tbody></table></div></section>`;
}

const figure = (axis, column) => ({
  data: [
    {
      type: 'scatter',
      mode: axis.values.length > 40 ? 'lines' : 'lines+markers',
      x: axis.values,
      y: column.values,
      line: { color: '#0b6e6e' },
    },
  ],
  layout: {
    height: 280,
    margin: { l: 75, r: 15, t: 10, b: 50 },
    plot_bgcolor: 'white',
    xaxis: { title: { text: titled(axis) } },
    yaxis: { title: { text: titled(column) }, automargin: true },
  },
});
