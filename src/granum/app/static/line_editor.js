// The text of a case file with the numbers of its lines, for whoever wants to write it.
import { html, t, useRef } from './core.js';

export function Editor({ text, write, done }) {
  const numbers = useRef(null);
  const lines = text.split('\n').length;
  return html`<div class="editor"><div class="numbers" aria-hidden="true" ref=${numbers}>${Array.from({ length: lines }, (_, i) => i + 1).join('\n')}</div>
    <textarea id="case" aria-label=${t('Case file')} rows=${Math.min(Math.max(lines + 1, 12), 36)} wrap="off" spellcheck="false" value=${text} placeholder=${t('Open an example, or write a case file here.')}
      onScroll=${(e) => {
        numbers.current.scrollTop = e.target.scrollTop;
      }} onInput=${(e) => write(e.target.value)} onChange=${(e) => done(e.target.value)}></textarea></div>`;
}
