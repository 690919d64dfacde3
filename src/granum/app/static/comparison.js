// Cases side by side: what differs and by how much; what is the same is folded away.
import { html, t, settings } from './core.js';

/** A case against the first one: a share where there is one, a difference for temperatures; empty where they are equal or no numbers. */
function change(first, other) {
  const [a, b] = [first?.value, other?.value];
  if (typeof a !== 'number' || typeof b !== 'number' || a === b) return '';
  const number = (value, digits = 3) =>
    new Intl.NumberFormat(settings.language, { maximumSignificantDigits: digits, signDisplay: 'exceptZero' })
      .format(value)
      .replace('-', '−');
  if (first.unit === 'K') return `${number(b - a)} K`;
  return a === 0 ? '' : b / a > 10 ? `× ${number(b / a).replace('+', '')}` : `${number((100 * (b - a)) / Math.abs(a))} %`;
}

export function Comparison({ cases, clear }) {
  const names = [...new Set(cases.flatMap((c) => c.inputs_shown.map((row) => row.name)))];
  const shown = (c, name) => c.inputs_shown.find((row) => row.name === name);
  const same = (name) => cases.every((c) => shown(c, name)?.text === shown(cases[0], name)?.text);
  const cell = (text, delta, strong) =>
    html`<td class="n">${strong ? html`<strong>${text}</strong>` : text}${delta && html`<div class="small dim" data-change>${delta}</div>`}</td>`;
  const input = (name, strong) =>
    html`<tr class=${strong ? '' : 'dim'}><td>${cases.map((c) => shown(c, name)?.label).find(Boolean)}</td>${cases.map((c, i) => cell(shown(c, name)?.text ?? '—', i > 0 && change(cases[0].inputs[name], c.inputs[name]), strong))}</tr>`;
  const equal = names.filter(same);
  return html`<h2>${t('Comparison')}</h2><div class="wide" data-comparison><table><thead><tr><td></td>${cases.map((_, i) => html`<th class="n" scope="col">${t('case {number}', { number: i + 1 })}</th>`)}</tr></thead>
    <tbody>${cases[0].shown.map((first, k) => html`<tr><td><strong>${first.label}</strong></td>${cases.map((c, i) => cell(c.intervals?.[first.name]?.text ?? c.shown[k].text, i > 0 && change(cases[0].outputs[first.name], c.outputs[first.name]), true))}</tr>`)}
    ${names.filter((name) => !same(name)).map((name) => input(name, true))}</tbody></table></div>
    ${equal.length > 0 && html`<details class="small"><summary>${t('The same in all cases ({count})', { count: equal.length })}</summary><div class="wide"><table><tbody>${equal.map((name) => html`<tr class="dim"><td>${shown(cases[0], name)?.label}</td><td class="n">${shown(cases[0], name)?.text}</td></tr>`)}</tbody></table></div></details>`}
    <div class="row"><button class="button" onClick=${clear}>${t('Clear')}</button></div>`;
}
