// What a student has solved: kept in this browser, and taken along as a table.
import { download, recall, remember, useEffect, useState } from './core.js';

const NAME = 'progress';
const CHANGED = 'granum-progress';

/** Notes what became of an answer; what was solved once stays solved. */
export function note(exercise, step, { right = false, shown = false, answer = '', seed = null }) {
  const all = recall(NAME, {});
  const before = all[exercise]?.[step] ?? { right: false, shown: false, tries: 0 };
  const now = {
    right: before.right || right,
    shown: before.shown || (shown && !before.right),
    tries: before.tries + (shown ? 0 : 1),
    answer: answer || before.answer || '',
    seed,
    at: new Date().toISOString(),
  };
  remember(NAME, { ...all, [exercise]: { ...all[exercise], [step]: now } });
  dispatchEvent(new Event(CHANGED));
}

/** How many steps of an exercise are solved. */
export const done = (progress, exercise, steps) =>
  Array.from({ length: steps }, (_, i) => progress[exercise]?.[i]?.right).filter(Boolean).length;

export function useProgress() {
  const [progress, set] = useState(() => recall(NAME, {}));
  useEffect(() => {
    const changed = () => set(recall(NAME, {}));
    addEventListener(CHANGED, changed);
    return () => removeEventListener(CHANGED, changed);
  }, []);
  return progress;
}

/** The progress as a file. */
export function exported() {
  const rows = Object.entries(recall(NAME, {})).flatMap(([exercise, steps]) =>
    Object.entries(steps).map(([step, s]) =>
      [
        exercise,
        Number(step) + 1,
        s.right ? 'yes' : 'no',
        s.shown ? 'yes' : 'no',
        s.tries,
        `"${String(s.answer).replaceAll('"', '""')}"`,
        s.seed ?? '',
        s.at,
      ].join(','),
    ),
  );
  download(
    'granum-progress.csv',
    ['exercise,step,solved,answer shown,tries,last answer,seed,time', ...rows].join('\n') + '\n',
    'text/csv',
  );
}
