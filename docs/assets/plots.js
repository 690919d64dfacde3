// What the theme leaves out for readers who use a keyboard or hear the page.
document.querySelectorAll('[role=dialog]:not([aria-label])').forEach((place) => place.setAttribute('aria-label', 'Search'));
const heard = new Set();
document.querySelectorAll('nav').forEach((nav) => {
  const name = nav.getAttribute('aria-label') || document.getElementById(nav.getAttribute('aria-labelledby'))?.textContent.trim() || '';
  if (heard.has(name)) { nav.removeAttribute('aria-labelledby'); nav.setAttribute('aria-label', `${name || 'Pages'} ${heard.size}`); }
  heard.add(name);
});
document.querySelectorAll('pre > code, .equation').forEach((place) => { place.tabIndex = 0; });
// The switch of the colors is two radio buttons, each beside the hidden label of the other, with the name of the other.
const colors = document.querySelector('form[data-md-component=palette]');
if (colors) {
  const group = document.createElement('div');
  group.setAttribute('role', 'radiogroup');
  group.setAttribute('aria-label', 'Colors');
  group.append(...colors.childNodes);
  colors.append(group);
  const buttons = [...colors.querySelectorAll('input')];
  const names = buttons.map((button) => button.getAttribute('aria-label'));
  buttons.forEach((button, i) => {
    const other = (i + 1) % buttons.length;
    button.setAttribute('aria-label', names[other]);
    const label = button.nextElementSibling;
    label.removeAttribute('for');
    label.addEventListener('click', () => buttons[other].click());
  });
}

/** What Plotly draws in a place: its legend goes below where the place is narrow, the names are many, or change as they move. */
function drawn(place, { data, layout }) {
  const narrow = place.clientWidth < 560;
  const below = narrow || place.closest('.moving') || data.filter((t) => t.name && t.showlegend !== false).length > 6;
  const legend = below ? { ...layout.legend, orientation: 'h', x: 0, xanchor: 'left', y: -0.2, yanchor: 'top' } : layout.legend;
  const margin = narrow ? { ...layout.margin, l: 50, r: 8 } : layout.margin;
  const yaxis = { ...layout.yaxis, automargin: true }; // a long title would stand on the numbers
  return [place, data, { ...layout, yaxis, legend, margin, autosize: true }, { responsive: true, displaylogo: false, displayModeBar: false }];
}

/** The sliders of a figure that moves, above it; each takes it to what was drawn for their positions. */
function slide(place, { sliders, frames, data, layout }) {
  const at = sliders.map((slider) => slider.at);
  const show = () => {
    const frame = frames[sliders.reduce((sum, slider, i) => sum * slider.positions.length + at[i], 0)];
    const moved = { data: data.map((trace, i) => ({ ...trace, ...frame.data[i] })), layout: { ...layout, ...frame.layout } };
    window.Plotly.react(...drawn(place, moved));
  };
  const row = document.createElement('div');
  row.className = 'sliders';
  sliders.forEach((slider, i) => {
    const label = document.createElement('label');
    const name = document.createElement('span');
    name.innerHTML = slider.label;
    const value = document.createElement('output');
    const range = document.createElement('input');
    Object.assign(range, { type: 'range', min: 0, max: slider.positions.length - 1, step: 1, value: slider.at });
    const said = () => {
      value.textContent = slider.shown[at[i]];
      range.setAttribute('aria-valuetext', slider.shown[at[i]]);
    };
    range.addEventListener('input', () => { at[i] = Number(range.value); said(); show(); });
    said();
    label.append(name, value, range);
    row.append(label);
  });
  place.before(row);
  place.setAttribute('aria-label', `${layout.yaxis.title.text}; ${layout.xaxis.title.text}`.replace(/<[^>]*>/g, ''));
}

// Draws the plots of a page; Plotly is fetched from this site, and only where a page has a plot.
const places = [...document.querySelectorAll('.plot')];
if (places.length) {
  const script = document.createElement('script');
  script.src = new URL('plotly.min.js', document.currentScript?.src || document.querySelector('script[src$="plots.js"]').src).href;
  script.onload = () => places.forEach((place) => {
    const figure = JSON.parse(place.querySelector('script').textContent);
    if (figure.frames) slide(place, figure);
    window.Plotly.newPlot(...drawn(place, figure));
    document.getElementById('js-plotly-tester')?.setAttribute('aria-hidden', 'true'); // with which it measures letters
  });
  document.head.append(script);
}
