// One study on the server: started, asked about until it is done, also after a reload; and what it found.
import { html, t, ask, download, remember, recall, useState, useEffect, useRef } from './core.js';
import { Plot } from './plot.js';

const PAUSE = 400; // ms between two questions

export function useJob(place) {
  const kept = 'job ' + place;
  const [state, setState] = useState({
    running: false,
    share: 0,
    note: '',
    outcome: null,
    error: '',
    asked: '',
    question: null,
  });
  const now = useRef(null);
  const follow = async (id, job) => {
    now.current = id;
    setState((s) => ({ ...s, running: true, share: 0, note: '', error: '' }));
    for (let failed = 0; now.current === id;) {
      try {
        const found = await ask(`/api/studies/${id}`);
        if (now.current !== id) return;
        if (found.state === 'done') {
          setState({
            running: false,
            share: 1,
            note: '',
            outcome: found.outcome,
            error: '',
            asked: job.asked,
            question: job.question,
          });
          return;
        }
        failed = 0;
        setState((s) => ({ ...s, share: found.share, note: found.note }));
      } catch (problem) {
        if (now.current !== id) return;
        if (problem.details && problem.details.type !== 'Busy') {
          remember(kept, null);
          setState((s) => ({ ...s, running: false, error: problem.message }));
          return;
        }
        failed += 1; // no answer: the server is busy or away for a moment, the study goes on
      }
      await new Promise((done) => setTimeout(done, Math.min(PAUSE * 2 ** failed, 10000)));
    }
  };
  const stop = (id) => ask(`/api/studies/${id}`, undefined, { method: 'DELETE' }).catch(() => {});
  const cancel = () => {
    // what was computed comes with the next answer
    if (now.current && now.current !== 'new') {
      stop(now.current);
      return;
    }
    now.current = null;
    setState((s) => ({ ...s, running: false }));
  };
  useEffect(() => {
    // one that was under way when the page was left
    const job = recall(kept);
    if (job) follow(job.id, job);
    return () => {
      now.current = null;
    };
  }, []);
  const start = async (study, question) => {
    if (state.running) cancel();
    now.current = 'new';
    setState((s) => ({ ...s, running: true, share: 0, error: '' }));
    try {
      const { id } = await ask('/api/studies', study);
      if (now.current !== 'new') {
        stop(id);
        return;
      }
      const job = { id, asked: JSON.stringify(study), question };
      remember(kept, job);
      follow(id, job);
    } catch (problem) {
      setState((s) => ({ ...s, running: false, error: problem.message }));
    }
  };
  return { ...state, start, cancel };
}

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
  return html`<div class="row spread"><div data-question><h2 class="first">${data.model}</h2>${question && html`<p><strong>${question.kind}</strong> · ${question.title}</p>${question.rows.map((text) => html`<p class="small dim">${text}</p>`)}`}</div>${data.cases && html`<button class="button" onClick=${save}>${t('Download the cases')}</button>`}</div>
    <p class=${counts.failed ? 'caution' : 'ok'} data-study=${data.study}>${counts.failed ? '▲' : '●'} ${t('{run} cases, {failed} without a result', { run: counts.run, failed: counts.failed })}</p>
    ${data.warnings.map((text) => html`<p class="small caution">${text}</p>`)}
    ${data.charts.map((c) => html`<${Plot} key=${c.name} figure=${c.figure} label=${c.figure.layout.title?.text || c.name} />`)}
    ${data.tables.map(
      (
        table,
      ) => html`<h3>${table.title}</h3><div class="wide" tabindex="0" role="region" aria-label=${table.title}><table><thead><tr>${table.columns.map((c, i) => html`<th scope="col" class=${i ? 'n' : ''}>${c}</th>`)}</tr></thead>
      <tbody>${table.rows.map((r) => html`<tr>${r.map((text, i) => html`<td class=${i ? 'n' : ''}>${text}</td>`)}</tr>`)}</tbody></table></div>`,
    )}`;
}
