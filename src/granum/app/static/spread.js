// How far other accepted laws differ for the same inputs; asked for, since each law may have to be compiled first. Open, it follows the inputs.
import { html, t, ask, link, useAnswer, Working } from './core.js';

export function Spread({ card, values, choose, open, setOpen }) {
  const { data, error, pending, cancel, job } = useAnswer(
    (signal) => (open ? ask(`/api/spread/${card.card}`, values, { signal }) : Promise.resolve(null)),
    [open, card.card, JSON.stringify(values)],
    200,
  );
  const rows = data?.rows;
  return html`<details open=${open} onToggle=${(e) => setOpen(e.target.open)}><summary>${t('What other laws give')}</summary>
    <${Working} busy=${open && pending} cancel=${cancel} job=${job} />${error && html`<p class="message out">${error.message}</p>`}
    ${rows && rows.length === 0 && html`<p class="small dim">${t('No other law takes these inputs.')}</p>`}
    ${
      rows?.length > 0 &&
      html`<div data-spread class=${pending || error ? 'wide small stale' : 'wide small'}><table><tbody>${rows.map(
        (row) => html`<tr><td>${
          Object.keys(row.changed).length
            ? html`<button class="plain" onClick=${() => choose({ ...values, ...row.changed })}>${row.label}</button>`
            : html`<a href=${link('calculate', row.card, values)}>${row.label}</a>`
        }</td>
      <td class="n">${row.text}</td><td class="caution" title=${row.notices.join(' ')}>${row.notices.length ? html`▲ <span class="small">${t('outside its range')}</span>` : ''}</td></tr>`,
      )}</tbody></table></div>`
    }</details>`;
}
