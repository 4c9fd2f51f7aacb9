// CPU seconds and peak memory of whole runs of `qmcf mesh` on one thread, by number of quads and stage, beside gmsh
// where it is installed (surfaces classified at 30 degrees, algorithm 6, Blossom), in turns:
//
//   node tests/bench/mesh/speed.mjs MODEL.obj|MODEL.stl [QUADS ...]     default 3000 20000 100000 300000
//
// Exit status 1 if a goal below is missed, set for the part `fandisk` (13,000 triangles), or gmsh is faster.

import { execFileSync } from 'node:child_process';
import { copyFileSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join, resolve } from 'node:path';
import { runMeasured } from '../../corpus/child.mjs';

const ROOT = resolve(import.meta.dirname, '../../..');
const GOALS = {
  3000: { seconds: 0.46, megabytes: 100 },
  20000: { seconds: 2.3, megabytes: 200 },
  100000: { seconds: 5, megabytes: 600 },
};
/** Most that a run may take in units of the smallest one's seconds per n log n; what is above 1 is noise. */
const GROWTH = 1.1;
const CPU_LIMIT = 300;
const runsFor = (quads) => (quads <= 100000 ? 3 : 1);

const best = (runs) => runs.reduce((least, run) => (run.cpuSeconds < least.cpuSeconds ? run : least));

async function measured(program, args) {
  const run = await runMeasured(program, args, CPU_LIMIT);
  if (run.exit !== 0) throw new Error(`${basename(program)} ended with ${run.exit ?? run.signal}: ${run.stderr}`);
  return run;
}

async function ours(model, quads, folder) {
  const [mesh, file] = [join(folder, 'mesh.obj'), join(folder, 'report.json')];
  const args = ['mesh', model, '-o', mesh, '--quads', String(quads), '--threads', '1', '--quiet', '--report', file];
  const run = await measured(join(ROOT, 'build/native/bin/qmcf'), args);
  return { ...run, report: JSON.parse(readFileSync(file, 'utf8')) };
}

/** gmsh reads STL; an OBJ is written as one. */
function stlOf(model, folder) {
  const stl = join(folder, 'part.stl');
  if (/\.stl$/i.test(model)) {
    copyFileSync(model, stl);
    return stl;
  }
  const points = [];
  const triangles = [];
  for (const line of readFileSync(model, 'utf8').split('\n')) {
    const [kind, ...words] = line.trim().split(/\s+/);
    if (kind === 'v') points.push(words.slice(0, 3).map(Number));
    if (kind !== 'f') continue;
    const corners = words.map((word) => Number.parseInt(word, 10)).map((i) => (i < 0 ? points.length + i : i - 1));
    for (let i = 2; i < corners.length; ++i) triangles.push([corners[0], corners[i - 1], corners[i]]);
  }
  const bytes = Buffer.alloc(84 + 50 * triangles.length);
  bytes.writeUInt32LE(triangles.length, 80);
  triangles.forEach((corners, t) => {
    corners.forEach((c, k) => points[c].forEach((x, axis) => bytes.writeFloatLE(x, 96 + 50 * t + 12 * k + 4 * axis)));
  });
  writeFileSync(stl, bytes);
  return stl;
}

async function gmsh(stl, size, folder) {
  const [script, mesh] = [join(folder, 'part.geo'), join(folder, 'part.msh')];
  const lines = [
    `Merge "${stl}"`, 'ClassifySurfaces{30*Pi/180, 1, 1, Pi}', 'CreateGeometry', 'Mesh.Algorithm = 6',
    'Mesh.RecombineAll = 1', 'Mesh.RecombinationAlgorithm = 1', `Mesh.CharacteristicLengthMin = ${size}`,
    `Mesh.CharacteristicLengthMax = ${size}`,
  ];
  writeFileSync(script, lines.map((line) => `${line};\n`).join(''));
  return measured('gmsh', ['-2', '-nt', '1', '-v', '1', script, '-o', mesh]);
}

function hasGmsh() {
  try {
    execFileSync('gmsh', ['-version'], { stdio: 'ignore' });
    return true;
  } catch {
    return false;
  }
}

/** Our fastest run of one count, gmsh's beside it, and which goals they miss. */
async function measureCount(model, stl, quads, folder) {
  const mine = [];
  const theirs = [];
  for (let i = 0; i < runsFor(quads); ++i) {
    mine.push(await ours(model, quads, folder));
    if (stl) theirs.push(await gmsh(stl, Math.sqrt(mine[0].report.quality.area / quads), folder));
  }
  const run = best(mine);
  const peer = theirs.length > 0 ? best(theirs) : null;
  const { seconds = Infinity, megabytes = Infinity } = GOALS[quads] ?? {};
  const missed = [];
  if (run.cpuSeconds > seconds) missed.push(`${quads}: ${run.cpuSeconds.toFixed(2)} s, at most ${seconds}`);
  if (run.peakMegabytes > megabytes) missed.push(`${quads}: ${run.peakMegabytes.toFixed(0)} MB, at most ${megabytes}`);
  if (peer && run.cpuSeconds > peer.cpuSeconds) missed.push(`${quads}: gmsh takes ${peer.cpuSeconds.toFixed(2)} s`);
  return { quads, run, peer, missed, perWork: run.cpuSeconds / (quads * Math.log(quads)) };
}

function printHeader(stages) {
  console.log(`| quads | made | valid | CPU s | MB | growth over n log n | gmsh, CPU s | ${stages.join(' | ')} |`);
  console.log(`|${' --- |'.repeat(7 + stages.length)}`);
}

function printRow({ quads, run, peer, perWork }, first) {
  const { quality, seconds } = run.report;
  const cells = [quads, quality.quads + quality.triangles, quality.valid ? 'yes' : 'no', run.cpuSeconds.toFixed(2),
    run.peakMegabytes.toFixed(0), (perWork / first.perWork).toFixed(2), peer ? peer.cpuSeconds.toFixed(2) : '',
    ...Object.values(seconds).map((stage) => stage.toFixed(3))];
  console.log(`| ${cells.join(' | ')} |`);
}

async function main() {
  const [model, ...counts] = process.argv.slice(2);
  if (!model) throw new Error('usage: node tests/bench/mesh/speed.mjs MODEL.obj|MODEL.stl [QUADS ...]');
  const wanted = counts.length > 0 ? counts.map(Number) : [3000, 20000, 100000, 300000];
  const folder = mkdtempSync(join(tmpdir(), 'qmcf-speed-'));
  try {
    const stl = hasGmsh() ? stlOf(model, folder) : null;
    const rows = [];
    for (const quads of wanted) {
      const row = await measureCount(model, stl, quads, folder);
      if (rows.length === 0) printHeader(Object.keys(row.run.report.seconds));
      rows.push(row);
      printRow(row, rows[0]);
    }
    const missed = rows.flatMap((row) => row.missed);
    for (const row of rows) {
      if (row.perWork > GROWTH * rows[0].perWork) missed.push(`${row.quads}: grows faster than n log n`);
    }
    for (const line of missed) console.log(`missed: ${line}`);
    process.exitCode = missed.length > 0 ? 1 : 0;
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

await main();
