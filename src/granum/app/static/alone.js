// A piece of equipment alone: its parameters and what enters, solved as a line of its own; handed to Lines when wanted.
import {
  Awaited,
  colon,
  html,
  t,
  ask,
  link,
  useAnswer,
  useCopying,
  useState,
  useEffect,
  useRef,
  replaceLink,
  settings,
  Working,
} from './core.js';
import { Chapter } from './chapter.js';
import { CALCULATED, Calculate, Seek, seekable, useSeek } from './calculate.js';
import { Finder, useCards } from './cards.js';
import { Field } from './form.js';
import { keepDraft, packed } from './drafts.js';
import { Advice } from './line_outcome.js';
import { StreamTable } from './line_streams.js';
import { Plot } from './plot.js';
import { Sensitivity } from './sensitivity.js';
import { Utilities } from './utilities.js';

const SHOWN = (c) => CALCULATED(c) || c.sort === 'equipment';

/** Calculate, with the equipment among its cards. */
export function Desk({ state }) {
  const cards = useCards(SHOWN);
  const card = cards?.find((c) => c.card === state.key);
  if (card?.sort !== 'equipment' && (cards || !state.key))
    return html`<${Calculate} key="calculate" state=${state} keep=${SHOWN} />`;
  return html`<main class="three alone" id="main"><${Finder} page="calculate" current=${state.key} cards=${cards} />
    ${card ? html`<${Work} key=${`${state.key} ${settings.language} ${settings.units} ${state.visit}`} card=${card} given=${state.values} />` : html`<section aria-label=${t('Enter')}><${Awaited} text=${t('The list of cards is on its way…')} /></section><section />`}</main>`;
}

function Work({ card, given }) {
  const [values, setValues] = useState(given);
  const [past, setPast] = useState([]);
  const edited = useRef('');
  const [drawn, setDrawn] = useState({});
  const [copied, copy] = useCopying();
  const words = JSON.stringify(values);
  useEffect(() => replaceLink('calculate', card.card, values, true), [words]);
  const form = useAnswer(
    (signal) => ask(`/api/alone/${card.card}`, values, { signal }),
    [words],
    past.length ? 250 : 0,
  );
  const text = form.data?.case;
  const answer = useAnswer(
    (signal) => (text ? ask('/api/run', { case: text, place: '' }, { signal }) : Promise.resolve(null)),
    [text],
    0,
  );
  const set = (name, value, understood) => {
    // what is typed in one field in one go is one step back; that it was understood is none
    if (!understood) {
      if (edited.current !== name) setPast([...past.slice(-50), values]);
      edited.current = name;
    }
    setValues((before) => ({ ...before, [name]: value }));
  };
  const results = form.data?.outputs.filter((p) => p.kind && !p.series) ?? [];
  const { sought, solved, finder, change, stop } = useSeek({
    card,
    values,
    put: set,
    start: (p) => {
      const output = form.data.duty?.setting === p.name ? form.data.duty.figure : results[0].name;
      return { name: p.name, output, text: '' };
    },
    seekable: (p) => results.length > 0 && seekable(p) && !p.name.includes('.'),
  });
  const busy = form.pending || answer.pending;
  const problem = !busy && (form.error || answer.error); // what was refused is not what is looked at now
  const inside = useInside(text, busy || Boolean(problem));
  const wrong = problem?.details?.name;
  const isWrong = (p) => Boolean(wrong) && (wrong === p.name || p.name.endsWith(`.${wrong}`));
  const field = (p) =>
    html`<${Field} key=${p.name} id=${`field-${p.name.replaceAll(' ', '-')}`} parameter=${p} text=${values[p.name] ?? form.data.values[p.name]} onChange=${(value, understood) => set(p.name, value, understood)} aside=${finder(p)} problem=${isWrong(p) ? problem.message : ''} />`;
  const folded = useRef(null); // a field does not move while it is filled
  if (form.data && !folded.current)
    folded.current = form.data.parameters
      .filter((p) => !p.required && form.data.values[p.name] === undefined)
      .map((p) => p.name);
  const more = form.data?.parameters.filter((p) => folded.current.includes(p.name));
  const needed = form.data?.parameters.filter((p) => !more.includes(p));
  const spot = wrong && [...(form.data?.parameters ?? []), ...(form.data?.groups ?? []).flatMap((g) => g.parameters)].find(isWrong);
  /** The machine as a line of its own, handed to another page. */
  const handTo = (page) => async (e) => {
    e.preventDefault();
    if (!text) return;
    const { case: now } = form.pending ? await ask(`/api/alone/${card.card}`, values) : form.data;
    const place = `computer:${card.card.split('.')[1]}.toml`;
    keepDraft(place, now);
    location.hash = link(page, place, { case: await packed(now) });
  };
  return html`<section aria-label=${t('Enter')} aria-busy=${String(!form.data && !form.error)}><h1>${card.title}</h1><p class="dim">${card.summary} <${Chapter} card=${card.card} /></p>
      ${form.data?.no_size && html`<p class="small dim">${form.data.no_size}</p>`}
      ${
        form.data &&
        html`<form onSubmit=${(e) => e.preventDefault()} onfocusout=${() => {
          edited.current = '';
        }}>${needed.map(field)}
        ${more.length > 0 && html`<details class="more"><summary>${t('More ({count})', { count: more.length })}</summary>${more.map(field)}</details>`}
        ${form.data.groups.map((group, i) => html`<details class="inlet" key=${group.name} open=${i === 0} data-inlet=${group.name}><summary>${group.title}</summary>${group.parameters.map(field)}</details>`)}</form>
        ${form.data.without.length > 0 && html`<p class="small dim">${t('Without: {names}. In a line these inlets can be used too.', { names: form.data.without.join(', ') })}</p>`}`
      }
      <div class="row"><button class="button" disabled=${!past.length} onClick=${() => {
        edited.current = '';
        setValues(past.at(-1));
        setPast(past.slice(0, -1));
      }}>${t('Undo')}</button>
      <button class="button" onClick=${() => {
        edited.current = '';
        setPast([...past.slice(-50), values]);
        setValues({});
      }}>${t('Example values')}</button>
      <button class="button" onClick=${copy}>${t('Copy link')}</button>
      <a class="button" href=${link('studies')} onClick=${handTo('studies')} aria-disabled=${String(!text)}>${t('Study')}</a>
      <a class="button" href=${link('lines')} onClick=${handTo('lines')} aria-disabled=${String(!text)}>${t('Put it in a line')}</a> <span role="status" class="small dim">${copied}</span></div></section>
    <section aria-label=${t('Believe')}>
      ${sought && html`<${Seek} results=${results} sought=${sought} change=${change} stop=${stop} solved=${solved} label=${form.data.parameters.find((p) => p.name === sought.name).label} />`}
      <div aria-live="polite">${problem && html`<p class=${spot ? 'message out told' : 'message out'}>${spot ? t('Nothing is calculated before this is mended: {name}', { name: spot.label }) : problem.message}</p>`}</div>
      <${Working} busy=${busy} cancel=${answer.cancel} job=${answer.job} />
      <div class=${busy || problem ? 'stale' : ''} aria-busy=${String(busy && !problem)}>${answer.data && html`<${Outcome} data=${answer.data} form=${form.data} text=${text}><${Inside} inside=${inside} card=${card} /><${Sensitivity} card=${card} values=${values} case=${text} old=${busy || Boolean(problem)} wait=${inside.pending} choice=${drawn} setChoice=${setDrawn} /></${Outcome}>`}</div></section>`;
}

/** Streams by the ports of the one machine. */
const ports = (rows, labels = {}) =>
  Object.fromEntries(
    rows.map(([name]) => {
      const port = name.split('.').at(-1);
      return [name, labels[port] || port.replaceAll('_', ' ')];
    }),
  );

/** What there is to look at: asked for once the figures stand, so that they never wait for it. */
const useInside = (text, old) =>
  useAnswer(
    (signal) => (text && !old ? ask('/api/inside', { case: text, place: '' }, { signal }) : Promise.resolve(null)),
    [text, old],
    20,
  );

function Inside({ card, inside: { data, error, pending, cancel, job } }) {
  const seen = useRef(null); // the charts before stay, in gray, until others come
  if (data) seen.current = data;
  if (error) return html`<p class="small dim">${error.message}</p>`;
  if (!seen.current) return html`<${Working} busy=${pending} cancel=${cancel} job=${job} />`;
  return seen.current?.charts.map(
    (c) => html`<section class=${pending ? 'stale' : ''} data-inside=${c.heading} aria-label=${c.heading}><h2>${c.heading}</h2><${Plot} figure=${c.figure} label=${c.heading} name=${`${card.card}-${c.heading}`} /></section>`,
  );
}

function Outcome({ data, form, text, children }) {
  const [unit] = Object.values(data.units);
  const failed = unit.checks.filter((c) => !c.ok);
  return html`<div class="wide" tabindex="0" role="region" aria-label=${t('Results')}><table class="answers"><tbody>${Object.entries(unit.results).map(([name, row]) => html`<tr><td>${row.label || name.replaceAll('_', ' ')}</td><td class="n" data-figure=${name}><strong>${row.text}</strong></td></tr>`)}</tbody></table></div>
    <div class=${failed.length || data.flags.length ? 'caution' : 'ok'} data-belief=${failed.length || data.flags.length ? 'caution' : 'ok'}>${data.flags.map((f) => html`<p class="mark">▲ ${f.message}</p>`)}${failed.map((c) => html`<p class="mark">▲ ${c.name}${colon()} ${c.text} (${c.allowed})</p>`)}
      ${Object.entries(data.advice ?? {}).map(([name, one]) => html`<${Advice} key=${name} name=${name} advice=${one} />`)}
      ${!failed.length && !data.flags.length && html`<p class="mark">● ${t('within its practical limits')}</p>`}</div>
    ${unit.checks.length > 0 && html`<details open><summary>${t('Practical limits')}</summary><div class="wide small limits"><table><tbody>${unit.checks.map((c) => html`<tr class=${c.ok ? '' : 'out'}><td>${c.ok ? '✓' : '✗'} ${c.name}</td><td class="n">${c.text}</td><td class="dim allowed">${c.allowed}</td></tr>`)}</tbody></table></div></details>`}
    ${children}
    <${StreamTable} turned table=${data.stream_table} text=${text} labels=${ports(data.stream_table.rows, form?.ports)} />
    <${Utilities} table=${data.utility_table} />
    <p class="small dim">${data.audit.text}</p>
    ${
      form &&
      html`<h2>${t('Source')}</h2><p class="small">${form.citation}</p>
    <details><summary>${t('The same in Python')}</summary><pre>${form.python}</pre></details>
    <details><summary>${t('The same on the command line')}</summary><pre>${form.command}</pre></details>
    <details><summary>${t('About')}</summary><pre lang="en">${form.doc}</pre></details>`
    }`;
}
