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
