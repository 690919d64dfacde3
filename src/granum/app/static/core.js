// State in the link, language, theme, requests: shared by every page.
import { h, html, render, useState, useEffect, useRef, useMemo, useCallback } from './vendor/htm-preact.js';
import { english, french } from './strings.fr.js';

export { h, html, render, useState, useEffect, useRef, useMemo, useCallback };

// ---- state in the link: #/page/key?name=value&… ----------------------------------------------------
let links = 0;
export function readLink() {
  const [path, query = ''] = location.hash.replace(/^#\/?/, '').split('?');
  const [page = 'calculate', ...rest] = path.split('/').map(decodeURIComponent);
  return { page: page || 'calculate', key: rest.join('/'), values: Object.fromEntries(new URLSearchParams(query)), visit: ++links };
}

export function link(page, key = '', values = {}) {
  const kept = Object.entries(values).filter(([, value]) => value !== '' && value !== undefined && value !== null);
  const query = new URLSearchParams(kept).toString();
  return `#/${page}${key ? '/' + encodeURIComponent(key) : ''}${query ? '?' + query : ''}`;
}

export function replaceLink(page, key, values) {
  history.replaceState(null, '', link(page, key, values));
}

// ---- language and theme ---------------------------------------------------------------------------
const store = (name, fallback) => { try { return localStorage.getItem(name) || fallback; } catch { return fallback; } };
export const settings = {
  language: new URLSearchParams(location.search).get('lang') || store('granum-language', navigator.language.startsWith('fr') ? 'fr' : 'en'),
  units: store('granum-units', 'si'),
  theme: store('granum-theme', matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light'),
};
export function keep(name, value) {
  settings[name] = value;
  try { localStorage.setItem('granum-' + name, value); } catch { /* private window: the choice lasts for the page */ }
  apply();
}
export function apply() {
  document.documentElement.lang = settings.language;
  document.documentElement.dataset.theme = settings.theme;
}

export function t(text, values = {}) {
  const found = (settings.language === 'fr' ? french[text] : english[text]) || text;
  return found.replace(/\{(\w+)\}/g, (whole, name) => (name in values ? values[name] : whole));
}

export function number(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return '—';
  if (value === 0) return '0';
  const size = Math.floor(Math.log10(Math.abs(value)));
  let text;
  if (size >= -4 && size < 5) text = String(Number(value.toPrecision(digits)));
  else {
    const [mantissa, power] = value.toExponential(digits - 1).split('e');
    text = `${Number(mantissa)} × 10${String(Number(power)).replace(/[-0-9]/g, (c) => '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.indexOf(c)])}`;
  }
  return settings.language === 'fr' ? text.replace('.', ',') : text;
}

// ---- requests -------------------------------------------------------------------------------------
export async function ask(path, body, options = {}) {
  const form = body instanceof FormData;
  const response = await fetch(path, {
    method: options.method || (body === undefined ? 'GET' : 'POST'),
    headers: { 'x-language': settings.language, 'x-units': settings.units, ...(form || body === undefined ? {} : { 'content-type': 'application/json' }) },
    body: body === undefined ? undefined : form ? body : JSON.stringify(body),
    signal: options.signal,
  });
  if (options.text && response.ok) return response.text();
  const data = await response.json();
  if (!response.ok) throw Object.assign(new Error(data.error?.message || t('The server did not understand the request.')), { details: data.error });
  return data;
}

/** The latest answer to a request that changes with every key stroke; older answers are dropped, the last one stays visible. */
export function useAnswer(make, dependencies, wait = 60) {
  const [state, setState] = useState({ data: null, error: null, pending: false });
  useEffect(() => {
    const stop = new AbortController();
    setState((s) => ({ ...s, pending: true }));
    const timer = setTimeout(async () => {
      try {
        const data = await make(stop.signal);
        if (!stop.signal.aborted) setState({ data, error: null, pending: false });
      } catch (error) {
        if (!stop.signal.aborted) setState((s) => ({ data: s.data, error, pending: false }));
      }
    }, wait);
    return () => { stop.abort(); clearTimeout(timer); };
  }, dependencies);
  return state;
}

// ---- charts ---------------------------------------------------------------------------------------
let plotly = null;
export function loadPlotly() {
  plotly ||= new Promise((done, failed) => {
    const script = document.createElement('script');
    script.src = '/vendor/plotly.js';
    script.onload = () => done(window.Plotly);
    script.onerror = failed;
    document.head.append(script);
  });
  return plotly;
}

/** The layout for a place on the page: the page carries the title; a narrow place gets the legend under the plot. */
function fitted({ layout, data }, width) {
  const count = data.filter((trace) => trace.name && trace.showlegend !== false).length;
  const narrow = width < 560;
  const margin = { ...layout.margin, t: 36, ...(narrow ? { l: 56, r: 12 } : {}) };
  const legend = narrow ? { ...layout.legend, orientation: 'h', x: 0, xanchor: 'left', y: -0.22, yanchor: 'top', font: { size: 11 } } : layout.legend;
  const table = narrow && data.some((trace) => trace.type === 'table');
  const axes = narrow ? { xaxis: { ...layout.xaxis, dtick: undefined, tickangle: 0 }, ...(count > 8 ? { showlegend: false } : {}) } : {};
  return { ...layout, title: undefined, width: undefined, autosize: true, ...(table ? { height: (layout.height || 450) + 220 } : {}), margin, legend, ...axes };
}

export function Plot({ figure, label, onPoint }) {
  const clicked = useRef(null);
  clicked.current = onPoint;
  const place = useRef(null);
  useEffect(() => {
    let alive = true;
    loadPlotly().then((Plotly) => {
      if (alive && place.current && figure) {
        Plotly.react(place.current, figure.data, fitted(figure, place.current.clientWidth), {
          responsive: true, displaylogo: false, displayModeBar: true, modeBarButtonsToRemove: ['select2d', 'lasso2d', 'autoScale2d'],
          toImageButtonOptions: { format: 'svg', filename: 'granum' },
        });
        place.current.removeAllListeners?.('plotly_click');
        place.current.on('plotly_click', (event) => {
          const edge = place.current.getBoundingClientRect();
          const { xaxis, yaxis } = place.current._fullLayout;
          clicked.current?.(xaxis.p2d(event.event.clientX - edge.left - xaxis._offset), yaxis.p2d(event.event.clientY - edge.top - yaxis._offset));
        });
      }
    });
    return () => { alive = false; };
  }, [figure]);
  return html`<div class="plot" ref=${place} role="group" aria-label=${label || t('Chart')}></div>`;
}
