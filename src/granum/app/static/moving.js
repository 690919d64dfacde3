// A figure of the handbook with its sliders: any value is asked from the server.
import { html, t, ask, useAnswer, useState, settings } from './core.js';
import { Plot } from './plot.js';
import { printed } from './quantity.js';

/** Where a slider of 1000 steps stands, and the value there. */
const STEPS = 1000;
const value = ({ low, high, log }, step) =>
  Number((log ? low * (high / low) ** (step / STEPS) : low + ((high - low) * step) / STEPS).toPrecision(4));
const step = ({ low, high, log }, at) =>
  Math.round(STEPS * (log ? Math.log(at / low) / Math.log(high / low) : (at - low) / (high - low)));

/** A number as the figures of the documentation have it: 0, −15 or 3 × 10⁻¹⁰. */
const written = (number) => {
  const far = number !== 0 && (Math.abs(number) >= 1e5 || Math.abs(number) < 1e-4);
  const style = { maximumSignificantDigits: 3, ...(far && { notation: 'scientific' }) };
  const text = new Intl.NumberFormat(settings.language, style).format(number);
  return printed(text.toLowerCase()).replace(/^-/, '−');
};

export function Moving({ name }) {
  const [values, setValues] = useState({});
  const { data, error } = useAnswer(
    (signal) => ask(`/api/figures/${name}`, { values }, { signal }),
    [name, JSON.stringify(values), settings.language],
    40,
  );
  if (error && !data) return html`<p class="message out">${error.message}</p>`;
  if (!data) return html`<p class="dim">${t('The figure is on its way…')}</p>`;
  const { sliders, figure } = data;
  const [x, y] = [figure.layout.xaxis, figure.layout.yaxis].map((axis) => axis.title.text.replace(/<[^>]*>/g, ''));
  return html`<div class="moving-figure"><div class="moving-sliders">${sliders.map((slider) => {
    const at = values[slider.name] ?? slider.start;
    const shown = written(at);
    return html`<label><span dangerouslySetInnerHTML=${{ __html: slider.label }} /><output>${shown}</output>
      <input type="range" name=${slider.name} min="0" max=${STEPS} step="5" value=${step(slider, at)} aria-valuetext=${shown} onInput=${(e) => setValues({ ...values, [slider.name]: value(slider, Number(e.target.value)) })} /></label>`;
  })}</div><${Plot} figure=${figure} label=${`${y}; ${x}`} name=${name} files=${false} /></div>`;
}
