// How far other accepted laws differ for the same inputs; asked for, since each law may have to be traced first. Open, it follows the inputs.
import { colon, html, t, ask, link, settings, useAnswer, useState, Working } from './core.js';

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
    ${rows?.length > 0 && html`<${Strip} rows=${rows} summary=${data.summary} old=${Boolean(pending || error)} /><${List} card=${card} rows=${rows} values=${values} choose=${choose} old=${Boolean(pending || error)} />`}</details>`;
}

const apartText = (rows) => {
  const apart = [...new Set(rows.filter((row) => row.apart).map((row) => `${row.label} ${row.text}`))];
  return apart.length
    ? t('Apart from them: {names}.', { names: apart.join(settings.language === 'fr' ? ' ; ' : '; ') })
    : '';
};

/** Each law as a point along a line from the least to the greatest of those that agree; the others stand at its ends. */
function Strip({ rows, summary, old }) {
  const agreed = rows.filter((row) => !row.apart).map((row) => row.value);
  const [low, high] = [agreed[0], agreed.at(-1)];
  const place = (value) =>
    high > low ? 6 + 88 * Math.min(Math.max((value - low) / (high - low), -0.06), 1.06) : 50;
  return html`<div class=${old ? 'stale' : ''}><p data-summary class="strip-words">${summary.sentence}. ${apartText(rows)}</p>
    <div class="strip" role="img" aria-label=${summary.sentence}><span class="median" style=${{ left: `${place(summary.median)}%` }}></span>${rows.map(
      (row) =>
        html`<span class=${`dot${row.own ? ' own' : ''}${row.apart ? ' apart' : ''}${row.notices.length ? ' flagged' : ''}`} style=${{ left: `${place(row.value)}%` }} title=${`${row.label}${colon()} ${row.text}`}></span>`,
    )}</div></div>`;
}

function List({ card, rows, values, choose, old }) {
  const [shown, show] = useState(true);
  const name = (row) =>
    row.own
      ? html`<strong>${row.label}</strong>`
      : Object.keys(row.changed).length
        ? html`<button class="plain" onClick=${() => choose({ ...values, ...row.changed })}>${row.label}</button>`
        : html`<a href=${link('calculate', row.card, values)}>${row.label}</a>`;
  return html`<details class="small" open=${shown} onToggle=${(e) => show(e.target.open)}><summary>${t('The laws one by one')}</summary><div data-spread class=${old ? 'wide stale' : 'wide'}><table><tbody>${rows.map(
    (row) => html`<tr class=${row.own ? 'own' : ''}><td>${name(row)}</td><td class="dim">${row.group}</td>
      <td class="n">${row.text}</td><td class="caution" title=${row.notices.join(' ')}>${row.notices.length ? html`▲ <span class="small">${t('outside its range')}</span>` : ''}</td></tr>`,
  )}</tbody></table></div></details>`;
}
