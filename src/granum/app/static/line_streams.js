// The streams of a line: the table of all, as a file, and one by itself.
import { html, t, ask, download, useState } from './core.js';
import { FittedTable } from './fitted_table.js';
import { Plot } from './plot.js';
import { pretty } from './line_forms.js';

/** `turned`: a stream a column, for the few streams of one machine. */
export function StreamTable({ table, place = '', text, choose, labels, turned = false }) {
  const [problem, setProblem] = useState('');
  const [all, setAll] = useState(false);
  const rows = all ? table.rows : table.rows.filter(([name]) => !table.empty.includes(name));
  const take = async (form) => {
    setProblem('');
    try {
      const content = await ask(
        '/api/case/tables',
        { case: text, place, form },
        { text: form === 'csv', blob: form !== 'csv' },
      );
      download(`streams.${form}`, content, form === 'csv' ? 'text/csv' : 'application/octet-stream');
    } catch (fault) {
      setProblem(fault.message);
    }
  };
  const called = (name) => labels[name] || pretty(name);
  const drawn = turned
      ? {
          sort: 'turned',
          corner: html`<span class="hidden">${t('value')}</span>`,
          columns: rows.map(([name]) => ({ head: called(name), group: name })),
          rows: table.heads.map((head, i) => ({
            head: html`${head.label} <span class="dim">/ ${head.unit}</span>`,
            phase: head.phase,
            cells: rows.map(([, cells]) => cells[i]),
          })),
        }
      : {
          corner: t('stream'),
          columns: table.heads.map((head) => ({
            head: html`${head.label}<span class="dim">${head.unit}</span>`,
            phase: head.phase,
            group: head.group,
          })),
          rows: [
            ...rows.map(([name, cells]) => ({
              cells,
              head: choose
                ? html`<button class="name" onClick=${() => choose({ sort: 'stream', name })}>${called(name)}</button>`
                : called(name),
            })),
            ...table.sums.map(([head, cells]) => ({ head, cells, sort: 'sum' })),
          ],
        };
  return html`<div class="row spread"><h2>${t('Streams')}</h2><div class="row"><button class="button" onClick=${() => take('csv')}>CSV</button><button class="button" onClick=${() => take('xlsx')}>Excel</button></div></div>
    ${problem && html`<p class="message out" role="alert">${problem}</p>`}
    <div class="wide" tabindex="0" role="region" aria-label=${t('Streams')} data-streams><${FittedTable} about=${table} ...${drawn} /></div>
    ${
      table.empty.length > 0 &&
      html`<p class="small"><button class="link" data-empty aria-expanded=${String(all)} onClick=${() => setAll(!all)}>${
        all
          ? t('Hide what carries nothing')
          : table.empty.length === 1
            ? t('One stream carries nothing: show it')
            : t('{count} streams carry nothing: show them', { count: table.empty.length })
      }</button></p>`
    }`;
}

export function StreamPanel({ stream: s }) {
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
