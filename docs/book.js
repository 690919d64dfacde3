// Puts the pages of the site together as one: arguments are addresses, words of the index, words of the book.
const [pages, terms, words, done] = arguments;

const make = (tag, attributes = {}, ...children) => {
  const node = Object.assign(document.createElement(tag), attributes);
  node.append(...children);
  return node;
};
const slug = (address) => address.replace(/\.html$/, '').replaceAll('/', '--');
const at = (to) => { const node = make('span', { className: 'at', textContent: '000' }); node.dataset.to = to; return node; };
const leading = (to, title) => make('a', { href: `#${to}` }, make('span', { textContent: title }), at(to));

/** Links within the book lead to its pages, others to the world outside; what else the site has is not in the book. */
function redirect(link, base) {
  const to = new URL(link.getAttribute('href'), base);
  const page = decodeURI(to.pathname.slice(1));
  if (pages.includes(page)) link.setAttribute('href', `#${slug(page)}${to.hash ? `--${decodeURIComponent(to.hash.slice(1))}` : ''}`);
  else if (to.origin === location.origin) link.replaceWith(...link.childNodes);
}

/** Numbers before headings, below figures and beside equations of one chapter. */
function number(chapter, count) {
  let section = 0, figure = 0, equation = 0;
  for (const node of chapter.querySelectorAll('h1, h2, .moving, .plot, div.equation')) {
    if (node.matches('h1')) node.prepend(make('span', { className: 'number', textContent: `${count}` }));
    else if (node.matches('h2')) node.prepend(make('span', { className: 'number', textContent: `${count}.${section += 1}` }));
    else if (node.matches('.equation')) node.append(make('span', { className: 'beside', textContent: `(${count}.${equation += 1})` }));
    else if (!node.parentElement.closest('.moving')) {
      const caption = node.nextElementSibling;
      const told = `${words.figure} ${count}.${figure += 1}. `;
      const own = caption?.matches('p') && caption.firstElementChild?.matches('em') && caption.childNodes.length === 1;
      const text = own ? caption : make('p');
      text.prepend(make('strong', { textContent: told }));
      const frame = make('figure');
      node.replaceWith(frame);
      frame.append(node, text);
    }
  }
}

async function chapter(address, count) {
  const base = new URL(address, location.href);
  const answer = await fetch(base);
  if (!answer.ok) throw new Error(`${address}: ${answer.status}`);
  const found = new DOMParser().parseFromString(await answer.text(), 'text/html').querySelector('article');
  found.querySelectorAll('.headerlink, .md-content__button, .md-source-file, h1:not(:first-of-type)').forEach((node) => node.remove());
  found.querySelectorAll('[id]').forEach((node) => { node.id = `${slug(address)}--${node.id}`; });
  found.querySelectorAll('a[href]').forEach((link) => redirect(link, base));
  found.querySelectorAll('img[src]').forEach((image) => { image.src = new URL(image.getAttribute('src'), base); });
  found.querySelectorAll('details').forEach((node) => { node.open = true; });
  found.querySelector('h1').id = slug(address);
  // a guide counts its steps itself
  found.querySelectorAll('h2').forEach((node) => { node.firstChild.textContent = node.firstChild.textContent.replace(/^\d+\. /, ''); });
  number(found, count);
  return make('section', { className: 'chapter' }, ...found.childNodes);
}

function contents() {
  const rows = [...document.querySelectorAll('.chapter h1, .chapter h2')].map((heading) => {
    const row = make('li', { className: heading.localName }, leading(heading.id, ''));
    row.querySelector('span').append(...[...heading.childNodes].map((node) => node.cloneNode(true)));
    return row;
  });
  return make('nav', { className: 'contents' }, make('h1', { textContent: words.contents }), make('ul', {}, ...rows));
}

/** Under each word the sections that use it; a word that stands nearly everywhere leads nowhere. */
function index() {
  const sections = [];
  for (const node of document.querySelectorAll('.chapter')) {
    for (const part of node.children) {
      if (part.matches('h1, h2')) sections.push({ id: part.id, text: '' });
      if (!part.matches('figure, pre, .highlight')) sections.at(-1).text += ` ${part.textContent.toLowerCase().replaceAll('’', "'")}`;
    }
  }
  const rows = terms.map((term) => {
    const whole = new RegExp(`(?<![\\p{L}-])${term.toLowerCase().replaceAll('’', "'").replace(/[.*+?^${}()|[\]\\]/g, '\\$&')}s?(?![\\p{L}-])`, 'u');
    return [term, sections.filter((section) => section.id && whole.test(section.text)).map((section) => section.id)];
  }).filter(([, ids]) => ids.length > 0 && ids.length <= 8);
  rows.sort(([a], [b]) => a.localeCompare(b, words.language));
  const list = rows.map(([term, ids]) => make('li', {}, term, ...ids.map((to) => make('a', { href: `#${to}`, className: 'entry' }, at(to)))));
  return make('section', { className: 'index' }, make('h1', { textContent: words.index }), make('ul', {}, ...list));
}

/** Numbers of pages where they are told; of several equal ones in a row of the index the first. */
window.paginate = (found) => {
  for (const node of document.querySelectorAll('.at')) node.textContent = found[node.dataset.to] ?? '';
  for (const row of document.querySelectorAll('.index li')) {
    const seen = new Set();
    row.querySelectorAll('a').forEach((link) => { link.classList.toggle('again', seen.has(link.textContent)); seen.add(link.textContent); });
  }
};

function drawn() {
  const places = [...document.querySelectorAll('.plot')];
  if (!places.length) return Promise.resolve();
  document.body.append(make('script', { src: new URL('/assets/plots.js', location.href).href }));
  return new Promise((ready) => {
    const look = () => (places.every((place) => place.querySelector('.main-svg')) ? ready() : setTimeout(look, 200));
    look();
  });
}

(async () => {
  document.documentElement.lang = words.language;
  document.title = words.title;
  const cover = make('header', {}, make('h1', { textContent: words.title }), make('p', { textContent: words.version }));
  const parts = [];
  for (const [i, page] of pages.entries()) parts.push(await chapter(page, i + 1));
  document.body.append(cover, ...parts);
  cover.after(contents());
  document.body.append(index());
  await drawn();
  await document.fonts.ready;
  done('');
})().catch((problem) => done(String(problem)));
