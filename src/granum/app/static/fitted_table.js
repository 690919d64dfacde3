// A table too wide for its place becomes several, one below the other: no column is out of sight.
import { html, useEffect, useLayoutEffect, useRef, useState } from './core.js';

/** `columns`: `{ head, phase, group }`, those of a group stay together where they fit; `rows`: `{ head, cells, phase, sort }`;
 * with another `about` the widths may be others. */
export function FittedTable({ about, corner, columns, rows, sort = '' }) {
  const [found, setFound] = useState({});
  const place = useRef(null);
  const all = columns.map((_, i) => i);
  const known = found.about === about && found.count === rows.length;
  useEffect(() => {
    let width = place.current.clientWidth;
    const watch = new ResizeObserver(() => {
      if (place.current.clientWidth === width) return;
      width = place.current.clientWidth;
      setFound({});
    });
    watch.observe(place.current);
    return () => watch.disconnect();
  }, []);
  useLayoutEffect(() => {
    if (known) return;
    const { clientWidth, scrollWidth } = place.current;
    const [first, ...others] = [...place.current.querySelectorAll('thead th')].map((e) => e.offsetWidth);
    const fits = scrollWidth <= clientWidth;
    setFound({ about, count: rows.length, parts: fits ? [all] : packed(columns, others, clientWidth - first) });
  });
  const parts = known ? found.parts : [all];
  const says = (row, part) => parts.length === 1 || part.some((i) => row.cells[i]);
  return html`<div ref=${place}>${parts.map(
    (part) => html`<table class=${`streams ${sort}`}><thead><tr><th scope="col">${corner}</th>${part.map((i) => html`<th class="n" scope="col" data-phase=${columns[i].phase}>${columns[i].head}</th>`)}</tr></thead>
    <tbody>${rows
      .filter((row) => says(row, part))
      .map(
        (row) =>
          html`<tr class=${row.sort || ''} data-phase=${row.phase}><th scope="row">${row.head}</th>${part.map((i) => html`<td class="n" data-phase=${columns[i].phase}>${row.cells[i]}</td>`)}</tr>`,
      )}</tbody></table>`,
  )}</div>`;
}

/** Columns by the table they stand in. */
function packed(columns, widths, room) {
  const parts = [];
  let left = 0;
  const put = (some) => {
    const width = some.reduce((sum, i) => sum + widths[i], 0);
    if (width > left && width > room && some.length > 1) return some.forEach((i) => put([i]));
    if (width > left) {
      parts.push([]);
      left = room;
    }
    parts.at(-1).push(...some);
    left -= width;
  };
  for (const group of new Set(columns.map((c) => c.group)))
    put(columns.map((_, i) => i).filter((i) => columns[i].group === group));
  return parts;
}
