// What a lab test gave, taken into a line: the data and conditions go into its case, so that the uncertainty stays known.
import { html, t, ask, colon, link, lastPlace, useState, useEffect } from './core.js';
import { caseAt, draftedPlaces, keepChange, packed } from './drafts.js';
import { pretty } from './line_forms.js';

/** The line that is open under Lines: its place and what its link carries. */
function openLine() {
  const [path, query = ''] = lastPlace('lines').replace(/^#\/?/, '').split('?');
  return {
    place: path.split('/').slice(1).map(decodeURIComponent).join('/'),
    carried: new URLSearchParams(query).get('case') || '',
  };
}
const shortly = (place) => place.slice(place.indexOf(':') + 1);

export function UseInLine({ data, values, table }) {
  const opened = openLine();
  const places = [...new Set([opened.place, ...draftedPlaces()])].filter((place) => place.includes(':'));
  const [place, setPlace] = useState(places[0] || '');
  const [units, setUnits] = useState(null);
  const [unit, setUnit] = useState('');
  const [told, setTold] = useState(null);
  const estimates = Object.keys(data.parameters);
  const caseOf = () => caseAt(place, place === opened.place ? opened.carried : '');
  useEffect(() => {
    if (!place) return undefined;
    let asked = true;
    setTold(null);
    setUnit('');
    caseOf()
      .then(({ text }) => ask('/api/case/form', { case: text }))
      .then(
        (form) => {
          if (!asked) return; // another line was chosen meanwhile
          const fit = Object.entries(form.units).filter(([, item]) =>
            item.parameters.some((p) => estimates.includes(p.name)),
          );
          setUnits(fit);
          setUnit(fit[0]?.[0] || '');
        },
        (problem) => asked && setTold({ problem: problem.message }),
      );
    return () => {
      asked = false;
    };
  }, [place, estimates.join(' ')]);
  const use = async () => {
    try {
      const { text } = await caseOf();
      const conditions = Object.fromEntries(
        Object.entries(values)
          .filter(([, value]) => value !== '' && value !== undefined)
          .map(([name, value]) => [name, value.startsWith('{') ? JSON.parse(value) : value]),
      );
      const given = {
        unit,
        test: data.card,
        data: table.endsWith('\n') ? table : table + '\n',
        conditions,
        estimates,
      };
      const found = await ask('/api/case/build', { case: text, operation: 'use_fit', arguments: given });
      keepChange(place, text, found.case);
      setTold({ place, link: link('lines', place, { case: await packed(found.case) }) });
    } catch (problem) {
      setTold({ problem: problem.message });
    }
  };
  return html`<section class="card screen" data-use aria-label=${t('Use in a line')}><h2 class="first">${t('Use in a line')}</h2>${
    places.length === 0
      ? html`<p class="small dim">${t('Open a line under Lines first: its equipment then takes what was fitted here.')}</p>`
      : html`<div class="ports"><label class="end"><span>${t('line')}</span><select id="use-line" value=${place} onChange=${(e) => setPlace(e.target.value)}>${places.map((one) => html`<option value=${one} selected=${one === place}>${shortly(one)}</option>`)}</select></label>
      ${units?.length > 0 && html`<label class="end"><span>${t('equipment')}</span><select id="use-unit" value=${unit} onChange=${(e) => setUnit(e.target.value)}>${units.map(([name, item]) => html`<option value=${name} selected=${name === unit}>${pretty(name)}${colon()} ${item.title}</option>`)}</select></label>`}</div>
      ${units?.length === 0 && html`<p class="small dim">${t('No equipment of {line} takes what this test gives.', { line: shortly(place) })}</p>`}
      <button class="button" disabled=${!unit} onClick=${use}>${t('Use in the line')}</button> <span class="small dim">${t('Data and conditions go into the line with it, and the uncertainty stays known.')}</span>
      ${told?.problem && html`<p class="message out" role="alert">${told.problem}</p>`}
      ${told?.link && html`<p class="ok" role="status">● ${t('Used in {line}.', { line: shortly(told.place) })} <a href=${told.link}>${t('Open the line')}</a></p>`}`
  }</section>`;
}
