// What stands on paper besides the page: which program and version, when, and the address that brings it back.
import { html, render, t, ask, settings, useEffect, useState } from './core.js';

let version = '';
ask('/api/version').then((found) => {
  version = found.version;
});

function Printed() {
  const [, again] = useState(0);
  useEffect(() => {
    const now = () => again((count) => count + 1);
    addEventListener('beforeprint', now);
    return () => removeEventListener('beforeprint', now);
  }, []);
  const when = new Intl.DateTimeFormat(settings.language, { dateStyle: 'long', timeStyle: 'short' });
  return html`<p class="printed">Granum ${version} · ${document.title.replace(' · Granum', '')} · ${when.format(Date.now())}<br />${t('The same page again:')} ${location.href}</p>`;
}

const foot = document.createElement('footer');
document.body.append(foot);
render(html`<${Printed} />`, foot);
