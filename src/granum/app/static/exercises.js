// Exercises: statement, numbers, an answer of one's own for each step, marked at once; hint, then answer; quizzes under them.
import { Awaited, html, t, ask, link, download, useAnswer, useState, settings, Working } from './core.js';
import { Exam } from './exam.js';
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
    return html`<main class="page" id="main"><h1>${t('Exercises')}</h1><${Awaited} text=${t('The list of exercises is on its way…')} /></main>`;
  const all = data.domains.flatMap((d) => d.exercises);
  const page = ['quizzes', 'exam', 'sections'].includes(state.key) ? state.key : '';
  const current = page || (all.find((e) => e.id === state.key) || all[0]).id;
  const seed = /^\d{1,6}$/.test(state.values.seed || '') ? Number(state.values.seed) : null;
  const answered = data.quizzes.filter((quiz) => done(progress, quiz.id, 1)).length;
  return html`<main class="two" id="main"><section class="find" aria-label=${t('Find')}><details class="course" open=${!matchMedia('(max-width: 62rem)').matches}><summary>${t('Worked examples')} <span class="dim">${all.length}</span></summary>
      ${data.domains.map((domain) => html`<${Domain} key=${domain.name} domain=${domain} current=${current} progress=${progress} />`)}
      </details><h2>${t('Questions')}</h2><ul><li><a href=${link('exercises', 'quizzes')} aria-current=${page === 'quizzes' ? 'page' : null}>${t('{count} questions of the course', { count: data.quizzes.length })} <${Share} count=${answered} of=${data.quizzes.length} /></a></li></ul>
      <h2>${t('More')}</h2><ul><li><a href=${link('exercises', 'exam')} aria-current=${page === 'exam' ? 'page' : null}>${t('Exam')}</a></li><li><a href=${link('exercises', 'sections')} aria-current=${page === 'sections' ? 'page' : null}>${t('By section of the notes')}</a></li></ul>
      <div class="row"><button class="button" disabled=${!Object.keys(progress).length} onClick=${exported}>${t('Download my progress')}</button></div>
      <p class="small dim">${t('Answers are kept in this browser only.')}</p></section>
    ${
      page === 'quizzes'
        ? html`<section aria-label=${t('Questions')}><h1>${t('Questions')}</h1>${data.quizzes.map((quiz) => html`<${Quiz} key=${quiz.id + settings.language} quiz=${quiz} />`)}</section>`
        : page === 'exam'
          ? html`<${Exam} domains=${data.domains} values=${state.values} />`
          : page === 'sections'
            ? html`<${Sections} notes=${data.notes} all=${all} />`
            : html`<${Exercise} key=${`${current} ${seed} ${settings.language} ${settings.units}`} name=${current} seed=${seed} progress=${progress} />`
    }</main>`;
}

/** The exercises of a domain, folded away unless one of them is open. */
function Domain({ domain, current, progress }) {
  const here = domain.exercises.some((e) => e.id === current);
  const solved = domain.exercises.filter((e) => done(progress, e.id, e.steps) === e.steps).length;
  return html`<details class="family" open=${here}><summary>${domain.label} <span class="dim small">${solved ? `${solved}/${domain.exercises.length}` : domain.exercises.length}</span></summary><ul>${domain.exercises.map((e) => html`<li><a href=${link('exercises', e.id)} aria-current=${e.id === current ? 'page' : null}>${e.title} <${Share} count=${done(progress, e.id, e.steps)} of=${e.steps} /></a></li>`)}</ul></details>`;
}

/** Every section of the notes with the exercises that belong to it. */
function Sections({ notes, all }) {
  const titles = Object.fromEntries(all.map((e) => [e.id, e.title]));
  return html`<section aria-label=${t('By section of the notes')}><h1>${t('By section of the notes')}</h1>${notes.map(
    (one) =>
      html`<h2 lang="fr">${one.name}</h2><div class="wide"><table class="sections"><tbody>${one.sections.map(
        (section) =>
          html`<tr><th scope="row">${section.number}</th><td>${section.exercises.map((id, i) => html`${i > 0 && ' · '}<a href=${link('exercises', id)}>${titles[id]}</a>`)}${section.quizzes && html`${section.exercises.length > 0 && ' · '}<a href=${link('exercises', 'quizzes')}>${t('Questions')}</a>`}</td></tr>`,
      )}</tbody></table></div>`,
  )}</section>`;
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
    return html`<section aria-busy=${String(pending)} aria-label=${t('Worked examples')}>${error ? html`<p class="message out" role="alert">${error.message}</p>` : html`<${Working} busy=${pending} from=${0} text=${t('The exercise is worked out…')} cancel=${cancel} job=${job} />`}</section>`;
  return html`<section aria-label=${t('Worked examples')}><h1>${exercise.title}</h1><p class="statement"><${Indexed} text=${exercise.statement} /></p>
    ${exercise.fresh && html`<div class="row"><button class="button" onClick=${fresh}>${t('Other numbers')}</button>${seed !== null && html` <a href=${link('exercises', name)}>${t('Back to the first numbers')}</a>`}</div>`}
    <ol class="steps">${exercise.steps.map((step, i) => html`<${Step} key=${i} name=${name} place=${i} seed=${seed} step=${step} record=${progress[name]?.[i]} />`)}</ol>
    <p class="small dim">${exercise.source}</p>${exercise.fresh && html`<${Sheet} name=${name} />`}</section>`;
}

/** The answers of a class, one row a student. */
function Sheet({ name }) {
  const [span, setSpan] = useState({ first: '1', last: '30' });
  const [problem, setProblem] = useState('');
  const field = (key, label) =>
    html`<label>${label} <input inputmode="numeric" size="6" name=${key} value=${span[key]} onInput=${(e) => setSpan({ ...span, [key]: e.target.value.trim() })} /></label>`;
  const good = Object.values(span).every((text) => /^\d{1,6}$/.test(text));
  const save = async () => {
    setProblem('');
    try {
      const path = `/api/exercises/${encodeURIComponent(name)}/sheet?first=${span.first}&last=${span.last}`;
      download(
        `${name}-${span.first}-${span.last}.csv`,
        await ask(path, undefined, { text: true }),
        'text/csv',
      );
    } catch (fault) {
      setProblem(fault.message);
    }
  };
  return html`<details class="class-sheet"><summary>${t('For the teacher')}</summary><p class="small">${t('Each student gets the numbers of a seed: the link of the exercise with ?seed=7 is that of student 7. The sheet holds the numbers and the answers of all.')}</p>
    <div class="row">${field('first', t('Seeds from'))} ${field('last', t('to'))} <button class="button" disabled=${!good} onClick=${save}>${t('Answers as CSV')}</button></div>${problem && html`<p class="message out" role="alert">${problem}</p>`}</details>`;
}
