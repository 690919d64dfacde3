// What a solved line takes from outside: power, heat, cold and materials by unit and carrier, and in all.
import { html, t } from './core.js';
import { pretty } from './line_forms.js';

export function Utilities({ table }) {
  if (table.rows.length === 0) return null;
  const label = t('Utilities');
  return html`<details data-utilities><summary>${label} <span class="dim">${table.headline[0]} ${table.headline[1]}</span></summary>
    <div class="wide" tabindex="0" role="region" aria-label=${label}><table><thead><tr><th scope="col">${t('unit')}</th><th scope="col">${t('utility')}</th><th class="n" scope="col">${t('value')}</th></tr></thead>
      <tbody>${table.rows.map((row) => html`<tr class=${row.counted ? '' : 'dim'} title=${row.source}><td>${pretty(row.unit)}</td><td>${row.label}</td><td class="n">${row.counted ? row.text : `(${row.text})`}</td></tr>`)}
      ${[...table.carriers, ...table.totals].map(([name, text], i) => html`<tr><td>${i === 0 ? t('whole line') : ''}</td><td>${name}</td><td class="n"><strong>${text}</strong></td></tr>`)}</tbody></table></div>
    <p class="small dim">${t('Product: {stream}. In brackets: given by another unit of the line, and not counted.', { stream: table.product })}</p></details>`;
}
