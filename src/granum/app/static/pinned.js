// On a narrow screen the first result stays in sight while one types above it; and results are spoken when they change.
import { colon } from './core.js';

const NARROW = matchMedia('(max-width: 62rem)');
const QUIET = 1200; // ms without a change after which a result is spoken
const RESULT = '#main [data-output], #main [data-parameter] strong';

const bar = Object.assign(document.createElement('div'), { className: 'pinned', hidden: true });
bar.setAttribute('aria-hidden', 'true'); // the voice says the same
const voice = Object.assign(document.createElement('div'), { className: 'hidden', id: 'voice' });
voice.setAttribute('role', 'status');
document.body.append(bar, voice);
bar.addEventListener('click', () => document.querySelector(RESULT)?.scrollIntoView({ block: 'center' }));

/** What stands before a result, without the symbol behind it. */
function labelOf(result) {
  const row = result.closest('tr');
  const place = row ? row.querySelector('td, th') : result.closest('.answer')?.querySelector('.dim');
  return place && place !== result ? (place.childNodes[0]?.textContent ?? '').trim() : '';
}

let spoken = null; // nothing yet: the result that a page opens with is read with the page
let timer = 0;
function speak(text) {
  clearTimeout(timer);
  timer = setTimeout(() => {
    if (spoken !== null && text !== spoken) voice.textContent = text;
    spoken = text;
  }, QUIET);
}

function look() {
  const result = document.querySelector(RESULT);
  const stale = Boolean(result?.closest('.stale'));
  const label = result ? labelOf(result) : '';
  const value = result?.textContent.trim() ?? '';
  if (result && !stale) {
    const doubt = document.querySelector('#main [data-belief=caution] .mark')?.textContent ?? '';
    speak(`${label}${label && colon()} ${value} ${doubt}`.trim());
  }
  const below = result && result.getBoundingClientRect().top > innerHeight - 20;
  bar.hidden = !(NARROW.matches && below && document.querySelector('#main form'));
  bar.classList.toggle('old', stale);
  if (!bar.hidden) {
    bar.replaceChildren(
      Object.assign(document.createElement('span'), { textContent: label }),
      Object.assign(document.createElement('strong'), { textContent: value }),
    );
    const view = window.visualViewport; // above the keyboard of a phone
    bar.style.bottom = view ? `${Math.max(0, innerHeight - view.height - view.offsetTop)}px` : '0';
  }
}

let waiting = false;
function soon() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    look();
  });
}
new MutationObserver(soon).observe(document.getElementById('app'), {
  subtree: true,
  childList: true,
  characterData: true,
  attributeFilter: ['class'],
});
for (const event of ['scroll', 'resize', 'hashchange']) addEventListener(event, soon, { passive: true });
window.visualViewport?.addEventListener('resize', soon);
addEventListener('hashchange', () => {
  spoken = null;
});
