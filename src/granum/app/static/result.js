// The right column: what came out and whether to believe it.
import { html, t, link, settings, useState, useKept, toClipboard } from './core.js';
import { unitLabel } from './quantity.js';
import { Sensitivity } from './sensitivity.js';
import { Series } from './series.js';
import { Spread } from './spread.js';
import { Comparison } from './comparison.js';
import { Ranking } from './ranking.js';

export function Result({ card, values, data, old, kept, keep, clear, choose, laws, setLaws, sheet }) {
  const bad = data.flags.length > 0;
  const single = data.shown.length <= 3;
  const [units, setUnits] = useKept('units ' + card.card, {});
  const [choice, setChoice] = useKept('against ' + card.card, {});
  const [saving, setSaving] = useState(false);
  const save = async () => {
    setSaving(true);
    await sheet({ ...choice, unit: units[choice.output || card.outputs[0]?.name] || '' }).finally(() =>
      setSaving(false),
    );
  };
  const within = (row) => data.intervals?.[row.name];
  const value = (row) =>
    html`<${Value} row=${row} unit=${units[row.name]} setUnit=${(unit) => setUnits({ ...units, [row.name]: unit })} />`;
  return html`${data.table && html`<${Ranking} table=${data.table} />`}${
    single
      ? data.shown.map(
          (row) =>
            html`<div class="answer"><div class="dim">${row.label} <span dangerouslySetInnerHTML=${{ __html: row.symbol }} /></div><div class="value">${value(row)}</div>${within(row) && html`<div data-interval=${row.name}>${within(row).text} <span class="small dim">${within(row).how}</span></div>`}</div>`,
        )
      : html`<div class="wide"><table class="answers"><tbody>${data.shown.map((row) => html`<tr><td>${row.label} <span class="dim" dangerouslySetInnerHTML=${{ __html: row.symbol }} /></td><td class="n">${value(row)}${within(row) && html`<div class="small" data-interval=${row.name} title=${within(row).how}>${within(row).text}</div>`}</td></tr>`)}</tbody></table></div>`
  }
    ${data.beside_shown.length > 0 && html`<ul class="beside">${data.beside_shown.map((row) => html`<li data-beside=${row.name} class=${row.inside ? 'dim' : 'caution'}>${row.label} <span dangerouslySetInnerHTML=${{ __html: row.symbol }} /> = <strong>${row.text}</strong>, ${row.place.replace(/ (?=× 10)|(?<=×) /g, '\u00a0')}</li>`)}</ul>`}
    <div class=${bad ? 'caution' : 'ok'} data-belief=${bad ? 'caution' : 'ok'}>${bad ? data.flags.map((f) => html`<p class="mark">▲ ${f.message}</p>`) : html`<p class="mark">● ${Object.keys(card.fitted).length ? t('inside the range the source covers') : t('no limit exceeded')}</p>`}</div>
    <${Series} card=${card} tables=${data.series} />
    <div class="row"><button class="button" disabled=${old || kept.length >= 2} onClick=${keep}>${t('Keep to compare')}</button>
      ${!data.table && html`<button class="button" disabled=${old} onClick=${save}>${saving ? t('Writing…') : t('Calculation sheet')}</button>`}</div>
    ${kept.length > 0 && html`<${Comparison} cases=${[...kept, data]} clear=${clear} />`}
    <${Sensitivity} card=${card} values=${values} old=${old} units=${units} laws=${laws} choice=${choice} setChoice=${setChoice} />
    ${card.sort === 'formula' && html`<${Spread} card=${card} values=${values} choose=${choose} open=${laws} setOpen=${setLaws} />`}
    ${data.equation && html`<h2>${t('Equation')}</h2><div class="equation" tabindex="0" role="region" aria-label=${t('Equation')} dangerouslySetInnerHTML=${{ __html: data.equation }} />`}
    ${data.equation_numbers && html`<div class="equation" tabindex="0" role="region" aria-label=${t('Equation with numbers')} data-numbers dangerouslySetInnerHTML=${{ __html: data.equation_numbers }} />`}
    ${data.inputs_shown.length > 0 && html`<p class="small dim">${t('with')} ${data.inputs_shown.map((row, i) => html`${i > 0 ? (settings.language === 'fr' ? ' ; ' : '; ') : ''}<span class="pair">${row.symbol ? html`<span dangerouslySetInnerHTML=${{ __html: row.symbol }} />` : row.label} = ${row.text}</span>`)}</p>`}
    <h2>${t('Source')}</h2><p class="small">${data.citation}</p>
    ${card.exercises?.length > 0 && html`<h2>${t('Exercises with this')}</h2><ul class="plain small" data-exercises>${card.exercises.map((e) => html`<li><a href=${link('exercises', e.id)}>${e.title}</a></li>`)}</ul>`}
    <details><summary>${t('The same in Python')}</summary><pre>${data.python}</pre></details>
    <details><summary>${t('The same on the command line')}</summary><pre>${data.command}</pre></details>
    <details><summary>${t('About')}</summary><pre lang="en">${card.doc}</pre></details>`;
}

const COPY = html`<svg width="14" height="14" viewBox="0 0 16 16" fill="none" stroke="currentColor" stroke-width="1.5" aria-hidden="true"><rect x="5.5" y="5.5" width="9" height="9" rx="1.5" /><path d="M10.5 5.5v-3a1 1 0 0 0-1-1h-7a1 1 0 0 0-1 1v7a1 1 0 0 0 1 1h3" /></svg>`;

/** A number with a menu of its units; copied, it has all its digits. */
function Value({ row, unit, setUnit }) {
  const [copied, setCopied] = useState(false);
  const chosen = row.units.find((u) => u.unit === unit) || row.units[0];
  if (!chosen) return html`<span data-output=${row.name}>${row.text}</span>`;
  const text = `${chosen.text} ${chosen.label}`.trim();
  const full = `${chosen.full} ${chosen.label}`.trim();
  const copy = async () => {
    if (!(await toClipboard(full))) return;
    setCopied(true);
    setTimeout(() => setCopied(false), 1500);
  };
  return html`<span class="figure"><span data-output=${row.name} title=${full} onCopy=${(e) => {
    e.clipboardData.setData('text/plain', full);
    e.preventDefault();
  }}>${text}</span>${
    row.units.length > 1 &&
    html`<span class="units"><span aria-hidden="true">▾</span><select aria-label=${t('Unit of {name}', { name: row.label })} value=${chosen.unit} onChange=${(e) => setUnit(e.target.value)}>${row.units.map((u) => html`<option value=${u.unit} selected=${u.unit === chosen.unit}>${unitLabel(u)}</option>`)}</select></span>`
  }<button class="copy" title=${full} aria-label=${t('Copy {name} with all digits', { name: row.label })} onClick=${copy}>${copied ? '✓' : COPY}</button></span>`;
}
