// Indices and powers in plain text: "ρ_s d^2" with the s lowered and the 2 raised.
import { html } from './core.js';

const PART = /_(\w+)|\^(\([^)]*\)|[−+-]?[\d.,]*\d|\w)/gu;

export function Indexed({ text }) {
  const parts = [];
  let end = 0;
  for (const found of text.matchAll(PART)) {
    parts.push(text.slice(end, found.index));
    parts.push(
      found[1] ? html`<sub>${found[1]}</sub>` : html`<sup>${found[2].replace(/^\(|\)$/g, '')}</sup>`,
    );
    end = found.index + found[0].length;
  }
  return [...parts, text.slice(end)];
}
