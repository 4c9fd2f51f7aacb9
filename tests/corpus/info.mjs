// Compares what `qmcf info` counts in the models of a folder, as read, with the folder's MANIFEST.tsv.

import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { basename, dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { runMeasured } from './child.mjs';

const ROOT = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
const USAGE = `usage: tests/corpus/info [FOLDER] [options]
  FOLDER           models with a MANIFEST.tsv (../shared/models)
  --qmcf PATH      the program (build/native/bin/qmcf)
  --only REGEX     models whose name matches
  --markdown FILE  write the table of differences
exit status: 0 all counts agree with the manifest or differ as info_differences.json explains, and no model took more than
2 s of CPU time per 100,000 triangles; 1 otherwise; 2 wrong usage`;

/** Columns of the manifest and the statistics they should equal. */
const COUNTS = {
  components: 'components',
  boundary_loops: 'boundaryLoops',
  euler: 'eulerCharacteristic',
  nonmanifold_edges: 'nonManifoldEdges',
  nonmanifold_vertices: 'nonManifoldVertices',
  misoriented_edges: 'misorientedEdges',
  degenerate_faces: 'degenerateTriangles',
  sliver_faces: 'sliverTriangles',
  duplicate_vertices: 'duplicateVertices',
  duplicate_faces: 'duplicateTriangles',
};
/** Of the polygons in the manifest, of the triangles they are cut into here: comparable for triangles only. */
const PER_FACE = ['degenerate_faces', 'sliver_faces', 'duplicate_faces'];

const SECONDS_PER_TRIANGLE = 2 / 100_000;
/** Starting a process and reading a small file take this long on a busy machine. */
const SECONDS_AT_LEAST = 0.5;
const CPU_LIMIT = 30;

function parseCommandLine(args) {
  const text = { type: 'string' };
  const { values, positionals } = parseArgs({
    args,
    allowPositionals: true,
    options: { qmcf: text, only: text, markdown: text, help: { type: 'boolean' } },
  });
  if (positionals.length > 1) throw new Error('one folder');
  return {
    ...values,
    folder: resolve(positionals[0] ?? join(ROOT, '../shared/models')),
    qmcf: resolve(values.qmcf ?? join(ROOT, 'build/native/bin/qmcf')),
    only: new RegExp(values.only ?? '', 'i'),
  };
}

function readManifest(folder) {
  const [header, ...rows] = readFileSync(join(folder, 'MANIFEST.tsv'), 'utf8').trimEnd().split('\n');
  const names = header.split('\t');
  return rows
    .map((row) => Object.fromEntries(row.split('\t').map((value, i) => [names[i], value])))
    .filter(({ file }) => /\.(obj|stl|ply)$/i.test(file));
}

/** [{ column, ours, theirs }] where the counts of one model differ. */
function differences(row, statistics) {
  const found = [];
  const onlyTriangles = row.quad === '0' && row.poly === '0';
  for (const [column, name] of Object.entries(COUNTS)) {
    if (row[column] === '-' || row[column] === undefined) continue;
    if (PER_FACE.includes(column) && !onlyTriangles) continue;
    const theirs = Number(row[column]);
    if (statistics[name] !== theirs) found.push({ column, ours: statistics[name], theirs });
  }
  const diagonal = Number(row.bbox_diag);
  if (Math.abs(statistics.diagonal - diagonal) > 1e-5 * diagonal) {
    found.push({ column: 'bbox_diag', ours: statistics.diagonal, theirs: diagonal });
  }
  return found;
}

/** The explanation in info_differences.json of exactly this difference. */
function explanation(known, file, { column, ours, theirs }) {
  return known.find((d) => d.file === file && d.column === column && d.ours === ours && d.manifest === theirs)?.why;
}

async function inspect(options, row) {
  const run = await runMeasured(options.qmcf, ['info', join(options.folder, row.file), '--json'], CPU_LIMIT);
  if (run.exit !== 0) return { problem: run.timedOut ? 'hangs' : `exit ${run.exit}: ${run.stderr.trim()}` };
  const info = JSON.parse(run.stdout);
  const allowed = Math.max(SECONDS_AT_LEAST, info.statistics.triangles * SECONDS_PER_TRIANGLE);
  const problem = run.cpuSeconds > allowed ? `took ${run.cpuSeconds.toFixed(2)} s of CPU time, allowed are ${allowed.toFixed(2)} s` : '';
  return { problem, cpu: run.cpuSeconds, triangles: info.statistics.triangles, statistics: info.statistics };
}

function toMarkdown(rows) {
  const line = (cells) => `| ${cells.join(' | ')} |`;
  return [
    line(['Model', 'Count', 'Ours', 'Manifest', 'Why']),
    line(['---', '---', '---', '---', '---']),
    ...rows.map((row) => line([row.file, row.column.replaceAll('_', ' '), row.ours, row.theirs, row.why ?? '**not explained**'])),
    '',
  ].join('\n');
}

async function main() {
  const options = parseCommandLine(process.argv.slice(2));
  if (options.help) {
    console.log(USAGE);
    return 0;
  }
  if (!existsSync(join(options.folder, 'MANIFEST.tsv'))) throw new Error(`${options.folder} has no MANIFEST.tsv`);
  const known = JSON.parse(readFileSync(join(import.meta.dirname, 'info_differences.json'), 'utf8'));
  const models = readManifest(options.folder).filter(({ file }) => options.only.test(file));
  const rows = [];
  let failures = 0;
  let slowest = { perTriangle: 0 };
  for (const row of models) {
    const result = await inspect(options, row);
    if (result.problem) {
      failures += 1;
      console.log(`${row.file}: ${result.problem}`);
    }
    if (!result.statistics) continue;
    const perTriangle = result.cpu / result.triangles;
    if (result.triangles > 20_000 && perTriangle > slowest.perTriangle) slowest = { perTriangle, file: row.file };
    for (const difference of differences(row, result.statistics)) {
      rows.push({ file: row.file, ...difference, why: explanation(known, row.file, difference) });
    }
  }
  const unexplained = rows.filter(({ why }) => !why);
  const gone = known.filter((d) => options.only.test(d.file) && !rows.some((r) => r.file === d.file && r.column === d.column));
  for (const d of gone) console.log(`${d.file}: ${d.column} agrees now; take it out of info_differences.json`);
  console.log(toMarkdown(rows));
  if (options.markdown) writeFileSync(resolve(options.markdown), toMarkdown(rows));
  if (slowest.file) {
    console.log(`slowest of those over 20,000 triangles: ${basename(slowest.file)}, ${(slowest.perTriangle * 1e5).toFixed(2)} s per 100,000`);
  }
  console.log(`${models.length} models, ${failures} failed, ${rows.length - unexplained.length} differences explained, ${unexplained.length} not`);
  return failures + unexplained.length + gone.length > 0 || models.length === 0 ? 1 : 0;
}

main().then(
  (status) => {
    process.exitCode = status;
  },
  (error) => {
    console.error(`tests/corpus/info: ${error.message}\n${USAGE}`);
    process.exitCode = 2;
  },
);
