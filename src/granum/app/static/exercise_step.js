// One step of an exercise: an answer typed or chosen, marked at once with its reason; hint, answer and chart on request.
import { html, t, ask, link, useAnswer, useEffect, useKept, useRef, useState, settings, Working } from './core.js';
import { Quantity } from './quantity.js';
import { Sensitivity } from './sensitivity.js';
import { note } from './progress.js';
import { Indexed } from './indices.js';
import { hrefOf } from './seek.js';

/** The answers to choose from, one of them. */
export function Choices({ step, group, text, onChange, off = false }) {
  return html`<div class="picks" role="radiogroup" aria-label=${step.ask}>${step.choices.map(
    (choice) =>
      html`<label class="pick"><input type="radio" name=${group} value=${choice.key} checked=${text === String(choice.key)} disabled=${off} onChange=${() => onChange(String(choice.key))} /> <span><${Indexed} text=${choice.says} /></span></label>`,
  )}</div>`;
}

export function Step({ name, place, seed, step, record }) {
  const [kept, keep] = useKept(`answer ${name} ${place} ${seed ?? ''}`, { text: '', verdict: null });
  const said =
    kept.verdict && (kept.language === settings.language ? kept.verdict.text : t(kept.verdict.verdict));
  const [hint, setHint] = useState(false);
  const [open, setOpen] = useState(false);
  const [busy, setBusy] = useState(0); // answers on their way: a second one need not wait for the first
  const [problem, setProblem] = useState('');
  const chosen = step.choices.length > 0;
  const right = kept.verdict?.verdict === 'right';
  const unclear = kept.verdict?.verdict === 'unclear' && !chosen; // told at the field, once
  const latest = useRef(kept); // a verdict comes late: it stands beside the answer it is about, and only there
  const hold = (next) => {
    latest.current = next;
    keep(next);
  };
  const marked = async () => {
    const { turn, text } = latest.current;
    const verdict = await ask(`/api/exercises/${encodeURIComponent(name)}`, { step: place, answer: text, seed });
    if (latest.current.turn === turn) hold({ ...latest.current, verdict, language: settings.language });
    return { verdict, text };
  };
  useEffect(() => {
    // a verdict of before the change of language is said again in the new one; it counts once
    if (kept.verdict && kept.language !== settings.language) marked().catch(() => {});
  }, []);
  const check = async () => {
    if (!latest.current.text.trim()) return;
    setBusy((count) => count + 1);
    setProblem('');
    try {
      const { verdict, text } = await marked();
      if (verdict.verdict !== 'unclear')
        note(name, place, { right: verdict.verdict === 'right', answer: text, seed });
    } catch (fault) {
      setProblem(fault.message);
    }
    setBusy((count) => count - 1);
  };
  const reveal = () => {
    if (!open && !right) note(name, place, { shown: true, seed });
    setOpen(!open);
  };
  const change = (text, understood) =>
    hold(understood ? { ...latest.current, text } : { text, verdict: null, turn: (latest.current.turn ?? 0) + 1 });
  return html`<li data-step=${place}><h2><${Indexed} text=${step.ask} /></h2>
    <form class=${chosen ? 'reply chosen' : 'row reply'} onSubmit=${(e) => {
      e.preventDefault();
      check();
    }}>${
      chosen
        ? html`<${Choices} step=${step} group=${`choice-${place}`} text=${kept.text} onChange=${change} />`
        : html`<${Quantity} p=${step.quantity} label=${step.label} text=${kept.text} onChange=${change} onEnter=${check} problem=${unclear ? said : ''} />`
    }
      <div class="row"><button class="button main" disabled=${!kept.text.trim()}>${busy && !kept.verdict ? t('Marking…') : t('Check')}</button>
      ${(step.hint || step.equation) && html`<button type="button" class="button" aria-expanded=${String(hint)} onClick=${() => setHint(!hint)}>${t('Hint')}</button>`}
      <button type="button" class="button" aria-expanded=${String(open)} onClick=${reveal}>${open ? t('Hide the answer') : t('Show the answer')}</button></div></form>
    ${step.within && !kept.verdict && html`<p class="small dim" data-within>${t('Right within {share}.', { share: step.within })}</p>`}
    <p role="status" data-verdict=${kept.verdict?.verdict ?? ''} class=${`mark ${right ? 'ok' : 'out'}`}>${kept.verdict && !unclear && html`${right ? '✓' : '✗'} <${Indexed} text=${said} />`}</p>
    ${problem && html`<p class="message out" role="alert">${problem}</p>`}
    ${!kept.verdict && record?.right && html`<p class="small ok">✓ ${t('Solved before.')}</p>`}
    ${hint && html`<div class="card" data-hint>${step.hint && html`<p><${Indexed} text=${step.hint} /></p>`}${step.card && html`<${Named} step=${step} />`}${step.equation && html`<${Equation} shown=${step.equation} />`}</div>`}
    ${open && html`<div class="card" data-answer>${chosen ? html`<${Reason} name=${name} place=${place} seed=${seed} step=${step} />` : html`<${Calculated} step=${step} />`}</div>`}
    ${(right || open) && step.erratum && html`<p class="message caution small" data-erratum><${Indexed} text=${step.erratum} /></p>`}
    ${(right || open) && chosen && step.card && html`<p class="small"><${Named} step=${step} /></p>`}</li>`;
}

const Equation = ({ shown }) =>
  html`<div class="equation" tabindex="0" role="region" aria-label=${t('Equation')} dangerouslySetInnerHTML=${{ __html: shown }} />`;

/** The card of a step by its title, leading to its form. */
const Named = ({ step }) => html`<a href=${hrefOf({ sort: step.sort, key: step.card })}>${step.title}</a>`;

/** Which of the choices is right, and why. */
function Reason({ name, place, seed, step }) {
  const query = seed === null ? '' : `?seed=${seed}`;
  const { data, error, pending, cancel, job } = useAnswer(
    (signal) => ask(`/api/exercises/${encodeURIComponent(name)}/answers${query}`, undefined, { signal }),
    [name, seed],
    0,
  );
  const found = data?.answers[place];
  return html`${error && html`<p class="message out">${error.message}</p>`}<${Working} busy=${pending} cancel=${cancel} job=${job} />${found && html`<p data-output=${step.card}><strong><${Indexed} text=${found.text} /></strong></p><p><${Indexed} text=${found.why} /></p>`}`;
}

/** A quantity by its symbol, or by its name where it has none. */
const named = (row) =>
  row.symbol ? html`<span dangerouslySetInnerHTML=${{ __html: row.symbol }} />` : row.label;

/** The answer with its calculation, and its chart when asked for. */
function Calculated({ step }) {
  const { data, error, pending, cancel, job } = useAnswer(
    (signal) => ask(`/api/calc/${step.card}`, step.inputs, { signal }),
    [step.card],
    0,
  );
  const [drawn, setDrawn] = useState(false);
  const row = data?.shown.find((r) => r.name === step.output);
  const apart = settings.language === 'fr' ? ' ; ' : '; ';
  return html`${error && html`<p class="message out">${error.message}</p>`}<${Working} busy=${pending} cancel=${cancel} job=${job} />${
    row &&
    html`<p class="result" data-output=${row.name}>${named(row)} = <strong>${row.text}</strong></p>
    ${step.printed && html`<p class="small" data-printed>${t('Printed in the course: {value}', { value: step.printed })}</p>`}
    ${step.remark && html`<p class="small dim"><${Indexed} text=${step.remark} /></p>`}
    <div class="dim">${step.title}</div>${data.equation && html`<${Equation} shown=${data.equation} />`}
    <p class="small">${data.inputs_shown.map((r, i) => html`${i > 0 ? apart : ''}<span class="pair">${named(r)} = ${r.text}</span>`)}</p>
    <div class="row"><button type="button" class="button" aria-expanded=${String(drawn)} onClick=${() => setDrawn(!drawn)}>${drawn ? t('Hide the chart') : t('Show the chart')}</button> <a class="small" href=${link('calculate', step.card, step.inputs)}>${t('Open in Calculate')}</a></div>
    ${drawn && html`<${Charted} step=${step} />`}`
  }`;
}

/** The result of a step over one of its inputs. */
function Charted({ step }) {
  const [choice, setChoice] = useState({ output: step.output });
  return html`<${Sensitivity} card=${{ card: step.card, sort: '', outputs: [{ name: step.output }] }} values=${step.inputs} old=${false} units=${{ [step.output]: step.unit }} laws=${false} choice=${choice} setChoice=${setChoice} none=${t('No chart of this: it has no input that could run.')} />`;
}
