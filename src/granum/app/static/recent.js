// What was open lately, kept in this browser alone.
const KEY = 'granum-recent';
const MOST = 8;
const NAMES = {
  calculate: 'Calculate',
  lab: 'Lab data',
  lines: 'Lines',
  charts: 'Charts',
  select: 'Select',
  exercises: 'Exercises',
  read: 'Reading',
};

function all() {
  try {
    const found = JSON.parse(localStorage.getItem(KEY));
    return Array.isArray(found) ? found : [];
  } catch {
    return [];
  }
}

/** Remember what is open now; the same thing once, with its latest values. */
export function noteRecent({ page, key }) {
  if (!key || !NAMES[page]) return;
  const rest = all().filter((one) => one.page !== page || one.key !== key);
  try {
    localStorage.setItem(KEY, JSON.stringify([{ page, key, hash: location.hash }, ...rest].slice(0, MOST)));
  } catch {
    /* private window: nothing is kept */
  }
}

/** The last things with their titles, which follow the language. */
export function recent(cards) {
  return all().map((one) => ({
    ...one,
    name: NAMES[one.page],
    title:
      cards?.find((c) => c.card === one.key)?.title ||
      one.key
        .slice(one.key.indexOf(':') + 1)
        .replace(/\.toml$/, '')
        .replaceAll(/[-_]/g, ' '),
  }));
}
