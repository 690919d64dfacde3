// What the theme leaves out for readers who use a keyboard or hear the page.
document.querySelectorAll('[role=dialog]:not([aria-label])').forEach((place) => place.setAttribute('aria-label', 'Search'));
const heard = new Set();
document.querySelectorAll('nav').forEach((nav) => {
  const name = nav.getAttribute('aria-label') || document.getElementById(nav.getAttribute('aria-labelledby'))?.textContent.trim() || '';
  if (heard.has(name)) { nav.removeAttribute('aria-labelledby'); nav.setAttribute('aria-label', `${name || 'Pages'} ${heard.size}`); }
  heard.add(name);
});
document.querySelectorAll('pre > code, .equation').forEach((place) => { place.tabIndex = 0; });

// Draws the plots of a page; Plotly is fetched from this site, and only where a page has a plot.
const places = [...document.querySelectorAll('.plot')];
if (places.length) {
  const script = document.createElement('script');
  script.src = new URL('plotly.min.js', document.currentScript?.src || document.querySelector('script[src$="plots.js"]').src).href;
  script.onload = () => places.forEach((place) => {
    const { data, layout } = JSON.parse(place.querySelector('script').textContent);
    const narrow = place.clientWidth < 560;
    const legend = narrow || data.filter((t) => t.name && t.showlegend !== false).length > 6 ? { ...layout.legend, orientation: 'h', x: 0, xanchor: 'left', y: -0.2, yanchor: 'top' } : layout.legend;
    window.Plotly.newPlot(place, data, { ...layout, legend, autosize: true }, { responsive: true, displaylogo: false, displayModeBar: false });
  });
  document.head.append(script);
}
