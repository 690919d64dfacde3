// What is chosen in the diagram: a piece of equipment with its connections, parameters and figures, a stream, or a feed.
import { html, t, useState, useEffect, useRef } from './core.js';
import { EndMenu, FeedForm, ItemForm, pretty } from './line_forms.js';
import { UnitFigures } from './line_outcome.js';
import { StreamPanel } from './line_streams.js';

export function Panel({ chosen, choose, form, data, cases, old, typedIn, build, size, refused }) {
  const { sort, name } = chosen;
  const panel = useRef(null);
  useEffect(() => {
    if (chosen.port)
      panel.current?.querySelector(`[data-port="${chosen.port.split('.')[1]}"] select`)?.focus();
  }, [chosen]);
  const unit = sort === 'unit' && form.units[name];
  const feed = sort === 'stream' && form.feeds[name];
  const stream = sort === 'stream' && data?.streams[name];
  if (!unit && !feed && !stream) return null;
  const solved = unit && data?.units[name];
  const wrong = refused?.unit === name ? refused : null;
  return html`<section class="card panel" ref=${panel} data-panel=${name} aria-label=${pretty(name)}><div class="row spread"><h2 class="first">${pretty(name)} <span class="dim">${unit ? unit.title || unit.model : ''}</span></h2><div class="row">
    ${
      (unit || feed || stream) &&
      html`<${Rename} key=${name} name=${name} rename=${async (next) => {
        const made = await build('rename', { old: name, new: next });
        if (made) choose({ sort, name: made });
      }} />`
    }
    ${unit && unit.outlets.length > 0 && !unit.joins && html`<button class="button" title=${t('Lead a part of what enters around it')} onClick=${() => build('bypass', { unit: name })}>${t('Bypass')}</button>`}
    ${unit && unit.inlets.some((i) => i.port === 'wash' && !i.from) && html`<button class="button" onClick=${() => build('add_wash', { unit: name })}>${t('Add wash liquor')}</button>`}
    ${
      (unit || feed) &&
      html`<button class="button" onClick=${async () => {
        if (await build('remove', { name })) choose({ sort: '', name: '' });
      }}>${t('Delete')}</button>`
    }
    <button class="button" onClick=${() => choose({ sort: '', name: '' })}>${t('Close')}</button></div></div>
    ${unit && html`<${Ports} name=${name} unit=${unit} form=${form} build=${build} />`}
    ${unit?.duty && html`<${Size} key=${'size ' + name} duty=${unit.duty} ready=${solved && !old} size=${(wanted) => size(name, wanted)} />`}
    <div class="columns">${unit && html`<div><${ItemForm} key=${name} table="units" name=${name} item=${unit} typedIn=${typedIn} wrong=${wrong} spot="panel" /></div>`}
    ${feed && html`<div><${FeedForm} key=${name} name=${name} item=${feed} form=${form} typedIn=${typedIn} build=${build} wrong=${wrong} spot="panel" /></div>`}
    ${solved && html`<div class=${old ? 'stale' : ''}><${UnitFigures} name=${name} unit=${solved} cases=${cases} /></div>`}
    ${stream && html`<div class=${old ? 'stale' : ''}><${StreamPanel} stream=${stream} /></div>`}</div></section>`;
}

/** The size for what enters here: the figure of the duty as typed, or as in the example. */
function Size({ duty, ready, size }) {
  const [wanted, setWanted] = useState('');
  return html`<form class="row size" data-size onSubmit=${(e) => {
    e.preventDefault();
    if (ready) size(wanted);
  }}><button class="button" disabled=${!ready} title=${ready ? '' : t('The line must be solved first.')}>${t('Size it for what enters')}</button><label class="small">${t('{setting}, so that {figure} is', duty)} <input type="text" autocomplete="off" spellcheck="false" placeholder=${duty.usual || t('as in its example')} value=${wanted} onInput=${(e) => setWanted(e.target.value)} /></label></form>`;
}

function Rename({ name, rename }) {
  const [typed, setTyped] = useState(pretty(name));
  return html`<form class="row" onSubmit=${(e) => {
    e.preventDefault();
    rename(typed);
  }}><input id="rename" type="text" aria-label=${t('Name')} value=${typed} onInput=${(e) => setTyped(e.target.value)} /><button class="button" disabled=${!typed.trim() || typed === pretty(name)}>${t('Rename')}</button></form>`;
}

/** Where what enters comes from, and where what leaves goes. */
function Ports({ name, unit, form, build }) {
  const { origins, targets } = form.ends;
  const from = (port, end, before) => {
    const target = port ? `${name}.${port}` : name;
    if (!end) return build('disconnect', { end: target });
    return before ? build('replace', { origin: end, target }) : build('connect', { origin: end, target });
  };
  return html`<div class="ports">${unit.inlets.map((i) => html`<div key=${'in' + i.port} data-port=${i.port}><${EndMenu} id=${`from-${name}-${i.port}`} label=${t('{port} comes from', { port: i.label })} value=${i.from} ends=${origins} none=${i.needed ? t('nothing yet') : t('nothing')} own=${name} pick=${(end) => from(i.port, end, i.from)} /></div>`)}
    ${unit.joins && html`<div key="more" data-port="feed"><${EndMenu} id=${`from-${name}-more`} label=${t('one more stream from')} value="" ends=${origins.filter((o) => o.taken.split('.')[0] !== name)} none="—" own=${name} pick=${(end) => end && from('', end, '')} /></div>`}
    ${unit.outlets.map((o) => html`<div key=${'out' + o.port} data-port=${o.port}><${EndMenu} id=${`goes-${name}-${o.port}`} label=${t('{port} goes to', { port: o.label })} value=${o.to} ends=${targets} none=${t('leaves the line')} own=${name} pick=${(end) => (end ? build('lead', { origin: `${name}.${o.port}`, target: end }) : build('disconnect', { end: `${name}.${o.port}` }))} /></div>`)}</div>`;
}
