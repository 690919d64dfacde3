// How far other accepted laws differ for the same inputs; asked for, since each law may have to be compiled first.
import { html, t, ask, link, useState } from './core.js';

export function Spread({ card, values, choose }) {
  const [rows, setRows] = useState(null);
  const [busy, setBusy] = useState(false);
  const [error, setError] = useState('');
  const load = async () => {
    setBusy(true); setError('');
    try { setRows((await ask(`/api/spread/${card.card}`, values)).rows); } catch (problem) { setError(problem.message); } finally { setBusy(false); }
  };
  return html`<details onToggle=${(e) => e.target.open && load()}><summary>${t('What other laws give')}</summary>
    ${busy && html`<p class="small dim" role="status">${t('Working…')}</p>`}${error && html`<p class="message out">${error}</p>`}
    ${rows && rows.length === 0 && html`<p class="small dim">${t('No other law takes these inputs.')}</p>`}
    ${rows?.length > 0 && html`<div class=${busy ? 'wide small stale' : 'wide small'}><table><tbody>${rows.map((row) => html`<tr><td>${Object.keys(row.changed).length
      ? html`<button class="plain" onClick=${() => choose({ ...values, ...row.changed })}>${row.label}</button>` : html`<a href=${link('calculate', row.card, values)}>${row.label}</a>`}</td>
      <td class="n">${row.text}</td><td class="caution" title=${row.notices.join(' ')}>${row.notices.length ? html`▲ <span class="small">${t('outside its range')}</span>` : ''}</td></tr>`)}</tbody></table></div>
    <div class="row"><button class="button" onClick=${load}>${t('Calculate again')}</button></div>`}</details>`;
}
