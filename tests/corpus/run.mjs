// Meshes parts that are not part of the project and has an independent program judge the result.
//
//   node tests/corpus/run.mjs --models FOLDER --judge JUDGE.mjs [--quads 3000] [--keep FOLDER] [PART...]
//
// Prints one line per part and ends with 1 when one of them took longer than 30 s, is not valid, has less than 90 % quads,
// or lost more than 1 % of the sharp edges or corners where the part has clean ones.

import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';

const root = join(import.meta.dirname, '../..');
const kSecondsAllowed = 30;
const kDefaultParts = ['fandisk.obj', 'plate_holes.STL', 'rocker-arm.obj', 'spot.obj', 'circle_2d.obj', 'hinge.stl'];
const kCleanFeatures = ['fandisk.obj', 'plate_holes.STL', 'hinge.stl'];

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    models: { type: 'string' },
    judge: { type: 'string' },
    quads: { type: 'string', default: '3000' },
    keep: { type: 'string' },
  },
});
if (!values.models || !values.judge) {
  console.error('usage: run.mjs --models FOLDER --judge JUDGE.mjs [--quads 3000] [--keep FOLDER] [PART...]');
  process.exit(2);
}

const percent = (share) => (share === null || share === undefined ? '-' : `${(100 * share).toFixed(1)} %`);

/** What is wrong with a judged mesh; empty when nothing is. */
function faults(part, report) {
  const { quads, triangles } = report.composition;
  const found = report.validity.checks.filter(({ status }) => status === 'fail').map(({ name }) => name);
  if (quads < 0.9 * (quads + triangles)) found.push('less than 90 % quads');
  if (kCleanFeatures.includes(part)) {
    if (!(report.features.sharp.recall >= 0.99)) found.push('sharp edges lost');
    if (!(report.features.corners.recall >= 0.99)) found.push('corners lost');
  }
  return found;
}

function tryPart(part, folder) {
  const input = join(values.models, part);
  const output = join(folder, `${part.replace(/\.[^.]*$/, '')}.obj`);
  const begin = performance.now();
  const args = ['mesh', input, '-o', output, '--quads', values.quads, '--quiet'];
  const run = spawnSync(join(root, 'build/native/bin/qmcf'), args, {
    encoding: 'utf8',
    timeout: 1000 * kSecondsAllowed,
    killSignal: 'SIGKILL',
  });
  const seconds = (performance.now() - begin) / 1000;
  if (run.status !== 0) {
    const why = run.error?.code === 'ETIMEDOUT' ? `not done after ${kSecondsAllowed} s` : run.stderr.trim();
    return { seconds, faults: [why || `exit ${run.status ?? run.signal}`] };
  }
  const judged = spawnSync(process.execPath, [values.judge, '--json', '--samples', '5000', '--ref', input, output], {
    encoding: 'utf8',
    maxBuffer: 2 ** 28,
  });
  if (!judged.stdout.startsWith('{')) return { seconds, faults: [`not judged: ${judged.stderr.trim()}`] };
  const report = JSON.parse(judged.stdout);
  return { seconds, report, faults: faults(part, report) };
}

const folder = values.keep ?? mkdtempSync(join(tmpdir(), 'qmcf-corpus-'));
mkdirSync(folder, { recursive: true });
let failed = 0;
for (const part of positionals.length > 0 ? positionals : kDefaultParts) {
  const result = tryPart(part, folder);
  const figures = [`${part}: ${result.seconds.toFixed(1)} s`];
  if (result.report) {
    const { composition, regularity, quality, features } = result.report;
    figures.push(
      `${composition.quads} quads`,
      `${composition.triangles} triangles`,
      `regular ${percent(regularity.regular_share)}`,
      `scaled Jacobian ${quality.quads.scaled_jacobian.mean?.toFixed(3)}`,
      `sharp edges ${percent(features?.sharp.recall)}`,
      `corners ${percent(features?.corners.recall)}`,
    );
  }
  console.log(`${figures.join(', ')}: ${result.faults.length === 0 ? 'good' : `BAD (${result.faults.join('; ')})`}`);
  if (result.faults.length > 0) ++failed;
}
if (!values.keep) rmSync(folder, { recursive: true });
process.exit(failed > 0 ? 1 : 0);
