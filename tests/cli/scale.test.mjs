// Units, place and tessellation must not matter: the same part, smaller, larger, elsewhere or made of other triangles,
// gets the same mesh or one as good. QMCF is the program.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { after, before, test } from 'node:test';

const program = process.env.QMCF && resolve(process.env.QMCF);
const samples = join(import.meta.dirname, '../../samples');
const QUADS = 800;
let folder;

before(() => {
  assert.ok(program, 'set QMCF to the program');
  folder = mkdtempSync(join(tmpdir(), 'qmcf-scale-'));
});
after(() => rmSync(folder, { recursive: true, force: true }));

/** The triangles of a binary STL file as lists of three points. */
function readStl(file) {
  const bytes = readFileSync(join(samples, file));
  const point = (at) => [0, 4, 8].map((k) => bytes.readFloatLE(at + k));
  return Array.from({ length: bytes.readUInt32LE(80) }, (_, t) => [12, 24, 36].map((k) => point(84 + 50 * t + k)));
}

/** Meshes the part with every coordinate mapped; OBJ has them in double precision. */
function mesh(triangles, map) {
  const vertices = triangles.flat().map((p) => `v ${map(p).join(' ')}`);
  const faces = triangles.map((_, t) => `f ${3 * t + 1} ${3 * t + 2} ${3 * t + 3}`);
  writeFileSync(join(folder, 'part.obj'), [...vertices, ...faces, ''].join('\n'));
  const args = ['mesh', 'part.obj', '-o', 'mesh.obj', '--quads', `${QUADS}`, '--quiet', '--report', 'mesh.json'];
  const { status, stderr } = spawnSync(program, args, { cwd: folder, encoding: 'utf8' });
  assert.equal(status, 0, stderr);
  const lines = readFileSync(join(folder, 'mesh.obj'), 'utf8').split('\n');
  return {
    points: lines.filter((line) => line.startsWith('v ')).map((line) => line.slice(2).split(' ').map(Number)),
    rest: lines.filter((line) => !line.startsWith('v ')),
    report: JSON.parse(readFileSync(join(folder, 'mesh.json'), 'utf8')),
  };
}

for (const file of ['plate_with_holes.stl', 'bracket_with_fillets.stl']) {
  const triangles = readStl(file);
  const original = () => mesh(triangles, (p) => p);

  test(`${file}: a power of two as scale changes nothing but the scale`, () => {
    const { points, rest, report } = original();
    assert.ok(report.quality.valid);
    for (const scale of [2 ** -100, 2 ** 30]) {
      const scaled = mesh(triangles, (p) => p.map((x) => x * scale));
      assert.deepEqual(scaled.rest, rest, `connectivity at ${scale}`);
      assert.deepEqual(scaled.points, points.map((p) => p.map((x) => x * scale)), `points at ${scale}`);
      assert.equal(scaled.report.size, report.size * scale);
    }
  });

  const places = {
    'scaled by 1e-30': [1e-30, (p) => p.map((x) => x * 1e-30)],
    'scaled by 1e9': [1e9, (p) => p.map((x) => x * 1e9)],
    'a million units away': [1, ([x, y, z]) => [x + 2 ** 20, y - 2 ** 20, z + 2 ** 20]],
  };
  for (const [name, [scale, map]] of Object.entries(places)) {
    test(`${file} ${name} meshes as well`, () => {
      const reference = original().report;
      const { report } = mesh(triangles, map);
      assert.ok(report.quality.valid, JSON.stringify(report.quality.checks.filter((check) => check.status === 'fail')));
      assert.equal(report.faces.length, reference.faces.length);
      assert.equal(report.fieldSingularities, reference.fieldSingularities);
      const elements = (r) => r.quality.quads + r.quality.triangles;
      // The size is corrected by the number of elements made, which other roundings change by a row of elements.
      for (const made of [report, reference]) {
        assert.ok(Math.abs(elements(made) / QUADS - 1) < 0.07, `${elements(made)} for ${QUADS}`);
      }
      assert.ok(Math.abs(report.size / scale / reference.size - 1) < 0.07);
      assert.ok(report.quality.scaledJacobian.mean > reference.quality.scaledJacobian.mean - 0.01);
      assert.ok(Math.abs(report.quality.sharpRecall - reference.quality.sharpRecall) < 1e-3);
    });
  }
}

/** A cylinder of radius 1 and height 3: its wall of rows x segments quadrilaterals cut in two, its ends of fans. */
function cylinder(segments, rows) {
  const at = (i, j) => {
    const angle = (2 * Math.PI * (i % segments)) / segments;
    return [Math.cos(angle), Math.sin(angle), (3 * j) / rows];
  };
  const triangles = [];
  for (let i = 0; i < segments; ++i) {
    for (let j = 0; j < rows; ++j) {
      const [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
      triangles.push([a, b, c], [a, c, d]);
    }
    triangles.push([at(i + 1, 0), at(i, 0), [0, 0, 0]], [at(i, rows), at(i + 1, rows), [0, 0, 3]]);
  }
  return triangles;
}

test('a cylinder of needles meshes as well as one of small triangles', () => {
  const needles = mesh(cylinder(96, 1), (p) => p).report;
  const fine = mesh(cylinder(96, 46), (p) => p).report;
  for (const report of [needles, fine]) {
    assert.ok(report.quality.valid);
    assert.equal(report.faces.length, 3);
    assert.ok(report.quality.scaledJacobian.mean > 0.97);
  }
  assert.equal(needles.fieldSingularities, fine.fieldSingularities);
  assert.ok(Math.abs(needles.quality.quads / fine.quality.quads - 1) < 0.03);
  assert.ok(Math.abs(needles.quality.scaledJacobian.mean - fine.quality.scaledJacobian.mean) < 0.01);
  assert.ok(Math.abs(needles.quality.regularShare - fine.quality.regularShare) < 0.02);
});
