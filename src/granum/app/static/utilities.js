// What a solved line takes from outside: power, heat, cold and materials by unit and carrier, and in all.
import { html, t, useEffect, useRef } from './core.js';
import { pretty } from './line_forms.js';
import { Quantity, settled } from './quantity.js';

/** `prices`: fields of what may be bought, `build` the step that writes one into the case. */
export function Utilities({ table, prices = [], build }) {
  if (table.rows.length === 0) return null;
  const label = t('Utilities');
  return html`<details data-utilities><summary>${label} <span class="dim">${table.headline[0]} ${table.headline[1]}</span></summary>
    <div class="wide" tabindex="0" role="region" aria-label=${label}><table class="stack"><thead><tr><th scope="col">${t('unit')}</th><th scope="col">${t('utility')}</th><th class="n" scope="col">${t('value')}</th>${table.priced && html`<th class="n" scope="col">${t('cost')}</th>`}</tr></thead>
      <tbody>${table.rows.map((row) => html`<tr class=${row.counted ? '' : 'dim'} title=${row.source}><td>${pretty(row.unit)}</td><td>${row.label}</td><td class="n" data-head=${t('value')}>${row.counted ? row.text : `(${row.text})`}</td>${table.priced && html`<td class="n" data-head=${t('cost')} data-cost=${row.unit}>${row.cost}</td>`}</tr>`)}
      ${[...table.carriers, ...table.totals].map(([name, text], i) => html`<tr><td>${i === 0 ? t('whole line') : ''}</td><td>${name}</td><td class="n" data-head=${t('value')}><strong>${text}</strong></td>${table.priced && html`<td></td>`}</tr>`)}</tbody></table></div>
    <p class="small dim">${t('Product: {stream}. In brackets: given by another unit of the line, and not counted.', { stream: table.product })}</p>
    ${build && html`<${Prices} rows=${prices.filter((row) => row.value || table.taken.includes(row.name))} build=${build} />`}</details>`;
}

function Prices({ rows, build }) {
  if (!rows.length) return null;
  return html`<h3>${t('Prices')}</h3><p class="small dim">${t('In US dollars, or any currency that is used for all of them; the costs then stand in the table.')}</p>
    <div class="ports">${rows.map((row) => html`<div class="end" key=${row.name}><label for=${'price-' + row.name}>${row.label}</label><div class="entry"><${Price} row=${row} build=${build} /></div></div>`)}</div>`;
}

/** A price goes into the case when its field is left. */
function Price({ row, build }) {
  const typed = useRef(row.value);
  useEffect(() => {
    typed.current = row.value;
  }, [row.value]);
  const settle = () =>
    settled().then(() => {
      if (typed.current !== row.value) build('set_price', { carrier: row.name, price: typed.current });
    });
  return html`<div onfocusout=${settle}><${Quantity} p=${row} id=${'price-' + row.name} text=${row.value} label=${row.label} onChange=${(value) => {
    typed.current = value;
  }} /></div>`;
}
