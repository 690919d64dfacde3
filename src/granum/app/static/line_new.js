// A new line: its title, what enters it, of which substances.
import { html, t, ask, useState, useRef } from './core.js';
import { Describe } from './line_substances.js';
import { Choice, useSubstances } from './substance_choice.js';

const BEGINNINGS = [
  ['solution', 'A solution to crystallize'],
  ['suspension', 'A suspension'],
  ['moist_solid', 'A moist solid to dry'],
  ['broken_solid', 'A solid to crush and screen'],
  ['dusty_gas', 'A gas with dust'],
];

const PLACES = { solids: 'solid', liquids: 'liquid', gases: 'gas' };

export function NewLine({ make, cancel }) {
  const known = useSubstances();
  const [problem, setProblem] = useState(null);
  const [values, show] = useState({
    title: '',
    enters: 'solution',
    liquid: 'water',
    solute: 'potassium nitrate',
    solid: 'quartz',
    gas: 'dry air',
    own: '',
  });
  const latest = useRef(values); // Enter takes along what was typed just before it, not what was drawn last
  const setValues = (given) => {
    latest.current = { ...latest.current, ...given };
    show(latest.current);
    setProblem(null);
  };
  const set = (name) => (value) => setValues({ [name]: value });
  const asked = known?.beginnings[values.enters] || [];
  const rows = known && {
    liquid: known.liquids,
    solute: known.solutes.filter((s) => s.solvent === values.liquid && s.complete),
    solid: known.solids,
    gas: known.gases,
  };
  /** A substance of one's own goes to the place of its part, and its tables into the line. */
  const describe = async (given, told) => {
    try {
      const made = await ask('/api/case/build', { case: values.own, operation: 'describe_substance', arguments: given });
      const place = given.sort === 'solute' ? 'solute' : PLACES[given.part];
      setValues({ own: made.case, [place]: given.name });
      return true;
    } catch (problem) {
      told(problem);
      return false;
    }
  };
  const main = (now) => ({ solution: 'solute', suspension: 'solid', moist_solid: 'solid', broken_solid: 'solid', dusty_gas: 'solid' })[now.enters];
  const suggestion = (now) => {
    const name = now[main(now)];
    const chosen = rows?.[main(now)].find((s) => s.value === name)?.label || name || t('New line');
    return chosen[0].toUpperCase() + chosen.slice(1);
  };
  const labels = { liquid: t('liquid'), solute: t('dissolved in it'), solid: t('solid'), gas: t('gas') };
  return html`<form class="card new" data-new aria-label=${t('New line')} onSubmit=${(e) => {
    e.preventDefault();
    const now = latest.current;
    make({ ...now, title: now.title.trim() || suggestion(now) }, setProblem);
  }}><h2 class="first">${t('New line')}</h2>
    <label class="end" for="new-title"><span>${t('title')}</span><input id="new-title" type="text" value=${values.title} placeholder=${known ? suggestion(values) : ''} onInput=${(e) => set('title')(e.target.value)} /></label>
    <fieldset><legend>${t('What enters')}</legend>${BEGINNINGS.map(([name, label]) => html`<label class="choice line"><input type="radio" name="enters" value=${name} checked=${values.enters === name} onChange=${() => set('enters')(name)} /> ${t(label)}</label>`)}</fieldset>
    ${rows && asked.map((name) => html`<${Choice} key=${name} id=${'new-' + name} label=${labels[name]} rows=${rows[name]} value=${values[name]} pick=${set(name)} problem=${problem?.details?.name === name ? problem.message : (problem?.details?.beside?.[name] ?? '')} />`)}
    ${problem && !asked.includes(problem.details?.name) && html`<p class="message out" role="alert">${problem.message}</p>`}
    ${known && html`<${Describe} id="new-own" known=${known} solvent=${values.liquid} first=${values.enters === 'solution' ? 'solutes' : 'solids'} describe=${describe} />`}
    <p class="small dim">${t('Amounts, temperature and sizes start from ordinary values; change them afterwards.')}</p>
    <div class="row"><button class="button main" type="submit" disabled=${!known}>${t('Create the line')}</button><button class="button" type="button" onClick=${cancel}>${t('Close')}</button></div></form>`;
}
