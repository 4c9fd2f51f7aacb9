// The cross field of every model of a folder, with each way to solve it:
//
//   cmake --build --preset native --target field_study
//   node tests/bench/field/corpus.mjs [FOLDER ...] [--json FILE] [--from FILE] [--only REGEX] [--write]
//
// --json keeps the results, --from takes them from there, --write puts the tables between the markers in docs/algorithm.md
// and docs/field-corpus.md.
// Exit status: 0 if of every model that can be used Gauss-Bonnet holds, the field deviates from boundaries and sharp
// edges by less than 1e-6 degrees and every number is one; else 1.

import { spawnSync } from 'node:child_process';
import { existsSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { parseArgs } from 'node:util';

const ROOT = resolve(import.meta.dirname, '../../..');
const LARGEST_DEVIATION = 1e-6; // degrees
const SECONDS = 300;

const VARIANTS = [
  ['eliminate, diffuse (default)', 'default'],
  ['eliminate', 'diffuse=0'],
  ['least squares, diffuse', 'solver=leastSquares'],
  ['least squares', 'solver=leastSquares,diffuse=0'],
  ['eliminate, diffuse, pairs kept', 'cancelDistance=0'],
  ['eliminate, pairs kept', 'diffuse=0,cancelDistance=0'],
  ['least squares, pairs kept (the paper)', 'solver=leastSquares,diffuse=0,cancelDistance=0'],
  ['finite elements, diffuse', 'energy=finiteElements'],
  ['finite elements', 'energy=finiteElements,diffuse=0'],
  ['finite elements, s = 0.5', 'energy=finiteElements,smoothness=0.5,diffuse=0'],
  ['finite elements, s = −0.5', 'energy=finiteElements,smoothness=-0.5,diffuse=0'],
  ['curvature pinned', 'pinCurvature=1'],
  ['curvature pinned on every face', 'pinCurvature=1,denseBoundary=0'],
  ['no curvature', 'curvature=0'],
];

function study(file) {
  const run = spawnSync(join(ROOT, 'build/native/bin/field_study'), [file, ...VARIANTS.map(([, variant]) => variant)], {
    encoding: 'utf8',
    timeout: 1000 * SECONDS,
    killSignal: 'SIGKILL',
    maxBuffer: 1 << 26,
  });
  if (run.status === 0) return JSON.parse(run.stdout);
  return { refused: run.status === 3, message: run.stderr?.trim() || `ended by ${run.signal ?? `status ${run.status}`}` };
}

function findModels(folders, only) {
  const isModel = (name) => /\.(obj|stl|ply)$/i.test(name) && (!only || new RegExp(only).test(name));
  return folders.flatMap((folder) => readdirSync(folder).filter(isModel).sort().map((name) => [name, join(folder, name)]));
}

function complaints(result) {
  if (!result.results) return result.refused ? [] : [result.message];
  const [field] = result.results;
  return [
    field.indexDefect !== 0 && `Gauss-Bonnet broken by ${field.indexDefect}`,
    !(field.boundaryDeviation < LARGEST_DEVIATION) && `deviates by ${field.boundaryDeviation} degrees`,
    field.notFinite !== 0 && `${field.notFinite} values are no numbers`,
  ].filter(Boolean);
}

const row = (cells) => `| ${cells.join(' | ')} |`;
const table = (head, rows) => [row(head), row(head.map((_, i) => (i === 0 ? '---' : '---:'))), ...rows.map(row)].join('\n');

function modelTable(models) {
  const rows = models.map(([name, result]) => {
    if (!result.results) return [name, `refused: ${result.message}`, ...Array(7).fill('')];
    const f = result.results[0];
    const deviation = f.boundaryDeviation === 0 ? '0' : f.boundaryDeviation.toExponential(0);
    return [
      name, result.faces, f.vertices, `${f.positive} / ${f.negative}`, f.pairs, f.energy.toFixed(1), deviation,
      f.indexDefect === 0 ? 'holds' : 'BROKEN', f.seconds.toFixed(2),
    ];
  });
  return table(['part', 'faces', 'vertices', '+ / −', 'pairs', 'energy', 'deviation °', 'Gauss–Bonnet', 'CPU s'], rows);
}

function variantTable(models) {
  const used = models.map(([, result]) => result).filter((result) => result.results);
  const rows = VARIANTS.map(([title], i) => {
    const all = used.map((result) => result.results[i]);
    const total = (pick) => all.reduce((sum, f) => sum + pick(f), 0);
    // Parts whose field has hardly any energy say nothing about ratios.
    const ratios = used.filter((r) => r.results[0].energy > 1).map((r) => Math.log(r.results[i].energy / r.results[0].energy));
    const ratio = Math.exp(ratios.reduce((sum, x) => sum + x, 0) / ratios.length);
    const deviation = total((f) => (f.curvatureDeviation ?? 0) * f.reliable) / total((f) => f.reliable);
    return [
      title, `${total((f) => f.positive)} / ${total((f) => f.negative)}`, total((f) => f.pairs), total((f) => f.nearBoundary),
      ratio.toFixed(3), deviation.toFixed(1), total((f) => f.seconds).toFixed(1),
    ];
  });
  return table(['way', '+ / −', 'pairs', 'near an edge', 'energy', 'from curvature °', 'CPU s'], rows);
}

function writeTable(file, name, content) {
  const text = readFileSync(file, 'utf8');
  const [begin, end] = [`<!-- ${name} -->\n`, `<!-- end of ${name} -->`];
  const [from, to] = [text.indexOf(begin), text.indexOf(end)];
  if (from < 0 || to < from) throw new Error(`${file} has no place for ${name}`);
  writeFileSync(file, `${text.slice(0, from + begin.length)}\n${content}\n\n${text.slice(to)}`);
}

const text = { type: 'string' };
const { values, positionals } = parseArgs({ allowPositionals: true, options: { json: text, from: text, only: text, write: { type: 'boolean' } } });
const shared = join(ROOT, '../shared/models');
const folders = positionals.length ? positionals : [existsSync(shared) ? shared : join(ROOT, 'samples')];
const models = values.from
  ? JSON.parse(readFileSync(values.from, 'utf8'))
  : findModels(folders, values.only).map(([name, file]) => {
      const result = study(file);
      console.error(name, result.results ? 'done' : result.message);
      return [name, result];
    });
if (values.json) writeFileSync(values.json, JSON.stringify(models));
if (values.write) {
  writeTable(join(ROOT, 'docs/field-corpus.md'), 'field corpus', modelTable(models));
  writeTable(join(ROOT, 'docs/algorithm.md'), 'field variants', variantTable(models));
} else {
  console.log(`${modelTable(models)}\n\n${variantTable(models)}`);
}
for (const [name, result] of models) {
  for (const complaint of complaints(result)) {
    console.error(`${name}: ${complaint}`);
    process.exitCode = 1;
  }
}
