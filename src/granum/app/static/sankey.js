// What flows through a solved line: mass, energy or one component, as a diagram of widths.
import { html, t, useState } from './core.js';
import { Plot } from './plot.js';

export function Sankey({ diagrams }) {
  const [open, setOpen] = useState(false);
  const [chosen, setChosen] = useState('mass');
  if (!diagrams?.length) return null;
  const shown = diagrams.find((d) => d.name === chosen) ?? diagrams[0];
  return html`<details class="sankey" data-sankey onToggle=${(e) => setOpen(e.target.open)}><summary>${t('Sankey diagram')}</summary>
    ${
      open &&
      html`<p class="row small"><label>${t('Show')} <select value=${shown.name} onChange=${(e) => setChosen(e.target.value)}>${diagrams.map((d) => html`<option value=${d.name}>${d.label}</option>`)}</select></label></p>
      <div class="wide" tabindex="0" role="region" aria-label=${shown.title}><${Plot} key=${shown.name} figure=${shown.figure} label=${shown.title} name=${`granum-${shown.name}`} /></div>
      <p class="small dim">${t('Solid, liquid and gas have their colors; heat and work are red.')} ${shown.name === 'energy' && t('Energy counts from liquid water and dry substances at 25 °C, so that vapor carries its heat of vaporization; what is colder is drawn the other way.')}</p>`
    }</details>`;
}
