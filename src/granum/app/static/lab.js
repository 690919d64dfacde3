// Lab data: drop a table, give the conditions, read parameters with intervals.
import { html, t, ask, link, useAnswer, useState, settings, replaceLink, useEffect, Plot } from './core.js';
import { Field, ordinary } from './form.js';
import { Finder, useCards } from './cards.js';

export function Lab({ state }) {
  const cards = useCards((c) => c.sort === 'lab test');
  const key = state.key || (cards?.some((c) => c.card === 'filtration.leaf_test') ? 'filtration.leaf_test' : cards?.[0]?.card);
  const { data: card } = useAnswer((signal) => (key ? ask(`/api/cards/${key}`, undefined, { signal }) : Promise.resolve(null)), [key, settings.language, settings.units], 0);
  return html`<main class="three" id="main"><${Finder} page="lab" current=${key} cards=${cards} />
    ${card && card.card === key ? html`<${Test} key=${key + settings.language + settings.units} card=${card} given=${state.values} />` : html`<section aria-busy="true"><p class="dim">${t('Loading…')}</p></section><section />`}</main>`;
}

function Test({ card, given }) {
  const columns = card.parameters.filter((p) => p.series);
  const conditions = { ...card, parameters: card.parameters.filter((p) => !p.series) };
  const example = columns.map((p) => `${p.name} [${p.units?.[0]?.unit || '1'}]`).join(',');
  const [values, setValues] = useState(Object.keys(given).length ? given : ordinary(conditions));
  const [table, setTable] = useState('');
  const [file, setFile] = useState(null);
  const [over, setOver] = useState(false);
  useEffect(() => replaceLink('lab', card.card, values), [values]);
  const answer = useAnswer(async (signal) => {
    const source = file || (table.trim() ? new File([table], 'data.csv', { type: 'text/csv' }) : null);
    if (!source) return null;
    const form = new FormData();
    form.append('file', source);
    form.append('conditions', JSON.stringify(values));
    return ask(`/api/fit/${card.card}`, form, { signal });
  }, [table, file, JSON.stringify(values)], 250);
  const take = (list) => { if (list?.length) { setFile(list[0]); setTable(''); } };
  return html`<section aria-label=${t('Enter')}><h1>${card.title}</h1><p class="dim">${card.summary}</p>
      <div class=${'drop' + (over ? ' over' : '')} onDragOver=${(e) => { e.preventDefault(); setOver(true); }} onDragLeave=${() => setOver(false)} onDrop=${(e) => { e.preventDefault(); setOver(false); take(e.dataTransfer.files); }}>
        <label>${t('Drop a CSV or Excel file here, or choose one:')} <input type="file" accept=".csv,.tsv,.txt,.xlsx" onChange=${(e) => take(e.target.files)} /></label>
        ${file && html`<p>${file.name} <button class="button" onClick=${() => setFile(null)}>${t('Remove')}</button></p>`}</div>
      <h2><label for="table">${t('or paste the table')}</label></h2>
      <textarea id="table" rows="9" placeholder=${example + '\n…'} value=${table} onInput=${(e) => { setTable(e.target.value); setFile(null); }}></textarea>
      <p class="small dim">${t('The first line names the columns with their units:')} <code>${example}</code></p>
      <h2>${t('Conditions')}</h2><form onSubmit=${(e) => e.preventDefault()}>${conditions.parameters.map((p) => html`<${Field} key=${p.name} parameter=${p} text=${values[p.name]} onChange=${(text) => setValues({ ...values, [p.name]: text })} problem=${answer.error?.details?.name === p.name ? answer.error.message : ''} />`)}</form></section>
    <section aria-label=${t('Believe')} aria-live="polite">${answer.error && html`<p class="message out">${answer.error.message}</p>`}
      ${!answer.data && !answer.error && html`<p class="dim">${t('Parameters with their 95 % intervals appear here.')}</p>`}
      <div class=${answer.pending || answer.error ? 'stale' : ''} aria-busy=${String(answer.pending)}>${answer.data && html`<${Fitted} data=${answer.data} />`}</div>
      <p class="small dim">${card.citation}</p></section>`;
}

function Fitted({ data }) {
  const save = () => {
    const { chart: _chart, ...rest } = data;
    const place = URL.createObjectURL(new Blob([JSON.stringify(rest, null, 1)], { type: 'application/json' }));
    Object.assign(document.createElement('a'), { href: place, download: `${data.card}.json` }).click();
    URL.revokeObjectURL(place);
  };
  return html`<div class="wide"><table><thead><tr><th scope="col">${t('parameter')}</th><th class="n" scope="col">${t('value')}</th><th class="n" scope="col">${t('standard error')}</th><th class="n" scope="col">${t('95 % interval')}</th><th scope="col">${t('unit')}</th></tr></thead>
    <tbody>${data.shown.map((row) => html`<tr data-parameter=${row.name} class=${row.derived ? 'dim' : ''}><td>${row.label}</td><td class="n">${row.derived ? row.value : html`<strong>${row.value}</strong>`}</td><td class="n">${row.error}</td><td class="n">${row.interval}</td><td>${row.unit}</td></tr>`)}</tbody></table></div>
    ${data.flags.map((flag) => html`<p class="message caution">${flag.message || flag}</p>`)}
    ${data.chart && html`<${Plot} figure=${data.chart} label=${t('Data and fit')} />`}
    <p class="small dim">${data.statistics_shown}</p>
    <button class="button" onClick=${save}>${t('Download the result')}</button>`;
}
