// Exercises: statement on the left, live calculation on the right, the printed answer hidden until asked for; quizzes under them.
import { html, t, ask, link, useAnswer, useState, settings } from './core.js';
import { Quiz } from './quiz.js';

export function Exercises({ state }) {
  const { data, error } = useAnswer(() => ask('/api/exercises'), [settings.language, settings.units], 0);
  if (error)
    return html`<main class="page" id="main"><h1>${t('Exercises')}</h1><p class="message out">${error.message}</p></main>`;
  if (!data)
    return html`<main class="page" id="main" aria-busy="true"><h1>${t('Exercises')}</h1><p class="dim">${t('Loading…')}</p></main>`;
  const exercise = data.exercises.find((e) => e.id === state.key) || data.exercises[0];
  const quizzes = state.key === 'quizzes';
  return html`<main class="two" id="main"><section class="find" aria-label=${t('Find')}><h2 class="first">${t('Worked examples')}</h2>
      <ul>${data.exercises.map((e) => html`<li><a href=${link('exercises', e.id)} aria-current=${!quizzes && e.id === exercise.id ? 'page' : null}>${e.title}</a></li>`)}</ul>
      <h2>${t('Questions')}</h2><ul><li><a href=${link('exercises', 'quizzes')} aria-current=${quizzes ? 'page' : null}>${t('{count} questions of the course', { count: data.quizzes.length })}</a></li></ul></section>
    ${
      quizzes
        ? html`<section aria-label=${t('Questions')}><h1>${t('Questions')}</h1>${data.quizzes.map((quiz) => html`<${Quiz} key=${quiz.id + settings.language} quiz=${quiz} />`)}</section>`
        : html`<section aria-label=${t('Worked examples')} key=${exercise.id}><h1>${exercise.title}</h1><p class="statement">${exercise.statement}</p>
        <ol class="steps">${exercise.steps.map((step, i) => html`<${Step} key=${exercise.id + i + settings.language} step=${step} />`)}</ol>
        <p class="small dim">${exercise.source}</p></section>`
    }</main>`;
}

function Step({ step }) {
  const [open, setOpen] = useState(false);
  const [told, setTold] = useState(false);
  const x = step.expected;
  const calculated = useAnswer(
    (signal) => (open ? ask(`/api/calc/${step.card}`, step.inputs, { signal }) : Promise.resolve(null)),
    [open],
    0,
  );
  const row = calculated.data?.shown.find((r) => r.name === x.output);
  return html`<li data-step><h2>${step.ask}</h2>
    <div class="row"><button class="button" aria-expanded=${String(told)} onClick=${() => setTold(!told)}>${told ? t('Hide the answer') : t('Show the answer')}</button>
      <button class="button" aria-expanded=${String(open)} onClick=${() => setOpen(!open)}>${open ? t('Hide the calculation') : t('Show the calculation')}</button>
      <a href=${link('calculate', step.card, step.inputs)}>${t('Open in Calculate')}</a></div>
    <div aria-live="polite">${told && html`<p data-answer><strong>${x.label} = ${x.text}</strong> <span class="dim">(${t('as printed in the course')})</span></p>${step.remark && html`<p class="small dim">${step.remark}</p>`}`}
    ${calculated.error && html`<p class="message out">${calculated.error.message}</p>`}
    ${
      open &&
      row &&
      html`<div class="card"><div class="dim">${step.title}</div>${calculated.data.equation && html`<div class="equation" tabindex="0" role="region" aria-label=${t('Equation')} dangerouslySetInnerHTML=${{ __html: calculated.data.equation }} />`}
      <p class="small">${calculated.data.inputs_shown.map((r, i) => html`${i > 0 ? ' ; ' : ''}<span class="pair"><span dangerouslySetInnerHTML=${{ __html: r.symbol }} /> = ${r.text}</span>`)}</p>
      <p class="result" data-output=${row.name}><span dangerouslySetInnerHTML=${{ __html: row.symbol }} /> = <strong>${row.text}</strong></p></div>`
    }</div></li>`;
}
