// What a solved line gives: findings first, then streams, then every figure of the equipment; cases side by side.
import { colon, html, link, t } from './core.js';
import { StreamTable } from './line_streams.js';
import { pretty } from './line_forms.js';
import { Sankey } from './sankey.js';
import { Utilities } from './utilities.js';

export function Outcome({ data, cases, clear, choose, place, text, compared, labels, prices, build }) {
  const units = Object.entries(data.units);
  const failed = units.flatMap(([name, unit]) => unit.checks.filter((c) => !c.ok).map((c) => [name, c]));
  const kept = units.reduce((count, [, unit]) => count + unit.checks.filter((c) => c.ok).length, 0);
  const found = units.flatMap(([name, unit]) =>
    Object.entries(unit.results)
      .filter(([, row]) => row.finding)
      .map(([key, row]) => [name, key, row]),
  );
  return html`<p class="ok">● ${data.audit.text}</p>
    <section class="card findings" aria-label=${t('Findings')}><h2 class="first">${t('Findings')}</h2>
    ${failed.map(([name, c]) => html`<p class="out">✗ <strong>${pretty(name)}</strong>${colon()} ${c.name} ${c.text} <span class="dim">(${c.allowed})</span></p>`)}
    ${Object.entries(data.advice ?? {}).map(([name, one]) => html`<${Advice} key=${name} name=${name} advice=${one} />`)}
    ${kept > 0 && html`<p class="ok">✓ ${failed.length ? (kept === 1 ? t('One other limit is kept.') : t('{count} other limits are kept.', { count: kept })) : t('All {count} practical limits are kept.', { count: kept })}</p>`}
    ${!failed.length && !kept && !found.length && !data.found.length && html`<p class="dim">${t('No unit of this line has a practical limit to check.')}</p>`}
    ${data.found.map((row) => html`<p>${t('found')}${colon()} <strong>${pretty(row.unit)}</strong>, ${row.label} = ${row.text}</p>`)}
    ${found.length > 0 && html`<div class="wide" tabindex="0" role="region" aria-label=${t('Sizes and duties')}><table><tbody>${found.map(([name, key, row], i) => html`<tr data-finding=${name + '.' + key}><th scope="row">${i && found[i - 1][0] === name ? html`<span class="hidden">${pretty(name)}</span>` : pretty(name)}</th><td>${row.label}</td><td class="n"><strong>${row.text}</strong></td></tr>`)}</tbody></table></div>`}
    ${data.flags.map((flag) => html`<p class="message caution"><strong>${pretty(flag.unit || '')}</strong> ${flag.message}</p>`)}</section>
    ${compared && html`<${Comparison} cases=${cases} clear=${clear} />`}
    <${StreamTable} table=${data.stream_table} place=${place} text=${text} choose=${choose} labels=${labels} />
    <${Utilities} table=${data.utility_table} prices=${prices} build=${build} />
    <${Sankey} diagrams=${data.sankey} />
    <h2>${t('Equipment')}</h2>${units.map(([name, unit]) => html`<details key=${name} data-sheet=${name}><summary><strong>${pretty(name)}</strong> <span class="dim">${unit.title || unit.model}</span>${unit.checks.some((c) => !c.ok) && html` <span class="out">✗</span>`}</summary><${UnitFigures} name=${name} unit=${unit} cases=${cases} /></details>`)}`;
}

/** Which machines suit better than one that fails its checks, and the ranked list of them for the same stream. */
export function Advice({ name, advice }) {
  return html`<p data-advice=${name}>→ ${advice.told} <a href=${link('calculate', advice.card, advice.inputs)}>${t('Compare all')}</a></p>`;
}

export function UnitFigures({ name, unit, cases }) {
  return html`<div class="wide" tabindex="0" role="region" aria-label=${`${pretty(name)} – ${t('Results')}`}><table>${cases.length > 1 && html`<thead><tr><td></td>${cases.map((_, i) => html`<th class="n" scope="col">${i + 1}</th>`)}</tr></thead>`}<tbody>
    ${Object.entries(unit.results).map(([figure, row]) => html`<tr><td>${row.label || figure.replaceAll('_', ' ')}</td>${cases.map((c) => html`<td class="n" data-figure=${name + '.' + figure}>${c.units[name]?.results[figure]?.text ?? '—'}</td>`)}</tr>`)}
    ${unit.checks.map((c) => html`<tr class=${c.ok ? 'ok' : 'out'}><td>${c.ok ? '✓' : '✗'} ${c.name}</td><td class="n wrap" colspan=${cases.length}><span class="whole">${c.text}</span> <span class="whole dim">(${c.allowed})</span></td></tr>`)}</tbody></table></div>`;
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
          put(
            inputs,
            `${sort}.${name}.${p.name}`,
            `${pretty(name)}${colon()} ${p.label}`,
            i,
            item.values[p.name] ?? '—',
          );
      }
    }
    for (const [name, unit] of Object.entries(c.units))
      for (const [key, row] of Object.entries(unit.results))
        put(figures, `${name}.${key}`, `${pretty(name)}${colon()} ${row.label}`, i, row.text);
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
