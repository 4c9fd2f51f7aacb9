// Results as text: a table, a summary, a comparison of two runs.

const fixed = (digits) => (x) => (x === null || x === undefined || Number.isNaN(x) ? '-' : x.toFixed(digits));
const percent = (x) => (x === null || x === undefined ? '-' : (100 * x).toFixed(1));
const whole = (x) => (x === null || x === undefined ? '-' : String(Math.round(x)));

const COLUMNS = [
  ['part', (r) => r.model, 'left'],
  ['verdict', (r) => r.verdict, 'left'],
  ['s', (r) => fixed(2)(r.seconds)],
  ['cpu s', (r) => fixed(2)(r.cpuSeconds)],
  ['MB', (r) => whole(r.peakMegabytes)],
  ['quads', (r) => whole(r.quads)],
  ['tris', (r) => whole(r.triangles)],
  ['quad %', (r) => percent(r.quadShare)],
  ['reg %', (r) => percent(r.regularShare)],
  ['SJ mean', (r) => fixed(3)(r.scaledJacobian?.mean)],
  ['p1', (r) => fixed(2)(r.scaledJacobian?.p1)],
  ['worst', (r) => fixed(2)(r.scaledJacobian?.worst)],
  ['size', (r) => fixed(3)(r.sizeError)],
  ['dist/h', (r) => fixed(2)(r.distance)],
  ['sharp %', (r) => percent(r.sharpRecall)],
  ['bound %', (r) => percent(r.boundaryRecall)],
  ['corner %', (r) => percent(r.cornerRecall)],
  ['why', (r) => (r.failing?.length ? r.failing.join(', ') : r.message ?? ''), 'left'],
];

export function resultTable(results) {
  return align([COLUMNS.map(([title]) => title), ...results.map((r) => COLUMNS.map(([, text]) => text(r)))], (i) => COLUMNS[i][2]);
}

function align(rows, alignment) {
  const widths = rows[0].map((_, i) => Math.max(...rows.map((row) => row[i].length)));
  return rows
    .map((row) => row.map((cell, i) => (alignment(i) === 'left' ? cell.padEnd(widths[i]) : cell.padStart(widths[i]))).join('  ').trimEnd())
    .join('\n');
}

export function summaryLine(results) {
  const count = new Map();
  for (const { verdict } of results) count.set(verdict, (count.get(verdict) ?? 0) + 1);
  const parts = [...count].sort().map(([verdict, n]) => `${n} ${verdict}`);
  const mean = (pick) => {
    const values = results.map(pick).filter((x) => typeof x === 'number');
    return values.length ? values.reduce((a, b) => a + b, 0) / values.length : null;
  };
  const figures = [
    `quads ${percent(mean((r) => r.quadShare))} %`,
    `regular ${percent(mean((r) => r.regularShare))} %`,
    `SJ ${fixed(3)(mean((r) => r.scaledJacobian?.mean))}`,
    `size ${fixed(3)(mean((r) => r.sizeError))}`,
    `sharp ${percent(mean((r) => r.sharpRecall))} %`,
    `corners ${percent(mean((r) => r.cornerRecall))} %`,
    `cpu ${fixed(1)(results.reduce((sum, r) => sum + (r.cpuSeconds ?? 0), 0))} s`,
  ];
  return `${results.length} parts: ${parts.join(', ')}. Means: ${figures.join(', ')}`;
}

// Figures that are compared: how to find them, which way is better, from which difference on it counts.
const COMPARED = [
  ['cpu s', (r) => r.cpuSeconds, -1, (base) => Math.max(0.1, 0.15 * base)],
  ['MB', (r) => r.peakMegabytes, -1, (base) => Math.max(5, 0.1 * base)],
  ['tris', (r) => r.triangles, -1, () => 1],
  ['quad %', (r) => r.quadShare && 100 * r.quadShare, 1, () => 0.1],
  ['reg %', (r) => r.regularShare && 100 * r.regularShare, 1, () => 0.2],
  ['SJ mean', (r) => r.scaledJacobian?.mean, 1, () => 0.002],
  ['SJ p1', (r) => r.scaledJacobian?.p1, 1, () => 0.01],
  ['SJ worst', (r) => r.scaledJacobian?.worst, 1, () => 0.02],
  ['size', (r) => r.sizeError, -1, () => 0.003],
  ['dist/h', (r) => r.distance, -1, () => 0.02],
  ['sharp %', (r) => r.sharpRecall && 100 * r.sharpRecall, 1, () => 0.1],
  ['bound %', (r) => r.boundaryRecall && 100 * r.boundaryRecall, 1, () => 0.1],
  ['corner %', (r) => r.cornerRecall && 100 * r.cornerRecall, 1, () => 0.1],
];

/** { text, worse }: what changed from base to head; worse is true when a part that was fine no longer is. */
export function compareResults(base, head) {
  const before = new Map(base.map((r) => [r.model, r]));
  const lines = [];
  let worse = false;
  for (const now of head) {
    const then = before.get(now.model);
    before.delete(now.model);
    if (!then) {
      lines.push(`${now.model}: new, ${now.verdict}`);
      continue;
    }
    const changes = [];
    if (then.verdict !== now.verdict) {
      changes.push(`${then.verdict} -> ${now.verdict}`);
      if (then.verdict === 'VALID') worse = true;
    }
    for (const [title, pick, better, threshold] of COMPARED) {
      const [a, b] = [pick(then), pick(now)];
      if (typeof a !== 'number' || typeof b !== 'number' || Math.abs(b - a) < threshold(a)) continue;
      changes.push(`${(b - a) * better > 0 ? '+' : '-'} ${title} ${Number(a.toPrecision(4))} -> ${Number(b.toPrecision(4))}`);
    }
    if (changes.length > 0) lines.push(`${now.model}: ${changes.join('; ')}`);
  }
  if (before.size > 0) lines.push(`${before.size} parts of the base are not in this run`);
  return { text: lines.length ? lines.join('\n') : 'no difference', worse };
}
