// An exam: exercises drawn from a number, the same for all who type it; no hints and no marks before it is handed in, and a clock if wanted.
import {
  html,
  t,
  ask,
  link,
  download,
  useAnswer,
  useEffect,
  useKept,
  useRef,
  useState,
  settings,
  Working,
} from './core.js';
import { Quantity } from './quantity.js';
import { Choices } from './exercise_step.js';
import { Indexed } from './indices.js';
import { note } from './progress.js';

const MOST = 12;
const whole = (text, most) => (/^\d{1,6}$/.test(text || '') && Number(text) <= most ? Number(text) : null);

/** Numbers between 0 and 1 that follow from a seed (mulberry32). */
function* chances(seed) {
  for (let state = seed >>> 0; ;) {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    yield ((mixed ^ (mixed >>> 14)) >>> 0) / 4294967296;
  }
}

/** Which exercises an exam holds. */
export function drawnExercises(exercises, seed, count) {
  const chance = chances(seed);
  return exercises
    .map((one) => ({ one, order: chance.next().value }))
    .sort((a, b) => a.order - b.order)
    .slice(0, count)
    .map(({ one }) => one);
}

export function Exam({ domains, values }) {
  const seed = whole(values.seed, 999999);
  const count = Math.max(1, whole(values.count, MOST) ?? 4);
  const minutes = whole(values.minutes, 600);
  const domain = domains.find((d) => d.name === values.domain);
  const offered = (domain ? [domain] : domains).flatMap((d) => d.exercises.filter((e) => e.fresh));
  if (seed === null) return html`<${Setting} domains=${domains} />`;
  const held = drawnExercises(offered, seed, count);
  const name = `exam ${seed} ${held.map((e) => e.id).join(' ')}`;
  return html`<${Sitting} key=${name} name=${name} seed=${seed} held=${held} minutes=${minutes} />`;
}

function Setting({ domains }) {
  const [asked, setAsked] = useState({
    count: '4',
    domain: '',
    minutes: '',
    seed: String(1 + Math.floor(Math.random() * 99999)),
  });
  const field = (key, label, most) =>
    html`<label>${label}<input inputmode="numeric" name=${key} value=${asked[key]} onInput=${(e) => setAsked({ ...asked, [key]: e.target.value.trim() })} aria-invalid=${String(Boolean(asked[key]) && whole(asked[key], most) === null)} /></label>`;
  const good =
    whole(asked.seed, 999999) !== null &&
    whole(asked.count, MOST) > 0 &&
    (!asked.minutes || whole(asked.minutes, 600) > 0);
  return html`<section aria-label=${t('Exam')}><h1>${t('Exam')}</h1><p class="statement">${t('No hints, no marks and no answers until it is handed in. Whoever types the same exam number gets the same exercises with the same numbers.')}</p>
    <form class="setting" onSubmit=${(e) => {
      e.preventDefault();
      if (good) location.hash = link('exercises', 'exam', asked);
    }}>${field('count', t('Exercises (1 to {most})', { most: MOST }), MOST)}
      <label>${t('Domain')}<select name="domain" value=${asked.domain} onChange=${(e) => setAsked({ ...asked, domain: e.target.value })}><option value="">${t('all of them')}</option>${domains.map((d) => html`<option value=${d.name} selected=${d.name === asked.domain}>${d.label}</option>`)}</select></label>
      ${field('minutes', t('Minutes (empty: no limit)'), 600)}${field('seed', t('Exam number'), 999999)}
      <div class="row"><button class="button main" disabled=${!good}>${t('Begin')}</button></div></form></section>`;
}

function Sitting({ name, seed, held, minutes }) {
  const [kept, keep] = useKept(name, { answers: {}, began: null, marks: null });
  const state = useRef(kept);
  const put = (next) => {
    state.current = next;
    keep(next);
  };
  useEffect(() => {
    if (!state.current.began) put({ ...state.current, began: Date.now() });
  }, []);
  const { data, error, pending, cancel, job } = useAnswer(
    (signal) =>
      Promise.all(
        held.map((e) =>
          ask(`/api/exercises/${encodeURIComponent(e.id)}?seed=${seed}`, undefined, { signal }),
        ),
      ),
    [name, settings.language, settings.units],
    0,
  );
  const [busy, setBusy] = useState(false);
  const [problem, setProblem] = useState('');
  const handIn = async () => {
    if (state.current.marks || busy) return;
    setBusy(true);
    setProblem('');
    try {
      put({ ...state.current, marks: await marked(held, seed, state.current.answers), ended: Date.now() });
    } catch (fault) {
      setProblem(fault.message);
    }
    setBusy(false);
  };
  const over = Boolean(kept.marks);
  const steps = data?.flatMap((e) => e.steps.map((_, place) => `${e.id} ${place}`)) ?? [];
  const given = steps.filter((key) => kept.answers[key]?.trim()).length;
  const right = over ? steps.filter((key) => kept.marks[key]?.verdict === 'right').length : 0;
  return html`<section aria-label=${t('Exam')} aria-busy=${String(!data && pending)}><h1>${t('Exam')} ${seed}</h1>
    <${Working} busy=${pending} cancel=${cancel} job=${job} />${error && html`<p class="message out" role="alert">${error.message}</p>`}
    ${minutes && kept.began && !over && html`<${Clock} until=${kept.began + minutes * 60000} end=${handIn} />`}
    ${
      over &&
      html`<div class="card" role="status" data-score=${`${right}/${steps.length}`}><p class="result"><strong>${t('{score} of {count} right', { score: right, count: steps.length })}</strong></p>
      <p class="small dim">${t('Handed in after {minutes} min.', { minutes: Math.max(1, Math.round((kept.ended - kept.began) / 60000)) })}</p>
      <div class="row"><button class="button" onClick=${() => saved(seed, steps, kept)}>${t('Result as CSV')}</button> <a href=${link('exercises', 'exam')}>${t('Another exam')}</a></div></div>`
    }
    ${data?.map((exercise, e) => html`<article class="exam-paper"><h2>${e + 1}. ${exercise.title}</h2><p class="statement"><${Indexed} text=${exercise.statement} /></p><ol class="steps">${exercise.steps.map((step, place) => html`<${Asked} key=${place} name=${exercise.id} place=${place} step=${step} text=${kept.answers[`${exercise.id} ${place}`] ?? ''} mark=${kept.marks?.[`${exercise.id} ${place}`]} over=${over || busy} onChange=${(text) => put({ ...state.current, answers: { ...state.current.answers, [`${exercise.id} ${place}`]: text } })} />`)}</ol></article>`)}
    ${problem && html`<p class="message out" role="alert">${problem}</p>`}
    ${data && !over && html`<div class="row"><button class="button main" disabled=${busy} onClick=${handIn}>${busy ? t('Marking…') : t('Hand in')}</button> <span class="dim">${t('{count} of {of} answered', { count: given, of: steps.length })}</span></div>`}</section>`;
}

function Asked({ name, place, step, text, mark, over, onChange }) {
  const right = mark?.verdict === 'right';
  return html`<li data-exercise=${name} data-step=${place}><h3><${Indexed} text=${step.ask} /></h3>
    ${
      step.choices.length
        ? html`<${Choices} step=${step} group=${`${name} ${place}`} text=${text} onChange=${onChange} off=${over} />`
        : over
          ? html`<p>${text || '—'}</p>`
          : html`<div class="row reply"><${Quantity} p=${step.quantity} label=${step.label} text=${text} onChange=${onChange} /></div>`
    }
    ${mark && html`<p data-verdict=${mark.verdict} class=${`mark ${right ? 'ok' : 'out'}`}>${right ? '✓' : '✗'} <${Indexed} text=${mark.text} /></p>${!right && html`<p class="small">${t('Right answer: {value}', { value: mark.right })}</p>`}${step.erratum && html`<p class="message caution small" data-erratum><${Indexed} text=${step.erratum} /></p>`}`}</li>`;
}

function Clock({ until, end }) {
  const [now, setNow] = useState(Date.now());
  useEffect(() => {
    const timer = setInterval(() => setNow(Date.now()), 1000);
    return () => clearInterval(timer);
  }, []);
  const left = Math.max(0, Math.round((until - now) / 1000));
  useEffect(() => {
    if (left === 0) end();
  }, [left === 0]);
  return html`<p class="clock" role="timer" aria-live="off">${t('Time left: {time}', { time: `${Math.floor(left / 60)}:${String(left % 60).padStart(2, '0')}` })}</p>`;
}

/** The verdict on every step, with what would have been right. */
async function marked(held, seed, answers) {
  const marks = {};
  for (const { id } of held) {
    const path = `/api/exercises/${encodeURIComponent(id)}`;
    const { answers: rights } = await ask(`${path}/answers?seed=${seed}`);
    for (const [place, right] of rights.entries()) {
      const answer = (answers[`${id} ${place}`] ?? '').trim();
      const verdict = answer
        ? await ask(path, { step: place, answer, seed })
        : { verdict: 'wrong', text: t('No answer.') };
      marks[`${id} ${place}`] = { ...verdict, right: right.text };
      if (answer && verdict.verdict !== 'unclear')
        note(id, place, { right: verdict.verdict === 'right', answer, seed });
    }
  }
  return marks;
}

function saved(seed, steps, { answers, marks }) {
  const cell = (text) => `"${String(text ?? '').replaceAll('"', '""')}"`;
  const rows = steps.map((key) => {
    const [exercise, place] = key.split(' ');
    return [exercise, Number(place) + 1, cell(answers[key]), marks[key].verdict, cell(marks[key].right)].join(
      ',',
    );
  });
  download(
    `granum-exam-${seed}.csv`,
    ['exercise,step,answer,verdict,right answer', ...rows].join('\n') + '\n',
    'text/csv',
  );
}
