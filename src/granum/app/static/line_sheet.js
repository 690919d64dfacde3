// The flow diagram as something to work on: zoom, pan, choose, put equipment at an open end, drag an open end to an inlet.
import { colon, html, t, useState, useEffect, useRef } from './core.js';

const SMALLEST = 0.5;
const LARGEST = 3;
const COLUMN = 225; // pixels that a unit with its streams takes
const DRAGGED = 6; // pixels from where a press becomes a drag

export function Sheet({ svg, streams, old, chosen, choose, put, connect, setAcross }) {
  const frame = useRef(null);
  const sheet = useRef(null);
  const drag = useRef(null);
  const fit = useRef({ width: 0, across: 0 });
  const [zoom, setZoom] = useState(1);
  /** Fewer machines side by side where long names make them wider than the frame. */
  const narrow = () => {
    const drawn = sheet.current.querySelector('svg');
    const { width, across } = fit.current;
    const shown = Number(drawn?.dataset.across);
    if (!width || !(shown > 1) || shown > across || Number(drawn.dataset.width) <= width) return;
    fit.current.across = shown - 1;
    setAcross(fit.current.across);
  };
  const by = (factor) => setZoom((z) => Math.min(LARGEST, Math.max(SMALLEST, z * factor)));
  useEffect(() => {
    const seen = new ResizeObserver(() => {
      const width = frame.current?.clientWidth;
      if (!width || Math.abs(width - fit.current.width) < 20) return; // such as a scroll bar that comes or goes
      fit.current = { width, across: Math.max(2, Math.min(12, Math.floor((width - 60) / COLUMN))) };
      setAcross(fit.current.across);
      narrow();
    });
    seen.observe(frame.current);
    const wheel = (e) => {
      if (!e.ctrlKey && !e.metaKey) return;
      e.preventDefault();
      by(e.deltaY < 0 ? 1.15 : 1 / 1.15);
    };
    frame.current.addEventListener('wheel', wheel, { passive: false });
    return () => seen.disconnect();
  }, []);
  useEffect(() => {
    const drawn = sheet.current.querySelector('svg');
    if (!drawn) return;
    narrow();
    drawn.style.maxWidth = 'none';
    drawn.style.width = `${Math.round(Number(drawn.dataset.width) * zoom)}px`;
  }, [svg, zoom]);
  useEffect(() => {
    for (const g of sheet.current.querySelectorAll('[data-stream]')) {
      const stream = streams?.[g.dataset.stream];
      g.dataset.phase = stream && !old ? stream.phase : '';
      g.classList.toggle('empty', Boolean(stream?.empty && !old));
      const name = g.dataset.stream.replaceAll('_', ' ');
      g.querySelector('title').textContent = stream && !old ? `${name}${colon()} ${stream.tip}` : name;
    }
    for (const g of sheet.current.querySelectorAll('[data-unit],[data-stream]'))
      g.classList.toggle('chosen', (g.dataset.unit ?? g.dataset.stream) === chosen.name);
  }, [svg, streams, old, chosen.name]);
  const act = (found) => {
    const { outlet, inlet, unit, stream } = found.dataset;
    if (outlet) put(outlet);
    else if (inlet) choose({ sort: 'unit', name: inlet.split('.')[0], port: inlet });
    else choose(unit ? { sort: 'unit', name: unit } : { sort: 'stream', name: stream });
  };
  const thing = (target) => target.closest?.('[data-outlet],[data-inlet],[data-unit],[data-stream]');
  const key = (e) => {
    if (e.key === '+' || e.key === '=') by(1.25);
    else if (e.key === '-') by(0.8);
    else if (e.key === '0') setZoom(1);
    else if (e.key === 'Escape' && drag.current?.moved) letGo();
    else if ((e.key === 'Enter' || e.key === ' ') && thing(e.target)) act(thing(e.target));
    else return;
    e.preventDefault();
  };
  /** Where an open end would go if it were let go there; nothing but a machine or an inlet takes it. */
  const aim = (e) => {
    const below = document.elementFromPoint(e.clientX, e.clientY);
    return below?.closest?.('[data-inlet]') || below?.closest?.('[data-unit]');
  };
  const aimed = (found) => {
    for (const g of sheet.current.querySelectorAll('.aimed')) if (g !== found) g.classList.remove('aimed');
    found?.classList.add('aimed');
  };
  const letGo = () => {
    drag.current = null;
    aimed(null);
    sheet.current.parentElement.querySelector('.rubber').style.display = 'none';
  };
  const down = (e) => {
    if (e.button) return;
    const outlet = e.target.closest?.('[data-outlet]')?.dataset.outlet;
    const box = frame.current;
    drag.current = {
      x: e.clientX,
      y: e.clientY,
      left: box.scrollLeft,
      top: box.scrollTop,
      outlet,
      moved: false,
    };
  };
  const move = (e) => {
    const d = drag.current;
    if (!d) return;
    d.moved ||= Math.hypot(e.clientX - d.x, e.clientY - d.y) > DRAGGED;
    if (!d.moved) return;
    frame.current.setPointerCapture?.(e.pointerId);
    if (d.outlet) {
      const box = sheet.current.getBoundingClientRect();
      const line = sheet.current.parentElement.querySelector('.rubber');
      line.style.display = 'block';
      const ends = {
        x1: d.x - box.left,
        y1: d.y - box.top,
        x2: e.clientX - box.left,
        y2: e.clientY - box.top,
      };
      for (const [name, value] of Object.entries(ends)) line.firstElementChild.setAttribute(name, value);
      aimed(aim(e));
    } else if (e.pointerType === 'mouse') {
      frame.current.scrollLeft = d.left - (e.clientX - d.x);
      frame.current.scrollTop = d.top - (e.clientY - d.y);
    }
  };
  const up = (e) => {
    const d = drag.current;
    letGo();
    if (!d?.moved || !d.outlet) return;
    const found = aim(e)?.dataset;
    if (found) connect(d.outlet, found.inlet || found.unit);
  };
  const click = (e) => {
    const found = thing(e.target);
    if (found) act(found);
  };
  return html`<div class="row zoom"><button class="button" aria-label=${t('Zoom out')} title=${t('Zoom out')} onClick=${() => by(0.8)}>−</button><button class="button" aria-label=${t('Original size')} onClick=${() => setZoom(1)}>${Math.round(100 * zoom)} %</button><button class="button" aria-label=${t('Zoom in')} title=${t('Zoom in')} onClick=${() => by(1.25)}>+</button></div>
    <div class="diagram" ref=${frame} tabindex="0" role="region" aria-label=${t('Flow diagram')} onClick=${click} onKeyDown=${key} onPointerDown=${down} onPointerMove=${move} onPointerUp=${up} onPointerCancel=${letGo}><div class="paper"><div ref=${sheet} dangerouslySetInnerHTML=${{ __html: svg }} /><svg class="rubber" aria-hidden="true"><line /></svg></div></div>`;
}
