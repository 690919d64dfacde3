// The way from a card to the chapter of the handbook that teaches its domain.
import { html, t, link, settings } from './core.js';

export function Chapter({ card }) {
  const folder = settings.language === 'fr' ? 'fr/manuel' : 'handbook';
  return html`<a class="chapter" href=${link('read', `${folder}/${card.split('.')[0]}`)}>${t('The chapter of the handbook')}</a>`;
}
