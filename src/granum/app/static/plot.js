// A chart of Plotly on the page: in the colors of the theme, readable when narrow and on paper, with its files and its numbers.
import { html, t, download, settings, useState, useEffect, useRef } from './core.js';

const NARROW = 560; // px
let plotly = null;
function loadPlotly() {
  plotly ||= new Promise((done, failed) => {
    const script = document.createElement('script');
    script.src = '/vendor/plotly.js';
    script.onload = () => {
      window.Plotly.register(french());
      done(window.Plotly);
    };
    script.onerror = failed;
    document.head.append(script);
  });
  return plotly;
}

/** What the buttons of a chart are called in French. */
const french = () => ({
  moduleType: 'locale',
  name: 'fr',
  dictionary: Object.fromEntries(
    ['Zoom', 'Pan', 'Zoom in', 'Zoom out', 'Reset axes', 'Double-click to zoom back out'].map((text) => [
      text,
      t(text),
    ]),
  ),
  format: { decimal: ',', thousands: '\u202f' },
});

/** Colors of light charts, and what takes their place on a dark page. */
const DARK = {
  white: '#1a2129',
  '#ffffff': '#1a2129',
  '#1c2430': '#e6e9ee',
  '#e6e9ee': '#343e4a',
  '#d9dde3': '#343e4a',
  '#eef2f2': '#26303a',
  '#8a94a3': '#9aa6b4',
  '#0b6e6e': '#4fb3ae',
  '#2b6cb0': '#6ba6e0',
  '#6b7f99': '#9db0c6',
  '#c2410c': '#ee8a5c',
  '#b91c1c': '#f08a8a',
  '#b45309': '#eaa15b',
  '#2f855a': '#6cc497',
  '#b7791f': '#d9a24b',
  '#6b46c1': '#a78bee',
  '#97266d': '#de7fb9',
  '#2c5282': '#7aa5dd',
  'rgba(11,110,110,0.08)': 'rgba(79,179,174,0.16)',
  'rgba(183,121,31,0.45)': 'rgba(217,162,75,0.5)',
  'rgba(43,108,176,0.45)': 'rgba(107,166,224,0.5)',
  'rgba(107,127,153,0.45)': 'rgba(157,176,198,0.5)',
  'rgba(194,65,12,0.45)': 'rgba(238,138,92,0.5)',
  'rgba(255,255,255,0.8)': 'rgba(26,33,41,0.8)',
  'rgba(255,255,255,0.85)': 'rgba(26,33,41,0.85)',
};
const dark = (part) =>
  typeof part === 'string'
    ? (DARK[part.toLowerCase()] ?? part)
    : Array.isArray(part)
      ? part.map(dark)
      : part && typeof part === 'object' && !ArrayBuffer.isView(part)
        ? Object.fromEntries(Object.entries(part).map(([key, value]) => [key, dark(value)]))
        : part;
const PAGE = { paper_bgcolor: 'white', plot_bgcolor: 'white', font: { color: '#1c2430' } };
const GRID = { gridcolor: '#e6e9ee', linecolor: '#1c2430', zerolinecolor: '#d9dde3' };

/** A figure in the colors of the page. */
function colored({ data, layout }) {
  const whole = {
    data,
    layout: {
      ...PAGE,
      ...layout,
      font: { ...PAGE.font, ...layout.font },
      ...Object.fromEntries(
        Object.entries(layout)
          .filter(([name]) => /^[xy]axis\d*$/.test(name))
          .map(([name, axis]) => [name, layout.template ? axis : { ...GRID, ...axis }]),
      ),
    },
  };
  return settings.theme === 'dark' && !printing ? dark(whole) : whole;
}

const UNSIZED = 450; // px high, where a chart does not say
let printing = false;
const PAPER = { width: 640, height: 560 }; // px of a chart on A4, at most so high that what was entered stands above it
const drawn = new Set(); // charts on the page, each with the way to draw it anew
for (const [event, now] of [
  ['beforeprint', true],
  ['afterprint', false],
])
  addEventListener(event, () => {
    printing = now;
    drawn.forEach((draw) => draw(true)); // at once: the browser does not wait
  });

/** A chart without the tables in it, which the page shows under it: their room goes to the axes. */
function untabled({ data, layout }) {
  const table = data.find((trace) => trace.type === 'table');
  if (!table) return { data, layout };
  const taken = 50 + 25 * table.cells.values[0].length;
  return {
    data: data.filter((trace) => trace.type !== 'table'),
    layout: {
      ...layout,
      height: (layout.height || UNSIZED) - taken,
      yaxis: { ...layout.yaxis, domain: [0, 1] },
    },
  };
}

/** The head of a column; that of the numbers of the rows, empty in a drawing, is told to those who listen. */
export const headed = (head) => (bare(head).trim() ? head : `<span class="hidden">${t('number')}</span>`);

/** A table of a chart as one of the page. */
function Tabled({ trace, label }) {
  const [heads, columns] = [trace.header.values, trace.cells.values];
  return html`<div class="wide" tabindex="0" role="region" aria-label=${label}><table class="small" aria-label=${label}><thead><tr>${heads.map((head) => html`<th scope="col" class="n" dangerouslySetInnerHTML=${{ __html: headed(head) }} />`)}</tr></thead><tbody>${columns[0].map((_, i) => html`<tr>${columns.map((column) => html`<td class="n">${column[i]}</td>`)}</tr>`)}</tbody></table></div>`;
}

const bare = (text) => text.replace(/<[^>]*>/g, '');

/** An axis with its title in lines as short as the axis. */
function titled(axis, room) {
  const text = axis?.title?.text?.replaceAll('<br>', ' '); // no line beside the break of another
  const length = text ? bare(text).length : 0;
  if (length * 7.5 < room) return axis;
  const spaces = [...text.matchAll(/ (?=<i>|\/ |\(|\S)/g)].map((found) => found.index);
  const free = spaces.filter((at) => (text.slice(0, at).match(/</g) ?? []).length % 2 === 0); // in no tag
  const lines = length * 7.5 > 2 * room ? 3 : 2;
  const before = (at) => bare(text.slice(0, at)).length;
  const nearest = (wanted) => free.toSorted((a, b) => Math.abs(before(a) - wanted) - Math.abs(before(b) - wanted))[0];
  const breaks = [1, 2].slice(0, lines - 1).map((line) => nearest((line * length) / lines));
  const broken = text.split('').map((letter, at) => (breaks.includes(at) ? '<br>' : letter)).join('');
  return { ...axis, automargin: true, title: { ...axis.title, text: broken } };
}

/** Long names of bars in lines of a few words each: the room goes to the bars. */
function foldedNames(data) {
  const names = [...new Set(data.flatMap((trace) => trace.y))];
  const ticktext = names.map((name) => String(name).replace(/(\S.{9,}?) (?=\S{3})/g, '$1<br>'));
  return { tickmode: 'array', tickvals: names, ticktext };
}

/** The layout for a place on the page: the page carries the title; a narrow place gets the legend under the plot. */
function fitted({ layout, data }, width) {
  const count = data.filter((trace) => trace.name && trace.showlegend !== false).length;
  const narrow = width < NARROW;
  const height = (layout.height || UNSIZED) - 110;
  const right = layout.yaxis?.side === 'right';
  const margin = { ...layout.margin, t: 12, ...(narrow ? { l: right ? 20 : 56, r: right ? 62 : 12 } : {}) };
  const along = narrow ? titled(layout.xaxis, width - margin.l - margin.r) : layout.xaxis;
  const lines = along?.title?.text?.split('<br>').length ?? 1;
  const own = layout.legend && ['x', 'y', 'orientation'].some((part) => layout.legend[part] !== undefined);
  const above = !narrow && !own && count > 1 && count <= 6 && layout.showlegend !== false;
  const corner = layout.ternary ? 44 : 0; // room for the names at the corners of a triangle
  if (above || corner) margin.t = corner + (above ? 34 : 0);
  if (corner) margin.l = margin.r = narrow ? 60 : 100;
  const legend = narrow
    ? {
        ...layout.legend,
        orientation: 'h',
        x: 0,
        xanchor: 'left',
        y: -(55 + 20 * lines) / height, // below the title of the axis, however low the chart is
        yanchor: 'top',
        font: { size: 11 },
      }
    : above
      ? { ...layout.legend, orientation: 'h', x: 0, xanchor: 'left', y: 1.01 + corner / height, yanchor: 'bottom' } // over the plot, on nothing
      : layout.legend;
  const axes = narrow
    ? {
        xaxis: { ...along, dtick: undefined, nticks: 6, tickangle: 0 },
        ...(count > 8 ? { showlegend: false } : {}),
      }
    : {};
  const upward = Object.fromEntries(
    Object.entries({ ...layout, ...axes })
      .filter(([part]) => /^yaxis\d*$/.test(part))
      .map(([part, axis]) => {
        const [low, high] = axis.domain ?? [0, 1];
        return [
          part,
          titled({ ...axis, ...(narrow && !right && { automargin: true }) }, (high - low) * height),
        ];
      }),
  );
  if (narrow && layout.yaxis?.type === 'category')
    upward.yaxis = { ...upward.yaxis, ...foldedNames(data) };
  return {
    ...layout,
    title: undefined,
    width: undefined,
    autosize: true,
    margin,
    legend,
    ...axes,
    ...upward,
  };
}

const axisText = (axis, fallback) => (axis?.title?.text ?? '').replaceAll('<br>', ' ').replace(/<[^>]*>/g, '').trim() || fallback;

const TYPES = {
  f8: Float64Array,
  f4: Float32Array,
  i4: Int32Array,
  i2: Int16Array,
  i1: Int8Array,
  u1: Uint8Array,
};
/** Numbers of a trace, which Plotly may have packed in base 64. */
export const decoded = (values) =>
  values?.bdata
    ? [...new TYPES[values.dtype](Uint8Array.from(atob(values.bdata), (c) => c.charCodeAt(0)).buffer)]
    : values;

/** The numbers of a chart: a row for each point, with the curve it lies on. */
function numbers({ data, layout }) {
  if (data[0]?.type === 'sankey') return widths(data[0]);
  if (layout.ternary) return shares(data, layout.ternary);
  const x = axisText(layout.xaxis, 'x');
  const y = axisText(layout.yaxis, 'y');
  const flat = (values) => Array.isArray(values) && values.every((v) => !Array.isArray(v));
  const rows = data
    .filter(
      (trace) => trace.hoverinfo !== 'skip' && trace.visible !== 'legendonly' && trace.visible !== false,
    )
    .map(({ name = '', x, y, z }) => ({ name, x: decoded(x), y: decoded(y), z: decoded(z)?.flat() }))
    .filter((trace) => flat(trace.x) && flat(trace.y))
    .flatMap(({ name, x, y, z }) =>
      z
        ? z.map((level, i) => [`${name} = ${shown(level)}`, x[i % x.length], y[Math.floor(i / x.length)]])
        : x.map((at, i) => [name, at, y[i]]),
    )
    .filter(([, at, value]) => at !== null && value !== null && value !== undefined);
  return { heads: [t('Curve'), x, y], rows };
}

/** The numbers of a triangle: the shares of all three at each point. */
function shares(data, axes) {
  const parts = ['a', 'b', 'c'];
  const rows = data
    .filter((trace) => trace.hoverinfo !== 'skip')
    .flatMap((trace) => {
      const [a, ...others] = parts.map((part) => decoded(trace[part]));
      return a.map((share, i) => [trace.name ?? '', share, ...others.map((values) => values[i])]);
    });
  const told = ([, ...values]) => values.every((value) => value !== null && value !== undefined);
  return { heads: [t('Curve'), ...parts.map((part) => `${axes[`${part}axis`]?.title?.text ?? part} / %`)], rows: rows.filter(told) };
}

/** The numbers of a Sankey diagram: what flows from where to where. */
function widths({ node, link, valuesuffix }) {
  const [from, to, values] = [link.source, link.target, link.value].map(decoded);
  const rows = values.map((value, i) => [link.label?.[i] ?? '', node.label[from[i]], node.label[to[i]], value]);
  return { heads: [t('flow'), t('from'), t('to'), (valuesuffix ?? '').trim()], rows };
}

const quoted = (cell) => (/[",\n]/.test(String(cell)) ? `"${String(cell).replaceAll('"', '""')}"` : cell);
const shown = (cell) =>
  typeof cell === 'number'
    ? new Intl.NumberFormat(settings.language, {
        maximumSignificantDigits: 5,
        ...(cell !== 0 && (Math.abs(cell) >= 1e6 || Math.abs(cell) < 1e-4) && { notation: 'scientific' }),
      }).format(cell)
    : cell;

/** What a chart can be taken away as, and its numbers to read. */
function Files({ figure, place, name, label }) {
  const [open, setOpen] = useState(false);
  const table = numbers(figure);
  const image = async (format) =>
    (await loadPlotly()).downloadImage(place.current, {
      format,
      filename: name,
      width: 900,
      height: Math.round((900 * place.current.clientHeight) / place.current.clientWidth),
      ...(format === 'png' && { scale: 2 }),
    });
  const save = () =>
    download(
      `${name}.csv`,
      [table.heads, ...table.rows].map((row) => row.map(quoted).join(',')).join('\n') + '\n',
      'text/csv',
    );
  return html`<div class="row small files"><span class="dim">${t('Save the chart as')}</span>${['SVG', 'PNG'].map((format) => html`<button class="button" onClick=${() => image(format.toLowerCase())}>${format}</button>`)}
    ${table.rows.length > 0 && html`<button class="button" onClick=${save}>CSV</button>`}</div>
    ${
      table.rows.length > 0 &&
      html`<details class="small" onToggle=${(e) => setOpen(e.target.open)}><summary>${t('Numbers of the chart')}</summary>${open && html`<div class="wide tall" tabindex="0" role="region" aria-label=${t('Numbers of the chart')}><table aria-label=${label}><thead><tr>${table.heads.map((head, i) => html`<th scope="col" class=${i ? 'n' : ''}>${head}</th>`)}</tr></thead><tbody>${table.rows.slice(0, MOST_ROWS).map((row) => html`<tr>${row.map((cell, i) => html`<td class=${i ? 'n' : ''}>${shown(cell)}</td>`)}</tr>`)}</tbody></table>${table.rows.length > MOST_ROWS && html`<p class="dim">${t('The first {count} rows; the file has all of them.', { count: MOST_ROWS })}</p>`}</div>`}</details>`
    }`;
}
const MOST_ROWS = 500;

/** `files`: whether what the chart can be taken away as stands below it; where its numbers stand beside it anyway, not. */
export function Plot({ figure, label, onPoint, onMark, files = true, tables = true, name = 'granum' }) {
  const clicked = useRef(null);
  clicked.current = onPoint;
  const marked = useRef(null);
  marked.current = onMark;
  const place = useRef(null);
  const [theme, setTheme] = useState(0);
  useEffect(() => {
    const changed = () => setTheme((count) => count + 1);
    addEventListener('granum-theme', changed);
    return () => removeEventListener('granum-theme', changed);
  }, []);
  useEffect(() => {
    let alive = true;
    const draw = (anew) => {
      if (!alive || !place.current || !figure || !window.Plotly) return;
      if (anew) window.Plotly.purge(place.current); // a width once given would stay
      const width = printing ? PAPER.width : place.current.clientWidth;
      const shown = colored(untabled(figure));
      const layout = fitted(shown, width);
      if (printing)
        Object.assign(layout, PAPER, { height: Math.min(layout.height ?? UNSIZED, PAPER.height) });
      place.current.style.height = `${layout.height ?? UNSIZED}px`; // without it a chart drawn twice falls flat when the window changes
      window.Plotly.react(place.current, shown.data, layout, {
        responsive: true,
        displaylogo: false,
        showSendToCloud: false,
        plotlyServerURL: '',
        locale: settings.language,
        modeBarButtonsToRemove: ['toImage', 'select2d', 'lasso2d', 'autoScale2d'],
      });
      place.current.removeAllListeners?.('plotly_click');
      place.current.on('plotly_click', (event) => {
        marked.current?.(event.points[0]);
        const edge = place.current.getBoundingClientRect();
        const { xaxis, yaxis } = place.current._fullLayout;
        clicked.current?.(
          xaxis.p2d(event.event.clientX - edge.left - xaxis._offset),
          yaxis.p2d(event.event.clientY - edge.top - yaxis._offset),
        );
      });
    };
    drawn.add(draw);
    loadPlotly().then(() => draw());
    return () => {
      alive = false;
      drawn.delete(draw);
    };
  }, [figure, theme]);
  return html`<div class="drawn"><div class="plot" ref=${place} role="group" aria-label=${label || t('Chart')}></div></div>${tables && figure?.data.filter((trace) => trace.type === 'table').map((trace) => html`<${Tabled} trace=${trace} label=${label} />`)}${files && figure && html`<${Files} figure=${figure} place=${place} name=${name} label=${label} />`}`;
}
