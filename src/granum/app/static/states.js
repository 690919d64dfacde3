// The states of a process in humid gas as a small table: each by its temperature and one of humidity ratio, relative
// humidity or wet-bulb temperature; the rest is told by the chart.
import { html, t, ask, useRef, useState } from './core.js';
import { headed } from './plot.js';
import { inLanguage } from './quantity.js';

const UNITS = { temperature: 'degC', humidity_ratio: 'g/kg' };
const ALIKE = { degC: ['degC', '°C'], 'g/kg': ['g/kg'] };

/** The numbers of a list such as "20 60 35 degC"; null where it is written in another unit. */
function numbers(text, unit) {
  if (!text?.trim()) return [];
  const cut = ALIKE[unit].map((name) => ` ${name}`).find((end) => text.endsWith(end));
  const found =
    cut &&
    text
      .slice(0, -cut.length)
      .trim()
      .split(/[\s;]+/)
      .map((part) => Number(part.replace(',', '.')));
  return found && found.every(Number.isFinite) ? found : null;
}

/** The states of a form, [°C, g/kg] each; null where its lists are to be edited as they are. */
export function statesOf(values) {
  const [T, w] = Object.entries(UNITS).map(([name, unit]) => numbers(values[name], unit));
  return T && w && T.length === w.length ? T.map((at, i) => [at, w[i]]) : null;
}

const round = (x) => Number(x.toPrecision(4));
/** Values of the form with these states. */
export const withStates = (values, states) => ({
  ...values,
  temperature: states.length ? `${states.map((s) => round(s[0])).join(' ')} degC` : '',
  humidity_ratio: states.length ? `${states.map((s) => round(s[1])).join(' ')} g/kg` : '',
});

/** Humidity ratio in g/kg of a state told otherwise. */
async function ratio(values, celsius, given) {
  const around = Object.fromEntries(
    ['pressure', 'pair'].map((name) => [name, values[name]]).filter(([, v]) => v),
  );
  const { outputs } = await ask('/api/calc/humid_gas.state', {
    temperature: `${celsius} degC`,
    ...given,
    ...around,
  });
  return outputs.humidity_ratio.value * 1000;
}

export function States({ values, states, figure, set }) {
  const [problem, setProblem] = useState('');
  const shown = figure?.data.find((trace) => trace.type === 'table');
  const rows = shown?.cells.values[0].length === states.length ? shown.cells.values : null;
  const heads = shown
    ? shown.header.values
    : ['', '<i>T</i> / °C', '<i>w</i> / (g/kg)', '<i>φ</i> / %', '<i>T<sub>h</sub></i> / °C'];
  const put = (next) => {
    setProblem('');
    now.current.set(withStates(now.current.values, next));
  };
  const now = useRef(null);
  now.current = { values, states, set };
  const change = async (i, column, text) => {
    const number = Number(text.trim().replace(',', '.').replace('−', '-'));
    if (!text.trim() || !Number.isFinite(number)) {
      setProblem(t('{text} is not a number.', { text: text.trim() || '—' }));
      return;
    }
    const [T, w] = states[i];
    try {
      const state =
        column === 1
          ? [number, w]
          : column === 2
            ? [T, number]
            : [
                T,
                await ratio(
                  values,
                  T,
                  column === 3
                    ? { relative_humidity: `${number} %` }
                    : { wet_bulb_temperature: `${number} degC` },
                ),
              ];
      if (now.current.states[i]) put(now.current.states.map((s, k) => (k === i ? state : s)));
    } catch (fault) {
      setProblem(fault.message);
    }
  };
  const text = (i, column) =>
    rows ? rows[column][i] : column < 3 ? inLanguage(String(states[i][column - 1])) : '';
  return html`<section data-states><h2>${t('States')}</h2>
    ${
      states.length > 0 &&
      html`<div class="wide" tabindex="0" role="region" aria-label=${t('States')}><table class="states stack"><thead><tr>${heads.map((head) => html`<th scope="col" class="n" dangerouslySetInnerHTML=${{ __html: headed(head) }} />`)}<th scope="col"><span class="hidden">${t('Remove')}</span></th></tr></thead>
      <tbody>${states.map(
        (_, i) =>
          html`<tr key=${`${i} ${states.length}`}>${heads.map((head, column) => (column >= 1 && column <= 4 ? html`<td class="n"><${Headed} head=${head} /><${Cell} label=${`${t('state {number}', { number: i + 1 })}, ${head.replace(/<[^>]*>/g, '')}`} text=${text(i, column)} change=${(typed) => change(i, column, typed)} /></td>` : html`<td class="n">${column > 0 && html`<${Headed} head=${head} />`}${column === 0 ? i + 1 : text(i, column)}</td>`))}
          <td><button class="plain" aria-label=${t('Remove state {number}', { number: i + 1 })} onClick=${() => put(states.filter((_s, k) => k !== i))}>×</button></td></tr>`,
      )}</tbody></table></div>`
    }
    ${problem && html`<p class="message out" role="alert">${problem}</p>`}
    <div class="row"><button class="button" onClick=${() => put([...states, states.at(-1) ?? [20, 7]])}>${t('Add a state')}</button> <span class="small dim">${t('or click on the chart')}</span></div></section>`;
}

/** What a cell holds, beside it where a state stands as a list. */
const Headed = ({ head }) =>
  html`<span class="beside" aria-hidden="true" dangerouslySetInnerHTML=${{ __html: headed(head) }} />`;

/** A cell whose text belongs to the user while it has the focus. */
function Cell({ label, text, change }) {
  const [typed, setTyped] = useState(null);
  const settle = () => {
    if (typed !== null && typed !== text) change(typed);
    setTyped(null);
  };
  return html`<input aria-label=${label} autocomplete="off" value=${typed ?? text} onInput=${(e) => setTyped(e.target.value)} onBlur=${settle} onKeyDown=${(e) => e.key === 'Enter' && settle()} />`;
}
