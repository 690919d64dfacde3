// One question: tick what is right, or put each item into its group; checked on request, kept in this browser.
import { html, t, useKept } from './core.js';
import { note } from './progress.js';

export function Quiz({ quiz }) {
  const [{ answers, checked }, keep] = useKept('quiz ' + quiz.id, { answers: {}, checked: false });
  const items = quiz.options || quiz.items;
  const right = (item, i) => (quiz.options ? Boolean(answers[i]) === item.right : answers[i] === item.group);
  const score = items.filter(right).length;
  const set = (i, value) => keep({ answers: { ...answers, [i]: value }, checked: false });
  const check = () => {
    keep({ answers, checked: true });
    note(quiz.id, 0, { right: score === items.length, answer: `${score}/${items.length}` });
  };
  const mark = (item, i) =>
    checked &&
    html`<span class=${right(item, i) ? 'ok' : 'out'}>${right(item, i) ? `✓ ${t('right')}` : `✗ ${t('wrong')}`}</span>`;
  return html`<fieldset class="quiz" data-quiz=${quiz.id}><legend>${quiz.question}</legend>
    ${
      quiz.options
        ? quiz.options.map(
            (option, i) =>
              html`<div class="option"><label><input type="checkbox" checked=${Boolean(answers[i])} onChange=${(e) => set(i, e.target.checked)} /> ${option.text}</label> ${mark(option, i)}</div>`,
          )
        : quiz.items.map(
            (
              item,
              i,
            ) => html`<div class="option"><label><select value=${answers[i] ?? ''} onChange=${(e) => set(i, e.target.value === '' ? undefined : Number(e.target.value))}><option value="">—</option>
        ${quiz.groups.map((group, g) => html`<option value=${g}>${group}</option>`)}</select> ${item.text}</label> ${mark(item, i)}</div>`,
          )
    }
    <div class="row"><button class="button" onClick=${check}>${t('Check')}</button>
    <span role="status">${checked && t('{score} of {count} right', { score, count: items.length })}</span></div>
    ${checked && html`<p class="small">${quiz.why}</p>`}<p class="small dim">${quiz.source}</p></fieldset>`;
}
