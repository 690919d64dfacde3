// Studies on the server: started, followed on every page and after a reload until they are done; and what they found.
import { html, render, t, ask, download, link, remember, recall, useState, useEffect } from './core.js';
import { Plot } from './plot.js';
import { keepStudy } from './study_history.js';

const PAUSE = 400; // ms between two questions
const KEPT = 'jobs';
const STARTED = 'studied';
const CHANGED = 'granum-jobs';
const IDLE = {
  running: false,
  share: 0,
  note: '',
  outcome: null,
  error: '',
  asked: '',
  question: null,
  unkept: false,
  partly: false, // something is computed that can be looked at
  part: null,
  asking: null,
};

/** The state of the study of each place; the page may be left meanwhile. */
const states = new Map();
const stateOf = (place) => states.get(place) ?? IDLE;
function update(place, part) {
  states.set(place, { ...stateOf(place), ...part });
  dispatchEvent(new Event(CHANGED));
}
const underWay = () => recall(KEPT, {});
/** Where the study is that runs, else the one that was started last; nothing where none was. */
export const lastStudied = () => Object.values(underWay()).at(-1)?.link ?? recall(STARTED);
function keepJob(place, job) {
  const { [place]: _gone, ...rest } = underWay();
  remember(KEPT, job ? { ...rest, [place]: job } : rest);
}

const stop = (id) => ask(`/api/studies/${id}`, undefined, { method: 'DELETE' }).catch(() => {});

async function follow(place, job) {
  update(place, { id: job.id, running: true, share: 0, note: '', error: '', partly: false, part: null, asking: job.question });
  for (let failed = 0; stateOf(place).id === job.id;) {
    try {
      const found = await ask(`/api/studies/${job.id}`);
      if (stateOf(place).id !== job.id) return;
      if (found.state === 'done') {
        keepJob(place, null);
        const { id, asked, question, setup } = job;
        const outcome = found.outcome;
        update(place, {
          id: null,
          running: false,
          share: 1,
          note: '',
          outcome,
          asked,
          question,
          error: '',
          part: null,
          done: true,
        });
        const kept = await keepStudy({ id, place, asked, question, setup, outcome, when: Date.now() });
        update(place, { unkept: !kept });
        return;
      }
      failed = 0;
      update(place, { share: found.share, note: found.note, partly: found.part });
    } catch (problem) {
      if (stateOf(place).id !== job.id) return;
      if (problem.details && problem.details.type !== 'Busy') {
        keepJob(place, null);
        update(place, { id: null, running: false, error: problem.message });
        return;
      }
      failed += 1; // no answer: the server is busy or away for a moment, the study goes on
    }
    await new Promise((done) => setTimeout(done, Math.min(PAUSE * 2 ** failed, 10000)));
  }
}
for (const [place, job] of Object.entries(underWay())) follow(place, job); // those that were under way when the page was left

async function start(place, study, question, setup) {
  const before = stateOf(place);
  if (before.running && before.id) stop(before.id);
  const mark = Symbol('new');
  const here = location.hash.startsWith('#/studies/') ? location.hash : link('studies', place);
  remember(STARTED, here);
  update(place, { id: mark, running: true, share: 0, note: '', error: '', done: false });
  try {
    const { id } = await ask('/api/studies', study);
    if (stateOf(place).id !== mark) {
      stop(id);
      return;
    }
    const job = { id, asked: JSON.stringify(study), question, setup, link: here };
    keepJob(place, job);
    follow(place, job);
  } catch (problem) {
    if (stateOf(place).id === mark) update(place, { id: null, running: false, error: problem.message });
  }
}

/** What the study has found by now; it goes on. */
async function look(place) {
  const { id } = stateOf(place);
  const part = await ask(`/api/studies/${id}/part`).catch(() => null); // it may have ended meanwhile
  if (part && stateOf(place).id === id) update(place, { part });
}

function cancel(place) {
  const { id } = stateOf(place);
  if (typeof id === 'string')
    stop(id); // what was computed comes with the next answer
  else update(place, { id: null, running: false });
}

const useChanges = () => {
  const [, set] = useState(0);
  useEffect(() => {
    const changed = () => set((count) => count + 1);
    addEventListener(CHANGED, changed);
    return () => removeEventListener(CHANGED, changed);
  }, []);
};

export function useJob(place) {
  useChanges();
  useEffect(() => {
    if (stateOf(place).done) update(place, { done: false }); // it is looked at
  });
  return {
    ...stateOf(place),
    start: (study, question, setup) => start(place, study, question, setup),
    cancel: () => cancel(place),
    look: () => look(place),
  };
}

/** A study of the past at its place, with the question it answered. */
export const showStudy = ({ place, outcome, asked, question }) =>
  update(place, { outcome, asked, question, error: '' });

/** On other pages: how far the studies are that run meanwhile, and which are ready. */
function Elsewhere() {
  useChanges();
  const [hash, setHash] = useState(location.hash);
  useEffect(() => {
    const moved = () => setHash(location.hash);
    addEventListener('hashchange', moved);
    return () => removeEventListener('hashchange', moved);
  }, []);
  if (hash.startsWith('#/studies')) return null;
  const shown = [...states].filter(([, state]) => state.running || state.done);
  return html`${shown.map(
    ([place, state]) =>
      html`<a class="elsewhere" key=${place} href=${link('studies', place)} data-elsewhere>${state.running ? `${t('A study is running')} · ${state.note || `${Math.round(100 * state.share)} %`}` : t('A study is ready')}</a>`,
  )}`;
}
const corner = document.createElement('div');
document.body.append(corner);
render(html`<${Elsewhere} />`, corner);

/** What a study found, headed by the question it answers. */
export function Outcome({ data, question }) {
  const counts = data.counts;
  const save = () => {
    const names = Object.keys(data.cases);
    const unit = Object.fromEntries([...data.inputs, ...data.outputs].map((v) => [v.name, v.unit]));
    const lines = [
      names.map((n) => `${n} [${unit[n] || '1'}]`).join(','),
      ...data.cases[names[0]].map((_, i) => names.map((n) => data.cases[n][i] ?? '').join(',')),
    ];
    download('cases.csv', lines.join('\n') + '\n', 'text/csv');
  };
  return html`<div class="row spread"><div data-question><p class="small dim">${data.model}${question && ` · ${question.kind}`}</p>${question && html`<h2 class="first">${question.title}</h2>${question.rows.map((text) => html`<p class="small dim">${text}</p>`)}`}</div>${data.cases && html`<button class="button" onClick=${save}>${t('Download the cases')}</button>`}</div>
    <p class=${counts.failed ? 'caution' : 'ok'} data-study=${data.study}>${counts.failed ? '▲' : '●'} ${counts.failed ? t('{run} cases, {failed} without a result', { run: counts.run, failed: counts.failed }) : t('{run} cases, each with a result', { run: counts.run })}${data.complete ? '' : ` · ${data.goes_on ? t('so far') : t('stopped early')}`}</p>
    ${data.warnings.map((text) => html`<p class="small caution">${text}</p>`)}
    ${data.charts.map((c) => html`<${Plot} key=${c.name} figure=${c.figure} label=${c.figure.layout.title?.text || c.name} />`)}
    ${data.tables.some((table) => table.columns.includes('P90')) && html`<p class="small dim" data-shares>${t('P10, P50, P90: a tenth, half and nine tenths of the cases lie below.')}</p>`}
    ${data.tables.map(
      (
        table,
      ) => html`<h3>${table.title}</h3><div class="wide" tabindex="0" role="region" aria-label=${table.title}><table class="stack"><thead><tr>${table.columns.map((c, i) => html`<th scope="col" class=${i ? 'n' : ''}>${c}</th>`)}</tr></thead>
      <tbody>${table.rows.map((r) => html`<tr>${r.map((text, i) => html`<td class=${i ? 'n' : ''} data-head=${table.columns[i]}>${text}</td>`)}</tr>`)}</tbody></table></div>`,
    )}`;
}
