// Exercises: statement, numbers, an answer of one's own for each step, marked at once; hint, then answer; quizzes under them.
import { html, t, ask, link, useAnswer, settings, Working } from './core.js';
import { Indexed } from './indices.js';
import { Quiz } from './quiz.js';
import { Step } from './exercise_step.js';
import { done, exported, useProgress } from './progress.js';

export function Exercises({ state }) {
  const { data, error } = useAnswer(() => ask('/api/exercises'), [settings.language, settings.units], 0);
  const progress = useProgress();
  if (error)
    return html`<main class="page" id="main"><h1>${t('Exercises')}</h1><p class="message out">${error.message}</p></main>`;
  if (!data)
    return html`<main class="page" id="main" aria-busy="true"><h1>${t('Exercises')}</h1><p class="dim">${t('Loading…')}</p></main>`;
  const all = data.domains.flatMap((d) => d.exercises);
  const quizzes = state.key === 'quizzes';
  const current = quizzes ? 'quizzes' : (all.find((e) => e.id === state.key) || all[0]).id;
  const seed = /^\d{1,6}$/.test(state.values.seed || '') ? Number(state.values.seed) : null;
  const answered = data.quizzes.filter((quiz) => done(progress, quiz.id, 1)).length;
  return html`<main class="two" id="main"><section class="find" aria-label=${t('Find')}><details class="course" open=${!matchMedia('(max-width: 62rem)').matches}><summary>${t('Worked examples')} <span class="dim">${all.length}</span></summary>
      ${data.domains.map(
        (domain) =>
          html`<h3>${domain.label}</h3><ul>${domain.exercises.map((e) => html`<li><a href=${link('exercises', e.id)} aria-current=${e.id === current ? 'page' : null}>${e.title} <${Share} count=${done(progress, e.id, e.steps)} of=${e.steps} /></a></li>`)}</ul>`,
      )}
      </details><h2>${t('Questions')}</h2><ul><li><a href=${link('exercises', 'quizzes')} aria-current=${quizzes ? 'page' : null}>${t('{count} questions of the course', { count: data.quizzes.length })} <${Share} count=${answered} of=${data.quizzes.length} /></a></li></ul>
      <div class="row"><button class="button" disabled=${!Object.keys(progress).length} onClick=${exported}>${t('Download my progress')}</button></div>
      <p class="small dim">${t('Answers are kept in this browser only.')}</p></section>
    ${
      quizzes
        ? html`<section aria-label=${t('Questions')}><h1>${t('Questions')}</h1>${data.quizzes.map((quiz) => html`<${Quiz} key=${quiz.id + settings.language} quiz=${quiz} />`)}</section>`
        : html`<${Exercise} key=${`${current} ${seed} ${settings.language} ${settings.units}`} name=${current} seed=${seed} progress=${progress} />`
    }</main>`;
}

const Share = ({ count, of }) =>
  count > 0 &&
  html`<span class=${count === of ? 'ok small' : 'dim small'}>${count === of ? '✓' : `${count}/${of}`}<span class="hidden">${' '}${t('{count} of {of} solved', { count, of })}</span></span>`;

function Exercise({ name, seed, progress }) {
  const query = seed === null ? '' : `?seed=${seed}`;
  const {
    data: exercise,
    error,
    pending,
    cancel,
    job,
  } = useAnswer(
    (signal) => ask(`/api/exercises/${encodeURIComponent(name)}${query}`, undefined, { signal }),
    [name, seed],
    0,
  );
  const fresh = () => {
    location.hash = link('exercises', name, { seed: 1 + Math.floor(Math.random() * 999999) });
  };
  if (!exercise)
    return html`<section aria-busy=${String(pending)} aria-label=${t('Worked examples')}>${error ? html`<p class="message out" role="alert">${error.message}</p>` : html`<p class="dim">${t('Loading…')}</p>`}<${Working} busy=${pending} cancel=${cancel} job=${job} /></section>`;
  return html`<section aria-label=${t('Worked examples')}><h1>${exercise.title}</h1><p class="statement"><${Indexed} text=${exercise.statement} /></p>
    ${exercise.fresh && html`<div class="row"><button class="button" onClick=${fresh}>${t('Other numbers')}</button>${seed !== null && html` <a href=${link('exercises', name)}>${t('Back to the first numbers')}</a>`}</div>`}
    <ol class="steps">${exercise.steps.map((step, i) => html`<${Step} key=${i} name=${name} place=${i} seed=${seed} step=${step} record=${progress[name]?.[i]} />`)}</ol>
    <p class="small dim">${exercise.source}</p></section>`;
}
