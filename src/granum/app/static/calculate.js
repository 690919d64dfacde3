// Calculate: find a card, enter values, believe the result. Up to three cases side by side.
import { html, t, ask, useAnswer, useState, useEffect, replaceLink, settings, Plot } from './core.js';
import { Field, ordinary } from './form.js';
import { Finder, useCards } from './cards.js';

const FIRST = 'particles.terminal_velocity';

export function Calculate({ state, page = 'calculate', sorts = ['formula', 'procedure'], first = FIRST }) {
  const cards = useCards(sorts);
  const key = state.key || (cards?.some((c) => c.card === first) ? first : cards?.[0]?.card);
  const { data: card, error } = useAnswer((signal) => (key ? ask(`/api/cards/${key}`, undefined, { signal }) : Promise.resolve(null)), [key, settings.language], 0);
  return html`<main class="three" id="main"><${Finder} page=${page} current=${key} cards=${cards} />
    ${error ? html`<section><p class="message out">${error.message}</p></section><section />` : card && card.card === key ? html`<${Work} key=${key + settings.language} page=${page} card=${card} given=${state.values} />` : html`<section aria-busy="true"><p class="dim">${t('Loading…')}</p></section><section />`}</main>`;
}

function Work({ page, card, given }) {
  const names = new Set(card.parameters.map((p) => p.name));
  const start = Object.fromEntries(Object.entries(given).filter(([name]) => names.has(name)));
  const [values, setValues] = useState(Object.keys(start).length ? start : ordinary(card));
  const [past, setPast] = useState([]);
  const [kept, setKept] = useState([]);
  useEffect(() => replaceLink(page, card.card, values), [values]);
  const kind = card.sort === 'chart' ? 'chart' : 'calc';
  const answer = useAnswer((signal) => ask(`/api/${kind}/${card.card}`, values, { signal }), [JSON.stringify(values)]);
  const change = (name) => (text) => { setPast([...past.slice(-50), values]); setValues({ ...values, [name]: text }); };
  const wrong = answer.error?.details?.name;
  return html`<section aria-label=${t('Enter')}><h1>${card.title}</h1><p class="dim">${card.summary}</p>
      <form onSubmit=${(e) => e.preventDefault()}>${card.parameters.map((p) => html`<${Field} key=${p.name} parameter=${p} text=${values[p.name]} onChange=${change(p.name)} problem=${wrong === p.name ? answer.error.message : ''} />`)}</form>
      <p class="row"><button class="button" disabled=${!past.length} onClick=${() => { setValues(past.at(-1)); setPast(past.slice(0, -1)); }}>${t('Undo')}</button>
      <button class="button" onClick=${() => { setPast([...past, values]); setValues(ordinary(card)); }}>${t('Example values')}</button>
      <button class="button" onClick=${() => navigator.clipboard?.writeText(location.href)}>${t('Copy link')}</button>
      ${kind === 'calc' && html`<button class="button" disabled=${kept.length >= 2 || !answer.data} onClick=${() => setKept([...kept, { values, data: answer.data }])}>${t('Keep to compare')}</button>`}</p></section>
    <section aria-label=${t('Believe')} aria-live="polite">
      ${answer.error && html`<p class="message out">${answer.error.message}</p>`}
      <div class=${answer.pending || answer.error ? 'stale' : ''}>
      ${answer.data && (kind === 'chart' ? html`<${Plot} figure=${answer.data} label=${card.title} />` : html`<${Result} card=${card} data=${answer.data} kept=${kept} clear=${() => setKept([])} />`)}</div>
      ${kind === 'chart' && html`<p class="small dim">${card.citation}</p>`}</section>`;
}

function Result({ card, data, kept, clear }) {
  const bad = data.flags.length > 0;
  return html`${data.shown.map((row) => html`<div class="answer"><div class="dim">${row.label} <span dangerouslySetInnerHTML=${{ __html: row.symbol }} /></div><div class=${data.shown.length > 3 ? '' : 'value'} data-output=${row.name}><${Value} row=${row} raw=${data.outputs[row.name].value} /></div></div>`)}
    <p class=${bad ? 'caution' : 'ok'}>${bad ? '▲ ' : '● '}${bad ? data.flags.map((f) => html`<div>${f.message}</div>`) : t('inside the range the source covers')}</p>
    ${kept.length > 0 && html`<h2>${t('Comparison')}</h2><div class="wide"><table><thead><tr><th></th>${[...kept, { data }].map((_, i) => html`<th class="n">${t('case {number}', { number: i + 1 })}</th>`)}</tr></thead>
      <tbody>${data.inputs_shown.map((row, i) => html`<tr class="dim"><td>${row.label}</td>${[...kept.map((k) => k.data), data].map((d) => html`<td class="n">${d.inputs_shown[i]?.text}</td>`)}</tr>`)}
      ${data.shown.map((row, i) => html`<tr><td><strong>${row.label}</strong></td>${[...kept.map((k) => k.data), data].map((d) => html`<td class="n"><strong>${d.shown[i].text}</strong></td>`)}</tr>`)}</tbody></table></div>
      <button class="button" onClick=${clear}>${t('Clear')}</button>`}
    ${data.equation && html`<h2>${t('Equation')}</h2><div class="equation" dangerouslySetInnerHTML=${{ __html: data.equation }} />`}
    <p class="small dim">${t('with')} ${data.inputs_shown.map((row, i) => html`${i > 0 ? '; ' : ''}<span dangerouslySetInnerHTML=${{ __html: row.symbol }} /> = ${row.text}`)}</p>
    <h2>${t('Source')}</h2><p class="small">${data.citation}</p>
    <details open><summary>Python</summary><pre>${data.python}</pre></details>
    <details><summary>${t('Command line')}</summary><pre>${data.command}</pre></details>
    <details><summary>${t('About')}</summary><pre>${card.doc}</pre></details>`;
}

function Value({ row, raw }) {
  if (raw && typeof raw === 'object') return html`<${Data} value=${raw} />`;
  return row.text;
}

/** Lists and tables that a procedure returns. */
function Data({ value }) {
  if (Array.isArray(value) && value.length && typeof value[0] === 'object' && !Array.isArray(value[0])) {
    const heads = Object.keys(value[0]);
    return html`<div class="wide small"><table><thead><tr>${heads.map((head) => html`<th>${t(head.replaceAll('_', ' '))}</th>`)}</tr></thead><tbody>${value.map((row) => html`<tr>${heads.map((head) => html`<td><${Data} value=${row[head]} /></td>`)}</tr>`)}</tbody></table></div>`;
  }
  if (Array.isArray(value)) return html`<ul class="small">${value.map((item) => html`<li><${Data} value=${item} /></li>`)}</ul>`;
  if (value && typeof value === 'object') return html`<dl class="small">${Object.entries(value).map(([name, item]) => html`<dt class="dim">${t(name.replaceAll('_', ' '))}</dt><dd><${Data} value=${item} /></dd>`)}</dl>`;
  return html`${value === null || value === undefined ? '—' : typeof value === 'number' ? Number(value.toPrecision(5)) : String(value)}`;
}
