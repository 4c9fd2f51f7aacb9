// Remakes the paper's figures of cross fields on parts of our own, and writes their figures into docs/algorithm.md:
//
//   cmake --build --preset native --target field_study
//   node docs/figures/make.mjs [FANDISK.obj]
//
// The paper's Figure 1 shows the fandisk, which is not a part of this repository: its picture is made anew only where
// the model's file is given.

import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { encodeSheet } from '../../tests/tools/lib/raster.mjs';
import { drawField } from './draw.mjs';
import { parts } from './parts.mjs';

const ROOT = resolve(import.meta.dirname, '../..');
const [WIDTH, HEIGHT] = [460, 420];
const KNOEPPEL = 'boundary=0,sharp=0,nonManifold=0,solver=leastSquares,diffuse=0,shift=-1';
const PAPER = 'solver=leastSquares,diffuse=0,cancelDistance=0,guidance=10';
const PAPER_PINS = 'pinCurvature=1,pinAnisotropy=0,pinTurn=0,denseBoundary=0,cancelDistance=0';

/** Per figure: panels of [what it shows, part or sample, options of the field, further settings]. */
const FIGURES = [
  ['figure3', 2, [
    ['3a flat, nothing pinned', 'flatPart', 'boundary=0', { eye: [0, 0, 1] }],
    ['flat, boundary pinned', 'flatPart', 'default', { eye: [0, 0, 1] }],
    ['3b curvature alone', 'obliqueTube', KNOEPPEL, { eye: [1, -1, 0.45], quads: 1500 }],
    ['curvature and boundary', 'obliqueTube', 'default', { eye: [1, -1, 0.45], quads: 1500 }],
    ['3c boundary alone', 'obliqueTube', 'curvature=0', { eye: [0.2, -1, 0.3], quads: 1500 }],
    ['boundary and curvature', 'obliqueTube', 'pinCurvature=1,denseBoundary=0', { eye: [0.2, -1, 0.3], quads: 1500 }],
  ]],
  ['figure4', 2, [
    ['4b edge not pinned', 'tubeOnSheet', 'nonManifold=0', { eye: [0.5, -1, 0.9] }],
    ['4c edge pinned', 'tubeOnSheet', 'default', { eye: [0.5, -1, 0.9] }],
  ]],
  ['figure5', 2, [
    ['5 alpha = 1 everywhere', 'obliqueTube', `${PAPER},mask=0`, { eye: [1, -1, 0.45], quads: 400, spacing: 1 }],
    ['5 alpha = 0 on N1', 'obliqueTube', PAPER, { eye: [1, -1, 0.45], quads: 400, spacing: 1 }],
  ]],
  ['figure6', 2, [
    ['6a sphere, all pins', 'sphere', `${PAPER_PINS},removeInconsistent=0`, { eye: [0.6, -1, 0.9], quads: 1000, pins: true }],
    ['6b inconsistent removed', 'sphere', PAPER_PINS, { eye: [0.6, -1, 0.9], quads: 1000, pins: true }],
    ['6c sheet, all pins', 'wavy_sheet.obj', `${PAPER_PINS},removeInconsistent=0`, { eye: [0.3, -1, 1.6], quads: 600, pins: true }],
    ['6d inconsistent removed', 'wavy_sheet.obj', PAPER_PINS, { eye: [0.3, -1, 1.6], quads: 600, pins: true }],
  ]],
];
const FANDISK = ['figure1', 1, [['1c fandisk', null, 'default', { eye: [-0.8, -1, 0.5], width: 2 * WIDTH, height: 640 }]]];

const folder = mkdtempSync(join(tmpdir(), 'qmcf-figures-'));

function fileOf(name) {
  if (!(name in parts)) return join(ROOT, 'samples', name);
  const file = join(folder, `${name}.obj`);
  writeFileSync(file, parts[name]().toObj(name));
  return file;
}

function makePanel([title, name, variant, settings], model) {
  const output = join(folder, 'drawing.json');
  const args = [model ?? fileOf(name), '--draw', output, '--spacing', String(settings.spacing ?? 1.6), '--quads', String(settings.quads ?? 1500), variant];
  const { results } = JSON.parse(execFileSync(join(ROOT, 'build/native/bin/field_study'), args, { encoding: 'utf8' }));
  const [figures] = results;
  const text = `energy ${figures.energy.toFixed(1)}   +${figures.positive} -${figures.negative}`;
  const drawing = JSON.parse(readFileSync(output, 'utf8'));
  const raster = drawField(drawing, { width: WIDTH, height: HEIGHT, ...settings, caption: [title, text] });
  return { title, variant, figures, raster };
}

function makeFigure([name, columns, panels], model) {
  const made = panels.map((panel) => makePanel(panel, model));
  writeFileSync(join(ROOT, `docs/images/field-${name}.png`), encodeSheet(null, made.map(({ raster }) => raster), columns));
  return made;
}

function figureTable(panels) {
  const rows = panels.map(({ title, variant, figures: f }) => {
    const curvature = f.curvatureDeviation === null ? '–' : f.curvatureDeviation.toFixed(1);
    return `| ${title} | \`${variant}\` | ${f.energy.toFixed(1)} | ${f.positive} / ${f.negative} | ${f.removed} | ${curvature} |`;
  });
  return ['| panel | options | energy (Eq. 1) | + / − | pins removed | from curvature ° |', '| --- | --- | ---: | ---: | ---: | ---: |', ...rows].join('\n');
}

try {
  const panels = FIGURES.flatMap((figure) => makeFigure(figure));
  const fandisk = process.argv[2];
  if (fandisk) makeFigure(FANDISK, fandisk);
  const document = join(ROOT, 'docs/algorithm.md');
  const text = readFileSync(document, 'utf8');
  const [begin, end] = ['<!-- field figures -->\n', '<!-- end of field figures -->'];
  const [from, to] = [text.indexOf(begin), text.indexOf(end)];
  if (from < 0 || to < from) throw new Error('docs/algorithm.md has no place for the table');
  writeFileSync(document, `${text.slice(0, from + begin.length)}\n${figureTable(panels)}\n\n${text.slice(to)}`);
} finally {
  rmSync(folder, { recursive: true });
}
