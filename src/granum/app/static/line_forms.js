// Forms of a line: its feeds and equipment.
import { html, t, useState, useEffect } from './core.js';
import { asTable, Field, holds } from './form.js';

/** What an end is called; a mixer takes any number of streams: it is one place, whatever its inlet is called. */
const placed = (ends, end) =>
  [end, end.split('.')[0]].map((one) => ends.find((known) => known.value === one)?.label).find(Boolean) || pretty(end);

/** The field of a line that a refusal is about, and the parameter in it where it holds a law; null where it is about none. */
export function fieldOf(form, problem) {
  const { unit, name, option } = problem?.details || {};
  const item = form?.units[unit] || form?.feeds[unit];
  const row =
    item?.parameters.find((p) => p.name === name) || item?.parameters.find((p) => holds(asTable(item.values[p.name]), name));
  return row ? { unit, name: row.name, option: option || (row.name === name ? '' : name), message: problem.message } : null;
}

/** Feeds and equipment, each a closed form that opens when asked, or is about the unit at fault. */
export function Forms({ form, typedIn, build, refused, fault }) {
  const open = (name) => (refused?.unit || fault) === name;
  const wrong = (name) => (refused?.unit === name ? refused : null);
  return html`${group(t('Feeds'), form.feeds, (name, item) => html`<details key=${'feeds' + name} open=${open(name)} data-form=${name}><summary><strong>${pretty(name)}</strong> <span class="dim">${item.to ? `→ ${placed(form.ends.targets, item.to)}` : t('goes nowhere yet')}</span></summary><${FeedForm} name=${name} item=${item} form=${form} typedIn=${typedIn} build=${build} wrong=${wrong(name)} /></details>`)}
    ${group(t('Equipment'), form.units, (name, item) => html`<details key=${'units' + name} open=${open(name)} data-form=${name}><summary><strong>${pretty(name)}</strong> <span class="dim">${item.title || item.model}</span></summary><${ItemForm} table="units" name=${name} item=${item} typedIn=${typedIn} wrong=${wrong(name)} /></details>`)}`;
}
// what the line on the screen calls its units and streams, in the language of the page
let names = {};
export const learn = (found) => {
  names = found;
};
export const pretty = (name) => names[name] || name.replaceAll('_', ' ').replace('.', ' · ');
const group = (label, items, make) =>
  Object.keys(items).length > 0 &&
  html`<h2>${label}</h2>${Object.entries(items).map(([name, item]) => make(name, item))}`;

/** The form of one unit or feed. */
export function ItemForm({ table, name, item, typedIn, wrong, spot = 'form' }) {
  const [typed, setTyped] = useState({});
  useEffect(
    () =>
      setTyped((before) =>
        Object.fromEntries(Object.entries(before).filter(([key]) => typedIn.keeps(table, name, key))),
      ),
    [JSON.stringify(item.values)],
  );
  const set = (key, value, understood) => {
    if (understood && !typedIn.waits(table, name, key)) return; // it stands in the case already, as it was typed
    setTyped((before) => ({ ...before, [key]: value }));
    typedIn.later(table, name, key, value);
  };
  // what may stay empty is folded, as on Calculate; a field does not move while it is filled
  const [folded] = useState(
    () => new Set(item.parameters.filter((p) => !p.required && item.values[p.name] === undefined).map((p) => p.name)),
  );
  const [open, setOpen] = useState(false);
  if (!item.parameters.length) return html`<p class="small dim">${item.summary || t('No parameters.')}</p>`;
  const field = (p) =>
    html`<${Field} key=${p.name} parameter=${p} id=${`field-${spot}-${name}-${p.name}`.replaceAll(' ', '_')} text=${typed[p.name] ?? item.values[p.name]} onChange=${(value, understood) => set(p.name, value, understood)} problem=${wrong?.name === p.name ? wrong.message : ''} option=${wrong?.name === p.name ? wrong.option : ''} />`;
  const [shown, more] = table === 'feeds' ? [item.parameters, []] : [false, true].map((away) => item.parameters.filter((p) => folded.has(p.name) === away));
  return html`<form onSubmit=${(e) => e.preventDefault()}>${shown.map(field)}
    ${more.length > 0 && html`<details class="more" open=${open || more.some((p) => p.name === wrong?.name)} onToggle=${(e) => setOpen(e.target.open)}><summary>${t('More ({count})', { count: more.length })}</summary>${more.map(field)}</details>`}
    ${item.limits?.length > 0 && html`<details data-limits=${name}><summary>${t('Practical limits')}</summary><div class="wide small"><table><tbody>${item.limits.map((limit) => html`<tr><td>${limit.name}</td><td>${limit.allowed}</td><td class="dim">${limit.source}</td></tr>`)}</tbody></table></div></details>`}</form>`;
}

/** A feed: where it goes, in which form it is given, its flows, shares and sizes. */
export function FeedForm({ name, item, form, typedIn, build, wrong, spot = 'form' }) {
  return html`<div class="ports"><${EndMenu} id=${`to-${spot}-${name}`} label=${t('goes to')} value=${item.to} ends=${form.ends.targets} none=${t('nowhere yet')} pick=${(end) => (end ? build('connect', { origin: name, target: end }) : build('disconnect', { end: name }))} />
    ${form.substances.solids.length > 0 && form.substances.liquids.length > 0 && html`<label class="end"><span>${t('given as')}</span><select id=${`given-${spot}-${name}`} value=${item.form} onChange=${(e) => build('form_of_feed', { feed: name, form: e.target.value })}><option value="phases" selected=${item.form === 'phases'}>${t('flows of solid and liquid')}</option><option value="totals" selected=${item.form === 'totals'}>${t('whole flow and share of solids')}</option></select></label>`}</div>
    <${ItemForm} table="feeds" name=${name} item=${item} typedIn=${typedIn} wrong=${wrong} spot=${spot} />
    ${item.rests?.map((rest) => html`<p class="small dim">${rest}</p>`)}`;
}

/** A menu of the places where a stream may come from or go to; what is taken already says so. */
export function EndMenu({ id, label, value: end, ends, none, pick, own = '' }) {
  // a mixer takes any number of streams: it is one place, whatever its inlet is called
  const value = !end || ends.some((one) => one.value === end) ? end : end.split('.')[0];
  const free = ends.filter((end) => !end.taken || end.value === value);
  const taken = ends.filter((end) => end.taken && end.value !== value && end.value.split('.')[0] !== own);
  const option = (end) =>
    html`<option value=${end.value} selected=${end.value === value}>${end.label}</option>`;
  return html`<label class="end" for=${id}><span>${label}</span><select id=${id} value=${value} onChange=${(e) => pick(e.target.value)}><option value="" selected=${!value}>${none}</option>
    ${free.filter((end) => end.value.split('.')[0] !== own || end.value === value).map(option)}
    ${taken.length > 0 && html`<optgroup label=${t('in use: a divider or mixer is put in')}>${taken.map(option)}</optgroup>`}</select></label>`;
}
