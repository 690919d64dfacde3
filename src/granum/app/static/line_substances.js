// What a line is made of: each phase as a list, substances of the library or described by their constants.
import { html, t, useState, useEffect } from './core.js';
import { Field } from './form.js';
import { readable } from './quantity.js';
import { Choice, useSubstances, named } from './substance_choice.js';

const PHASES = [
  ['liquids', 'Liquids: solvent first, then what is dissolved in it'],
  ['solids', 'Solids'],
  ['gases', 'Gases and vapors'],
];
const SORTS = { liquids: 'fluid', solids: 'solid', gases: 'fluid', solutes: 'solute' };

export function Substances({ form, build }) {
  const known = useSubstances();
  const [about, setAbout] = useState('');
  const called = (name) => form.labels[name] || named(known, name);
  const [refused, setRefused] = useState({});
  const choose = (phase, names, told) => build('choose_substances', { ...form.substances, [phase]: names }, told);
  const add = async (phase, name) => {
    setRefused({});
    if (name && !form.substances[phase].includes(name))
      await choose(phase, [...form.substances[phase], name], (problem) => setRefused({ phase, name, message: problem.message }));
  };
  const all = [...new Set(PHASES.flatMap(([phase]) => form.substances[phase]))];
  return html`<details data-substances><summary>${t('Substances')} <span class="dim">${all.map(called).join(', ')}</span></summary>
    ${PHASES.map(([phase, label]) => {
      const names = form.substances[phase];
      return html`<div class="substances" key=${phase}><p class="small dim">${t(label)}</p><div class="row">${names.map(
        (name) =>
          html`<span class="chip">${called(name)} <button aria-label=${t('Remove {name}', { name: called(name) })} onClick=${() =>
            choose(
              phase,
              names.filter((other) => other !== name),
            )}>×</button></span>`,
      )}
        <${Choice} id=${'add-' + phase} label=${t('Add')} quiet rows=${offered(known, form, phase)} value=${refused.phase === phase ? refused.name : ''} pick=${(name) => add(phase, name)} problem=${refused.phase === phase ? refused.message : ''} /></div></div>`;
    })}
    ${known && html`<${Describe} id="own" known=${known} solvent=${form.substances.liquids[0] || 'water'} describe=${(given, told) => build('describe_substance', given, told)} />`}
    ${form.own.map((one) => html`<details key=${one.sort + one.name} data-own=${one.name} open=${about === one.name} onToggle=${(e) => e.target.open && setAbout(one.name)}><summary>${one.name} <span class="dim">${t(one.sort)}</span></summary><${Described} one=${one} build=${build} /></details>`)}
    ${form.classes && html`<${SizeClasses} classes=${form.classes} build=${build} />`}</details>`;
}

/** The size classes that all streams of the line share. */
function SizeClasses({ classes, build }) {
  const [typed, setTyped] = useState({});
  const [problem, setProblem] = useState(null);
  const values = { ...classes.values, ...typed };
  const keep = async () => {
    setProblem(null);
    const given = Object.fromEntries(classes.rows.map((row) => [row.name, values[row.name] || '']));
    if (await build('set_size_classes', given, setProblem)) setTyped({});
  };
  const { smallest, largest } = classes.values;
  return html`<details data-classes><summary>${t('Size classes')} <span class="dim">${smallest ? `${readable(smallest, classes.rows[0])} … ${readable(largest, classes.rows[1])}` : ''}</span></summary>
    ${classes.own && html`<p class="small dim">${t('The case file lists boundaries of its own; what is given here takes their place.')}</p>`}
    <${Constants} id="classes" rows=${classes.rows} values=${values} set=${(key, text) => setTyped((before) => ({ ...before, [key]: text }))} problem=${problem} />
    ${problem && !classes.rows.some((row) => row.name === problem.details?.name) && html`<p class="message out" role="alert">${problem.message}</p>`}
    <div class="row"><button class="button" type="button" disabled=${!Object.keys(typed).length} onClick=${keep}>${t('Use these values')}</button></div></details>`;
}

function offered(known, form, phase) {
  if (!known) return [];
  const own = form.own
    .filter((one) => (phase === 'solids' ? one.sort === 'solid' : one.sort === 'fluid' || phase === 'liquids' && one.sort === 'solute'))
    .map((one) => ({ value: one.name, label: one.name }));
  const library =
    phase === 'liquids'
      ? [...known.liquids, ...known.solutes.filter((s) => s.solvent === form.substances.liquids[0])]
      : known[phase];
  return [...own, ...library];
}

/** Constants of a substance that the case describes, to be changed or taken out. */
function Described({ one, build }) {
  const [typed, setTyped] = useState({});
  const [problem, setProblem] = useState(null);
  const values = { ...one.values, ...typed };
  const id = `own-${one.sort}-${one.name}`.replaceAll(' ', '_');
  const keep = async () => {
    setProblem(null);
    const { sort, name } = one;
    if (await build('describe_substance', { sort, name, values }, setProblem)) setTyped({});
  };
  return html`<${Constants} id=${id} rows=${one.rows} values=${values} set=${(key, text) => setTyped((before) => ({ ...before, [key]: text }))} problem=${problem} />
    ${one.formulas.length > 0 && html`<p class="small dim">${t('By a formula in the case file: {names}.', { names: one.formulas.join(', ') })}</p>`}
    ${problem && !one.rows.some((row) => row.name === problem.details?.name) && html`<p class="message out" role="alert">${problem.message}</p>`}
    <div class="row"><button class="button" type="button" disabled=${!Object.keys(typed).length} onClick=${keep}>${t('Use these values')}</button>
    <button class="button" type="button" onClick=${() => build('forget_substance', { sort: one.sort, name: one.name }, setProblem)}>${t('Delete')}</button></div>`;
}

const Constants = ({ id, rows, values, set, problem }) =>
  html`<div class="fields">${rows.map((row) => html`<${Field} key=${row.name} parameter=${row} id=${`${id}-${row.name}`} text=${values[row.name] || ''} onChange=${(text) => set(row.name, text)} problem=${problem?.details?.name === row.name ? problem.message : ''} />`)}</div>`;

/** A substance of one's own by its constants, as the part that it plays in the line. */
export function Describe({ id, known, solvent, first = 'solids', describe }) {
  const [open, setOpen] = useState(false);
  const [part, setPart] = useState(first);
  const [name, setName] = useState('');
  const [values, setValues] = useState({});
  const [problem, setProblem] = useState(null);
  useEffect(() => {
    if (!name && !Object.keys(values).length) setPart(first); // what was begun here stays as it is
  }, [first]);
  const parts = [
    ['solids', t('a solid')],
    ['liquids', t('a liquid')],
    ['solutes', t('dissolved in {solvent}, crystallizing', { solvent: named(known, solvent) })],
    ['gases', t('a gas or vapor')],
  ];
  const rows = known.own.rows[part].filter((row) => row.required || !['liquids', 'gases'].includes(part));
  const ready = name.trim() && rows.every((row) => !row.required || values[row.name]?.trim());
  const keep = async () => {
    setProblem(null);
    const asked = rows.map((row) => row.name).concat(part === 'solutes' ? ['like'] : []);
    const made = await describe(
      {
        sort: SORTS[part],
        name: name.trim(),
        part: part === 'solutes' ? 'liquids' : part,
        solvent,
        values: Object.fromEntries(asked.filter((key) => values[key]?.trim()).map((key) => [key, values[key]])),
      },
      setProblem,
    );
    if (!made) return;
    setOpen(false);
    setName('');
    setValues({});
  };
  const set = (key, text) => setValues((before) => ({ ...before, [key]: text }));
  return html`<details class="describe" data-describe open=${open} onToggle=${(e) => setOpen(e.target.open)}><summary>${t('Describe a substance of my own')}</summary>
    <div class="field"><label for=${id + '-name'}>${t('Name')}</label><input id=${id + '-name'} type="text" value=${name} onInput=${(e) => setName(e.target.value)} onKeyDown=${(e) => e.key === 'Enter' && e.preventDefault()} /></div>
    <label class="end" for=${id + '-part'}><span>${t('it is')}</span><select id=${id + '-part'} value=${part} onChange=${(e) => setPart(e.target.value)}>${parts.map(([one, label]) => html`<option value=${one} selected=${one === part}>${label}</option>`)}</select></label>
    <${Constants} id=${`${id}-${part}`} rows=${rows} values=${values} set=${set} problem=${problem} />
    ${part === 'solutes' && solvent === 'water' && html`<label class="end" for=${id + '-like'}><span>${t('density and viscosity of its solutions as those of')}</span><select id=${id + '-like'} value=${values.like || ''} onChange=${(e) => set('like', e.target.value)}><option value="">${t('nothing: equipment that needs the viscosity will say so')}</option>${known.own.alike.map((row) => html`<option value=${row.value} selected=${row.value === values.like}>${row.label}</option>`)}</select></label>`}
    ${problem && !rows.some((row) => row.name === problem.details?.name) && html`<p class="message out" role="alert">${problem.message}</p>`}
    <div class="row"><button class="button main" type="button" disabled=${!ready} onClick=${keep}>${t('Use this substance')}</button></div></details>`;
}
