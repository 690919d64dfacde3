// What a study is asked: its kinds, its rows as they are typed, the table for the server, and the question in words.
import { colon, t } from './core.js';
import { inLanguage, joined, split } from './quantity.js';

export const KINDS = [
  ['sweep', 'Sweep of one input', 'One input goes from one value to another; the figures follow as curves.'],
  ['map', 'Map of two inputs', 'Two inputs vary together; each figure becomes a map with contours.'],
  ['scenarios', 'Scenarios', 'A few named cases side by side.'],
  [
    'monte_carlo',
    'Monte Carlo',
    'Inputs are uncertain; how far do the figures scatter, and how likely are limits kept?',
  ],
  [
    'sobol',
    'Where the variance comes from',
    'Inputs are uncertain; which of them causes how much of the scatter?',
  ],
  ['optimize', 'Optimum', 'The inputs inside their limits that make one figure best.'],
  ['pareto', 'Best compromises', 'Two figures that pull apart: what the one costs in terms of the other.'],
];
export const kindLabel = (kind) => t((KINDS.find(([name]) => name === kind) || ['', kind])[1]);
export const doubtful = (kind) => kind === 'monte_carlo' || kind === 'sobol';
export const limited = (kind) =>
  kind === 'optimize' || kind === 'pareto' || kind === 'monte_carlo' || kind === 'map';
const INPUTS = { map: 2, sweep: 1 }; // how many inputs a kind varies, where that is given

/** The kinds that the inputs and figures there are suffice for. */
export const possible = (choices) =>
  KINDS.filter(
    ([kind]) =>
      usable(choices).length >= (INPUTS[kind] ?? 1) && choices.figures.length >= (kind === 'pareto' ? 2 : 1),
  );

export const wantedInputs = (kind) => INPUTS[kind] ?? null;

/** A fresh row for an input: bounds a tenth below and above its present value, in its own unit. */
export function row(input) {
  const at = (number) => joined({ number: String(Number(number.toPrecision(4))), unit: input.unit });
  const value = Number(input.value);
  const degrees = input.unit === 'degC' || input.unit === 'degF';
  const [low, high] = degrees ? [value - 5, value + 5] : [0.9 * value, 1.1 * value];
  return {
    name: input.name,
    low: at(low),
    high: at(high),
    mean: joined({ number: input.value, unit: input.unit }),
    spread: degrees ? '1 kelvin' : at(Math.abs(0.05 * value)),
    law: 'normal',
    steps: '21',
  };
}

export const usable = (choices) => choices.inputs.filter((i) => i.value !== '');

export function fresh(choices) {
  const rows = usable(choices).slice(0, 1).map(row);
  return {
    kind: 'sweep',
    rows,
    watched: choices.figures.slice(0, 1).map((f) => f.name),
    samples: '1000',
    sense: 'minimize',
    sense_second: 'maximize',
    second: (choices.figures[1] ?? choices.figures[0])?.name ?? '',
    limits: [],
    cases: [],
    declared: '',
  };
}

/** A set-up of last time, where it still speaks of inputs and figures that exist; else a fresh one. */
export function renewed(stored, choices) {
  const setup = { ...fresh(choices), ...stored };
  const figures = new Set(choices.figures.map((f) => f.name));
  const stands =
    stored &&
    setup.rows.length > 0 &&
    setup.rows.every((r) => usable(choices).some((i) => i.name === r.name)) &&
    [...setup.watched, setup.second, ...setup.limits.map((l) => l.name)].every((name) => figures.has(name)) &&
    (!setup.declared || choices.declared.some((d) => d.name === setup.declared));
  return stands ? setup : fresh(choices);
}

/** A case of a scenario study with the present values. */
export const newCase = (setup, choices) => ({
  name: t('case {number}', { number: setup.cases.length + 1 }),
  values: Object.fromEntries(
    setup.rows.map((r) => {
      const input = choices.inputs.find((i) => i.name === r.name);
      return [r.name, joined({ number: input.value, unit: input.unit })];
    }),
  ),
});

/** A whole number as people type it, its thousands apart or not; anything else goes to the server as it is, which refuses it. */
const whole = (text) =>
  /^\s*(?:\d+|[1-9]\d{0,2}(?:\s\d{3})+)\s*$/.test(text) ? Number(text.replace(/\s/g, '')) : text;

/** How many cases Sobol's design computes for the samples asked. */
export function designed(setup) {
  const asked = Number(whole(setup.samples));
  if (!(asked >= 4)) return null;
  const base = 2 ** Math.ceil(Math.log2(asked));
  return { asked, base, inputs: setup.rows.length, cases: base * (setup.rows.length + 2) };
}

/** The table of the study as a case file would hold it. */
export function table(setup) {
  const { kind, rows, watched, samples, sense, cases } = setup;
  const by = (make) => Object.fromEntries(rows.map((r) => [r.name, make(r)]));
  const given = setup.limits.filter((l) => l.low || l.high);
  const limits =
    limited(kind) && given.length
      ? {
          limits: Object.fromEntries(
            given.map((l) => [l.name, { ...(l.low && { lower: l.low }), ...(l.high && { upper: l.high }) }]),
          ),
        }
      : {};
  const between = by((r) => ({ lower: r.low, upper: r.high }));
  if (kind === 'sweep' || kind === 'map')
    return {
      kind,
      outputs: watched,
      over: by((r) => ({ from: r.low, to: r.high, steps: whole(r.steps) })),
      ...limits,
    };
  if (kind === 'scenarios')
    return {
      kind,
      outputs: watched,
      cases: Object.fromEntries(
        cases.map((c) => [
          c.name,
          Object.fromEntries(rows.map((r) => [r.name, c.values[r.name]]).filter(([, text]) => text)),
        ]),
      ),
    };
  if (kind === 'optimize') return { kind, [sense]: watched[0], over: between, ...limits };
  if (kind === 'pareto')
    return {
      kind,
      objectives: [{ [sense]: watched[0] }, { [setup.sense_second]: setup.second }],
      over: between,
      ...limits,
    };
  const uncertain = by((r) =>
    r.law === 'uniform'
      ? { distribution: 'uniform', lower: r.low, upper: r.high }
      : { distribution: 'normal', mean: r.mean, standard_deviation: r.spread },
  );
  return { kind, outputs: watched, samples: whole(samples), uncertain, ...limits };
}

const listed = (texts) =>
  texts.length < 2 ? texts.join('') : `${texts.slice(0, -1).join(', ')} ${t('and')} ${texts.at(-1)}`;

/** The question in words, to stand above its answer. */
export function question(setup, choices) {
  const one = choices.declared.find((d) => d.name === setup.declared);
  if (one) return { kind: kindLabel(one.kind), title: one.title, rows: [] };
  const figure = (name) => choices.figures.find((f) => f.name === name);
  const written = (text, quantity) => {
    const { number, unit } = split(text);
    return `${inLanguage(number)} ${quantity.units?.find((u) => u.unit === unit)?.label ?? unit}`.trim();
  };
  const normal = (r) => doubtful(setup.kind) && r.law === 'normal';
  const range = (r) => {
    const { label, quantity, spread } = choices.inputs.find((i) => i.name === r.name);
    const alike = split(r.mean).unit === split(r.spread).unit; // 85 ± 4 µm
    return normal(r)
      ? t('{input} is {mean} ± {spread}', {
          input: label,
          mean: alike ? inLanguage(split(r.mean).number) : written(r.mean, quantity),
          spread: written(r.spread, spread),
        })
      : t('{input} lies between {low} and {high}', {
          input: label,
          low: written(r.low, quantity),
          high: written(r.high, quantity),
        });
  };
  const bounds = limited(setup.kind)
    ? setup.limits
        .filter((l) => l.low || l.high)
        .map(
          (l) =>
            `${figure(l.name).label}${colon()} ${[l.low && `${t('at least')} ${written(l.low, figure(l.name).quantity)}`, l.high && `${t('at most')} ${written(l.high, figure(l.name).quantity)}`].filter(Boolean).join(', ')}`,
        )
    : [];
  const watched = setup.watched.map((name) => figure(name).label);
  const best = (sense, name) =>
    t(sense === 'minimize' ? 'the smallest {figure}' : 'the largest {figure}', {
      figure: figure(name).label,
    });
  const figures =
    setup.kind === 'optimize'
      ? best(setup.sense, setup.watched[0])
      : setup.kind === 'pareto'
        ? listed([best(setup.sense, setup.watched[0]), best(setup.sense_second, setup.second)])
        : listed(watched);
  const design = setup.kind === 'sobol' && designed(setup);
  const count = !design && doubtful(setup.kind) ? whole(setup.samples) : null;
  const title =
    setup.kind === 'scenarios'
      ? t('{figures} in {cases}', { figures, cases: listed(setup.cases.map((c) => c.name)) })
      : t('{figures} when {inputs}', { figures, inputs: listed(setup.rows.map(range)) });
  return {
    kind: kindLabel(setup.kind),
    title: title[0].toUpperCase() + title.slice(1),
    rows: [
      ...bounds,
      ...(count ? [t('{count} cases', { count })] : []),
      ...(design ? [explained(design)] : []),
    ],
  };
}

/** Why Sobol's design computes more cases than were asked for. */
export const explained = (design) =>
  design.inputs === 1
    ? t('{cases} cases for {asked} samples: the next power of two, {base}, three times.', design)
    : t(
        '{cases} cases for {asked} samples: the next power of two, {base}, for each of {inputs} inputs and twice more.',
        design,
      );
