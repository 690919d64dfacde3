// Choices in order: the few that fit as cards, with what speaks for and against; the others folded, each with the one
// reason that excludes it.
import { html, t, settings } from './core.js';

const MOST = 4;
const LEAST = 10; // % of suitability below which a machine does not fit
const STEPS = [
  [75, 'fits well'],
  [40, 'fits with reservations'],
  [0, 'fits poorly'],
];

const parts = (text) => (text && text !== '—' ? text.split(/\s?;\s/) : []);
const percent = (text) => Number(text.replace(',', '.').replace(/[^\d.]/g, ''));

/** A row of the table by the names of its columns. */
function choiceOf(row, columns) {
  const at = (name) => row[columns.findIndex((c) => c.name === name)];
  const told = ['suitability', 'speaks_for', 'speaks_against'];
  return {
    title: row[0],
    mark: at('suitability') === undefined ? null : percent(at('suitability')),
    reasons: parts(at('speaks_for')),
    limits: parts(at('speaks_against')),
    figures: columns
      .map((c, i) => ({ label: c.label, text: row[i], name: c.name }))
      .slice(1)
      .filter((f) => !told.includes(f.name)),
  };
}

export function Ranking({ table }) {
  const choices = table.rows.map((row) => choiceOf(row, table.columns));
  const fitting = choices.filter((c) => c.mark === null || c.mark >= LEAST).slice(0, MOST);
  const shown = fitting.length ? fitting : choices.slice(0, 1);
  const rest = choices.slice(shown.length);
  return html`<div data-ranking><div class="choices">${shown.map((c) => html`<${Choice} key=${c.title} choice=${c} />`)}</div>
    ${rest.length > 0 && html`<details data-unfit><summary>${t('{count} more, less fitting', { count: rest.length })}</summary><ul class="plain">${rest.map((c) => html`<li key=${c.title}><strong>${c.title}</strong>${c.limits.length ? `${settings.language === 'fr' ? ' :' : ':'} ${c.limits[0]}` : ''}</li>`)}</ul></details>`}</div>`;
}

function Choice({ choice: { title, mark, reasons, limits, figures } }) {
  return html`<article class="card" data-choice><h2>${title}</h2>
    ${mark !== null && html`<div class="row suits"><span class="bar" aria-hidden="true"><span style=${`width: ${Math.round(mark / 10) * 10}%`}></span></span> <span class="small">${t(STEPS.find(([least]) => mark >= least)[1])}</span></div>`}
    ${figures.map((f) => html`<p class="small">${f.label}${settings.language === 'fr' ? ' :' : ':'} <strong>${f.text}</strong></p>`)}
    ${reasons.length > 0 && html`<ul class="plain small ok">${reasons.map((text) => html`<li>${text}</li>`)}</ul>`}
    ${limits.length > 0 && html`<ul class="plain small caution">${limits.map((text) => html`<li>${text}</li>`)}</ul>`}</article>`;
}
