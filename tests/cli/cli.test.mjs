// The command line program as a user meets it: exit statuses, messages, files. QMCF is the program's path.
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, truncateSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { after, before, test } from 'node:test';

const program = process.env.QMCF && resolve(process.env.QMCF);
let folder;

before(() => {
  assert.ok(program, 'set QMCF to the program');
  folder = mkdtempSync(join(tmpdir(), 'qmcf-cli-'));
});
after(() => rmSync(folder, { recursive: true, force: true }));

/** Runs the program in the test's folder. */
function qmcf(...args) {
  const { status, stdout, stderr } = spawnSync(program, args, { cwd: folder, encoding: 'utf8' });
  return { status, stdout, stderr };
}

const put = (name, content) => writeFileSync(join(folder, name), content);
const get = (name) => readFileSync(join(folder, name), 'utf8');

/** A cube of side 2 with outward faces, each of n x n quadrilaterals. */
function cube(n = 1) {
  const lines = [];
  const faces = [];
  const ids = new Map();
  const vertex = (p) => {
    const key = p.join(' ');
    if (!ids.has(key)) {
      ids.set(key, ids.size + 1);
      lines.push(`v ${key}`);
    }
    return ids.get(key);
  };
  for (const [axis, side] of [0, 1, 2].flatMap((a) => [[a, -1], [a, 1]])) {
    const at = (i, j) => {
      const p = [0, 0, 0];
      p[axis] = side;
      p[(axis + 1) % 3] = -1 + (2 * i) / n;
      p[(axis + 2) % 3] = side * (-1 + (2 * j) / n);
      return vertex(p);
    };
    for (let i = 0; i < n; ++i) {
      for (let j = 0; j < n; ++j) faces.push(`f ${at(i, j)} ${at(i + 1, j)} ${at(i + 1, j + 1)} ${at(i, j + 1)}`);
    }
  }
  return [...lines, ...faces, ''].join('\n');
}

/** The numbers of elements that the last step of each face leaves, from docs/trace.md alone. */
function elementsOfTrace({ faces }) {
  return faces.map(({ steps }) => {
    let elements = new Set();
    for (const { boundary, elements: changed = [], removed = [] } of steps) {
      if (boundary) elements = new Set();
      removed.forEach((id) => assert.ok(elements.delete(id)));
      for (let i = 0; i < changed.length; i += 5) elements.add(changed[i]);
    }
    return elements.size;
  });
}

function binaryStl(triangles) {
  const bytes = Buffer.alloc(84 + 50 * triangles);
  bytes.writeUInt32LE(triangles, 80);
  for (let t = 0; t < triangles; ++t) {
    [0, 0, 1, t, 0, 0, t + 1, 0, 0, t, 1, 0].forEach((value, i) => bytes.writeFloatLE(value, 84 + 50 * t + 4 * i));
  }
  return bytes;
}

/** Exit 3, one sentence on stderr, nothing on stdout, no file. */
function assertRefused(name, content, pattern) {
  put(name, content);
  for (const args of [['mesh', name, '-o', 'refused.obj'], ['field', name, '-o', 'refused.vtu'], ['info', name]]) {
    const { status, stdout, stderr } = qmcf(...args);
    assert.equal(status, 3, stderr);
    assert.equal(stdout, '');
    assert.match(stderr, pattern);
    assert.equal(stderr.trimEnd().split('\n').length, 1, stderr);
    assert.ok(stderr.startsWith(`qmcf: ${name}: `), stderr);
  }
  assert.deepEqual(readdirSync(folder).filter((file) => file.startsWith('refused')), []);
}

test('version and help', () => {
  assert.match(qmcf('--version').stdout, /^qmcf \d+\.\d+\.\d+\n$/);
  const help = qmcf('--help');
  assert.equal(help.status, 0);
  assert.match(help.stdout, /mesh[\s\S]*field[\s\S]*check[\s\S]*info/);
  assert.match(qmcf('mesh', '--help').stdout, /--feature-angle/);
});

test('wrong usage is exit 2', () => {
  put('cube.obj', cube());
  const cases = [
    [],
    ['knead', 'cube.obj'],
    ['mesh', 'cube.obj'],
    ['mesh', 'cube.obj', '-o', 'a.obj', '--size', '1', '--quads', '5'],
    ['mesh', 'cube.obj', '-o', 'a.obj', '--size', 'big'],
    ['mesh', 'cube.obj', '-o', 'a.obj', '--size', '-1'],
    ['mesh', 'cube.obj', '-o', 'a.obj', '--size', 'nan'],
    ['mesh', 'cube.obj', '-o', 'a.obj', '--quads', '0'],
    ['mesh', 'cube.obj', '-o', 'a.obj', '--quads', '100', '--sizing', 'cube.obj'],
    ['mesh', 'cube.obj', '-o', 'a.obj', '--curvature', '0'],
    ['mesh', 'cube.obj', '-o', 'a.obj', '--feature-angle', '180'],
    ['mesh', 'cube.obj', '-o', 'a.obj', '--mode', 'fast'],
    ['mesh', 'cube.obj', '-o', 'a.dwg'],
    ['mesh', 'cube.obj', '-o', 'no/such/folder/a.obj'],
    ['mesh', 'cube.obj', '-o', 'a.obj', '--report', 'no/such/folder/a.json'],
    ['field', 'cube.obj', '-o', 'a.obj'],
  ];
  for (const args of cases) {
    const { status, stdout, stderr } = qmcf(...args);
    assert.equal(status, 2, `${args.join(' ')}: ${stderr}`);
    assert.notEqual(stderr, '');
    assert.equal(stdout, '');
  }
  assert.equal(existsSync(join(folder, 'a.obj')), false);
});

test('unusable input is exit 3 with a sentence', () => {
  const missing = qmcf('mesh', 'missing.obj', '-o', 'refused.obj');
  assert.equal(missing.status, 3);
  assert.match(missing.stderr, /missing\.obj: .*No such file/);
  assertRefused('empty.obj', '', /empty/);
  assertRefused('cut.stl', binaryStl(20).subarray(0, 500), /announces 20 triangles but ends after 8/);
  assertRefused('range.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 7\n', /Line 5: vertex 7 .* only 3 vertices/);
  assertRefused('nan.obj', 'v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n', /Line 2: the coordinate "nan" is not a finite/);
  assertRefused('flat.obj', 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n', /area/);
  assertRefused('part.step', 'ISO-10303-21;\nHEADER;\n', /STEP/);
});

test('info prints what was read and recovered', () => {
  put('cube.obj', cube());
  const text = qmcf('info', 'cube.obj');
  assert.equal(text.status, 0, text.stderr);
  assert.match(text.stdout, /OBJ, 8 vertices, 6 faces cut into 12 triangles/);
  assert.match(text.stdout, /1 body \(1 closed\), 6 faces, 6 loops, 12 edges \(12 sharp\), 8 vertices/);
  const info = JSON.parse(qmcf('info', 'cube.obj', '--json').stdout);
  assert.equal(info.input.polygons, 6);
  assert.equal(info.counts.edges.sharp, 12);
  assert.equal(info.faces.length, 6);
  assert.equal(qmcf('info', 'cube.obj', '--feature-angle', '120').stdout.includes('12 sharp'), false);
});

test('mesh writes a mesh that check finds valid, with report and summary', () => {
  put('cube.obj', cube());
  const run = qmcf('mesh', 'cube.obj', '-o', 'out.obj', '--size', '0.25', '--report', 'out.json');
  assert.equal(run.status, 0, run.stderr);
  assert.equal(run.stderr, '');
  assert.match(run.stdout, /Mesh .* quads/);
  const report = JSON.parse(get('out.json'));
  assert.equal(report.size, 0.25);
  assert.equal(report.quality.valid, true);
  const stages = ['read', 'repair', 'topology', 'sizing', 'background', 'field', 'front', 'cleanup', 'quality', 'write'];
  assert.deepEqual(Object.keys(report.seconds), stages);
  for (const seconds of Object.values(report.seconds)) assert.ok(seconds >= 0 && seconds < 60);
  assert.equal(get('out.obj').match(/^f /gm).length, report.quality.quads + report.quality.triangles);

  const check = qmcf('check', 'out.obj', '--ref', 'cube.obj');
  assert.equal(check.status, 0, check.stdout + check.stderr);
  assert.match(check.stdout, /Valid/);
  const quality = JSON.parse(qmcf('check', 'out.obj', '--ref', 'cube.obj', '--json').stdout);
  assert.equal(quality.sharpRecall, 1);
  assert.equal(quality.cornerRecall, 1);
  assert.equal(quality.eulerCharacteristic, 2);
  assert.equal(quality.quads, report.quality.quads);
});

test('of a rough surface without creases none are missed', () => {
  const [around, along] = [48, 24];
  const radius = (i, j) => 1 + 0.012 * Math.sin(3.7 * i + 1.3 * j) * Math.cos(2.9 * j - 1.7 * i);
  const vertices = ['v 0 0 1'];
  for (let j = 1; j < along; ++j) {
    for (let i = 0; i < around; ++i) {
      const [t, p, r] = [(Math.PI * j) / along, (2 * Math.PI * i) / around, radius(i, j)];
      vertices.push(`v ${r * Math.sin(t) * Math.cos(p)} ${r * Math.sin(t) * Math.sin(p)} ${r * Math.cos(t)}`);
    }
  }
  vertices.push('v 0 0 -1');
  const at = (i, j) => (j === 0 ? 1 : j === along ? vertices.length : 2 + (j - 1) * around + (i % around));
  const faces = [];
  for (let j = 0; j < along; ++j) {
    for (let i = 0; i < around; ++i) {
      if (j > 0) faces.push(`f ${at(i, j)} ${at(i, j + 1)} ${at(i + 1, j)}`);
      if (j + 1 < along) faces.push(`f ${at(i + 1, j)} ${at(i, j + 1)} ${at(i + 1, j + 1)}`);
    }
  }
  put('rough.obj', [...vertices, ...faces, ''].join('\n'));
  const { status, stdout, stderr } = qmcf('mesh', 'rough.obj', '-o', 'quads.obj', '--quads', '600', '--report', 'rough.json');
  assert.equal(status, 0, stderr);
  assert.ok(JSON.parse(get('rough.json')).quality.sharpRecall < 0.5);
  assert.match(stdout, /no creases: where triangles meet at more than the feature angle, that is taken as curvature/);
  assert.doesNotMatch(stdout, /of sharp edges/);
});

test('the same input gives the same bytes, and the extension chooses the format', () => {
  put('cube.obj', cube());
  const signs = { obj: '# Quad', vtu: '<?xml', ply: 'ply\n', stl: 'Quad', msh: '$MeshFormat', inp: '*HEADING', bdf: '$ Quad' };
  for (const [extension, sign] of Object.entries(signs)) {
    const files = [`one.${extension}`, `two.${extension}`];
    for (const file of files) {
      const run = qmcf('mesh', 'cube.obj', '-o', file, '--quads', '60', '--quiet');
      assert.deepEqual(run, { status: 0, stdout: '', stderr: '' });
    }
    assert.equal(get(files[0]), get(files[1]));
    assert.ok(get(files[0]).startsWith(sign), extension);
  }
});

test('check says what is wrong with a mesh and exits 1', () => {
  put('cube.obj', cube());
  put('open.obj', cube(4).replace(/f [^\n]*\n$/, ''));
  const { status, stdout } = qmcf('check', 'open.obj', '--ref', 'cube.obj');
  assert.equal(status, 1);
  assert.match(stdout, /INVALID/);
  assert.match(stdout, /fail +boundary: 4 edges/);
  put('turned.obj', cube(4).replace(/f (\d+) (\d+) (\d+) (\d+)/, 'f $4 $3 $2 $1'));
  assert.equal(qmcf('check', 'turned.obj').status, 1);
  put('fine.obj', cube(4));
  assert.equal(qmcf('check', 'fine.obj', '--ref', 'cube.obj').status, 0);
  put('pentagon.obj', 'v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5\n');
  assert.equal(qmcf('check', 'pentagon.obj').status, 3);
});

test('field writes directions and singularities', () => {
  put('cube.obj', cube());
  const run = qmcf('field', 'cube.obj', '-o', 'field.vtu', '--size', '0.5');
  assert.equal(run.status, 0, run.stderr);
  assert.match(run.stdout, /0 singularities/);
  assert.match(get('field.vtu'), /Name="direction" NumberOfComponents="3"/);
});

test('field writes constraints, magnitudes and the places of singularities', () => {
  const rim = Array.from({ length: 32 }, (_, i) => [Math.cos((Math.PI * i) / 16), Math.sin((Math.PI * i) / 16)]);
  put('disk.obj', ['v 0 0 0', ...rim.map(([x, y]) => `v ${x} ${y} 0`), ...rim.map((_, i) => `f 1 ${i + 2} ${((i + 1) % 32) + 2}`)].join('\n'));
  const run = qmcf('field', 'disk.obj', '-o', 'disk.vtu', '--size', '0.1');
  assert.equal(run.status, 0, run.stderr);
  const file = get('disk.vtu');
  const array = (name) => {
    const match = new RegExp(`Name="${name}"[^>]*>([^<]*)<`).exec(file);
    assert.ok(match, name);
    return match[1].trim().split(/\s+/).map(Number);
  };
  const points = Array.from({ length: array('size').length }, (_, i) => array('Points').slice(3 * i, 3 * i + 3));
  const [constrained, removed, magnitude, types] = ['constrained', 'removed', 'magnitude', 'types'].map(array);
  const indices = array('singularityIndex').filter((_, cell) => types[cell] === 1);
  assert.deepEqual(indices, [1, 1, 1, 1]);
  points.forEach(([x, y], i) => {
    const singular = i >= points.length - 4;
    const radius = Math.hypot(x, y);
    assert.equal(constrained[i], !singular && radius > 0.99 ? 1 : 0);
    assert.equal(removed[i], 0);
    if (singular) assert.ok(radius > 0.6 && radius < 0.95 && magnitude[i] === 0);
    else if (constrained[i]) assert.equal(magnitude[i], 1);
    else assert.ok(magnitude[i] > 0 && magnitude[i] <= 1);
  });
});

test('strokes turn the field', () => {
  put('sheet.obj', 'v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nf 1 2 3 4\n');
  put('strokes.json', '{"strokes": [{"from": [4, 4, 0], "to": [6, 6, 0]}]}');
  const run = qmcf('field', 'sheet.obj', '-o', 'strokes.vtu', '--size', '0.5', '--constraints', 'strokes.json');
  assert.equal(run.status, 0, run.stderr);
  const array = (name) => new RegExp(`Name="${name}"[^>]*>([^<]*)<`).exec(get('strokes.vtu'))[1].trim().split(/\s+/).map(Number);
  const [constrained, directions] = [array('constrained'), array('direction')];
  const drawn = constrained.flatMap((pin, v) => (pin === 5 ? [v] : []));
  assert.ok(drawn.length >= 3);
  for (const v of drawn) assert.ok(Math.abs(Math.abs(directions[3 * v]) - Math.SQRT1_2) < 1e-9);
});

test('a file that is too large to be read is refused before it is', () => {
  put('large.stl', '');
  truncateSync(join(folder, 'large.stl'), 3 * 2 ** 30);
  const run = qmcf('info', 'large.stl');
  assert.equal(run.status, 3, run.stderr);
  assert.match(run.stderr, /2 GiB/);
  rmSync(join(folder, 'large.stl'));
});

test('files that hold no strokes are refused', () => {
  put('sheet.obj', 'v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nf 1 2 3 4\n');
  const wrong = [
    '{', '[]', '{"lines": []}', '{"strokes": 1}', '{"strokes": [{"from": [0, 0], "to": [1, 1, 1]}]}',
    '{"strokes": [{"from": [1, 1, 1], "to": [1, 1, 1]}]}',
  ];
  for (const content of wrong) {
    put('strokes.json', content);
    const run = qmcf('mesh', 'sheet.obj', '-o', 'never.obj', '--constraints', 'strokes.json');
    assert.equal(run.status, 2, `${content}: ${run.stderr}`);
    assert.match(run.stderr, /strokes/);
  }
  assert.equal(qmcf('mesh', 'sheet.obj', '-o', 'never.obj', '--constraints', 'missing.json').status, 3);
});

test('the output replaces an old file only when it is complete', () => {
  put('cube.obj', cube());
  put('old.obj', 'the old content');
  put('bad.obj', 'v 0 0 0\nf 1 2 3\n');
  assert.equal(qmcf('mesh', 'bad.obj', '-o', 'old.obj').status, 3);
  assert.equal(get('old.obj'), 'the old content');
  assert.equal(qmcf('mesh', 'cube.obj', '-o', 'old.obj', '--size', '1').status, 0);
  assert.match(get('old.obj'), /^# Quad/);
  assert.deepEqual(readdirSync(folder).filter((file) => file.includes('.part-')), []);
});

test('Ctrl-C cancels: exit 4, one sentence, no output', async () => {
  put('cube.obj', cube(60));
  const child = spawn(program, ['mesh', 'cube.obj', '-o', 'cancelled.obj', '--quads', '2000000'], { cwd: folder });
  let stderr = '';
  child.stderr.on('data', (data) => (stderr += data));
  const ended = new Promise((resolve) => child.on('exit', (status, signal) => resolve({ status, signal })));
  await new Promise((resolve) => setTimeout(resolve, 1000));
  child.kill('SIGINT');
  assert.deepEqual(await ended, { status: 4, signal: null });
  assert.match(stderr, /cancelled/);
  assert.deepEqual(readdirSync(folder).filter((file) => file.startsWith('cancelled')), []);
});

test('info tells the state of the model as it was read, and what was repaired where', () => {
  // One quadrilateral of the cube is turned round, a triangle beside it is there twice, a vertex is unused.
  const lines = cube(2).trimEnd().split('\n');
  const turned = lines.findIndex((line) => line.startsWith('f '));
  lines[turned] = `f ${lines[turned].slice(2).split(' ').reverse().join(' ')}`;
  put('dirty.obj', [...lines, 'v 9 9 9', 'v 3 3 3', 'v 4 3 3', 'v 3 4 3', 'f -3 -2 -1', 'f -3 -2 -1', ''].join('\n'));
  const state = (...options) => JSON.parse(qmcf('info', 'dirty.obj', '--json', ...options).stdout);
  const repaired = state();
  assert.equal(repaired.statistics.triangles, 50);
  assert.equal(repaired.statistics.components, 2);
  assert.equal(repaired.statistics.duplicateTriangles, 1);
  assert.equal(repaired.statistics.unusedVertices, 1);
  assert.ok(repaired.statistics.misorientedEdges >= 2);
  const item = (info, defect) => info.repair.find((entry) => entry.defect === defect);
  assert.equal(item(repaired, 'duplicateTriangles').action, 'removed');
  assert.equal(item(repaired, 'misorientedTriangles').action, 'turned round');
  assert.equal(item(repaired, 'misorientedTriangles').count, item(repaired, 'misorientedTriangles').elements.length);

  const left = state('--no-repair');
  assert.deepEqual(left.statistics, repaired.statistics);
  assert.equal(left.counts.triangles, 50);
  assert.equal(item(left, 'duplicateTriangles').action, 'found');
  assert.equal(item(left, 'misorientedTriangles').action, 'found');
  const turnedRound = item(repaired, 'misorientedTriangles').elements;
  assert.deepEqual(turnedRound, [0, 1]);
  // The triangle that is there twice contradicts itself as long as both are there.
  assert.ok(turnedRound.every((id) => item(left, 'misorientedTriangles').elements.includes(id)));
  assert.match(qmcf('info', 'dirty.obj', '--no-repair').stdout, /^Defect +misoriented triangles: \d+ found$/m);
});

test('mesh --no-repair meshes the model as it is', () => {
  const gap = 1e-7; // Repair closes it, so that one sheet of six edges at most is left of two.
  const square = (x) => [`v ${x} 0 0`, `v ${x + 1} 0 0`, `v ${x + 1} 1 0`, `v ${x} 1 0`];
  put('gap.obj', [...square(0), ...square(1 + gap), 'f 1 2 3 4', 'f 5 6 7 8', ''].join('\n'));
  const components = (...options) => {
    assert.equal(qmcf('mesh', 'gap.obj', '-o', 'gap_out.obj', '--quads', '50', '--report', 'gap.json', ...options).status, 0);
    const report = JSON.parse(get('gap.json'));
    assert.equal(report.quality.valid, true);
    return report.quality.components;
  };
  assert.equal(components(), 1);
  assert.equal(components('--no-repair'), 2);
});

test('the history of the front is written, and ends with the elements of the mesh', () => {
  put('traced.obj', cube());
  const run = qmcf('mesh', 'traced.obj', '-o', 'traced.out.obj', '--quads', '150', '--trace', 'trace.json', '--quiet');
  assert.deepEqual(run, { status: 0, stdout: '', stderr: '' });
  const trace = JSON.parse(get('trace.json'));
  assert.equal(trace.format, 'qmcf-trace');
  assert.equal(trace.version, 1);
  assert.equal(trace.faces.length, 6);
  const kinds = new Set(trace.faces.flatMap(({ steps }) => steps.map(({ kind }) => kind)));
  for (const kind of ['start', 'quad', 'collision', 'cleanup']) assert.ok(kinds.has(kind), kind);
  const total = elementsOfTrace(trace).reduce((sum, n) => sum + n, 0);
  assert.equal(total, get('traced.out.obj').match(/^f /gm).length);
  const refused = qmcf('mesh', 'traced.obj', '-o', 'no.obj', '--trace', 'nowhere/trace.json', '--quiet');
  assert.equal(refused.status, 2);
  assert.ok(!existsSync(join(folder, 'no.obj')));
});

test('mesh --sizing-out writes a size per vertex of the file, and per different point of an STL', () => {
  put('sized.obj', cube(2));
  const run = qmcf('mesh', 'sized.obj', '-o', 'sized.quads.obj', '--size', '0.25', '--sizing-out', 'sizes.txt', '--report', 'sized.json', '--quiet');
  assert.equal(run.status, 0, run.stderr);
  const sizes = get('sizes.txt').trimEnd().split('\n').map(Number);
  assert.equal(sizes.length, 26);
  assert.ok(sizes.every((h) => Math.abs(h - 0.25) < 1e-12), String(sizes));
  const { meanAbsLog2, median } = JSON.parse(get('sized.json')).sizeConformity;
  assert.ok(meanAbsLog2 < 0.05 && Math.abs(median - 1) < 0.05, `${meanAbsLog2} ${median}`);

  const corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]];
  const facet = (...ids) => `facet normal 0 0 1\nouter loop\n${ids.map((i) => `vertex ${corners[i].join(' ')}\n`).join('')}endloop\nendfacet\n`;
  put('sized.stl', `solid s\n${facet(0, 1, 2)}${facet(0, 2, 3)}endsolid s\n`);
  assert.equal(qmcf('mesh', 'sized.stl', '-o', 'sized.quads.obj', '--sizing-out', 'sizes.txt', '--quiet').status, 0);
  assert.equal(get('sizes.txt').trimEnd().split('\n').length, 4);

  assert.equal(qmcf('mesh', 'sized.obj', '-o', 'sized.quads.obj', '--sizing-out', 'missing/sizes.txt').status, 2);
});

test('mesh --sizing-mesh writes the triangles that sizes are linear on', () => {
  put('sized.obj', cube(2));
  const args = ['mesh', 'sized.obj', '-o', 'sized.quads.obj', '--quads', '600', '--quiet', '--sizing-mesh'];
  const run = qmcf(...args, 'sizing.obj', '--sizing-out', 'sizes.txt', '--report', 'sized.json');
  assert.equal(run.status, 0, run.stderr);
  const vertices = get('sizing.obj').match(/^v .*$/gm).map((line) => line.split(' ').slice(1).map(Number));
  const triangles = get('sizing.obj').match(/^f .*$/gm).map((line) => line.split(' ').slice(1).map((v) => parseInt(v, 10) - 1));
  const sizes = get('sizes.txt').trimEnd().split('\n').map(Number);
  assert.equal(sizes.length, vertices.length);
  // One closed surface, whose faces share the nodes of their edges.
  assert.ok(triangles.every((t) => t.length === 3));
  assert.equal(vertices.length - triangles.length / 2, 2);
  // 24 squares of the area that 600 elements have.
  const { size } = JSON.parse(get('sized.json'));
  assert.ok(sizes.every((h) => Math.abs(Math.log(h / size)) < 0.35), `${Math.min(...sizes)} ${Math.max(...sizes)} ${size}`);

  assert.equal(qmcf(...args, 'sizing.obj').status, 2);
  assert.match(qmcf(...args, 'sizing.xyz', '--sizing-out', 'sizes.txt').stderr, /sizing\.xyz has no known extension/);
});

test('mesh --sizing takes a size per vertex of the file, as --sizing-out writes them', () => {
  // Elements grow along x from 0.1 to 0.4.
  put('graded.obj', cube(4));
  const points = get('graded.obj').match(/^v .*$/gm).map((line) => line.split(' ').slice(1).map(Number));
  const wanted = points.map(([x]) => 0.25 + 0.15 * x);
  put('graded.txt', `${wanted.join('\r\n')}\n\n`);
  const args = ['mesh', 'graded.obj', '--quiet', '--report', 'graded.json', '-o'];
  const run = qmcf(...args, 'graded.quads.obj', '--sizing', 'graded.txt', '--sizing-out', 'again.txt');
  assert.equal(run.status, 0, run.stderr);
  const again = get('again.txt').trimEnd().split('\n').map(Number);
  assert.ok(again.every((h, v) => Math.abs(h - wanted[v]) < 1e-9));
  const { quality, sizing, sizeConformity } = JSON.parse(get('graded.json'));
  // The integral of 1 / h^2: 4 / 0.1^2 + 4 / 0.4^2 + 4 sides of 2 / 0.15 * (1 / 0.1 - 1 / 0.4).
  assert.ok(Math.abs(quality.quads + quality.triangles - 825) < 120, String(quality.quads));
  assert.ok(quality.valid && sizing.bySizes > 70 && sizing.byCurvature === 0);
  assert.ok(sizeConformity.meanAbsLog2 < 0.3, String(sizeConformity.meanAbsLog2));

  assert.equal(qmcf(...args, 'bounded.quads.obj', '--sizing', 'graded.txt', '--size', '0.2', '--sizing-out', 'bounded.txt').status, 0);
  assert.ok(get('bounded.txt').trimEnd().split('\n').every((h, v) => Math.abs(h - Math.min(0.2, wanted[v])) < 1e-9));
  assert.equal(qmcf('field', 'graded.obj', '-o', 'graded.vtu', '--sizing', 'graded.txt', '--quiet').status, 0);
});

test('mesh --sizing of an STL numbers its different points', () => {
  const corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]];
  const facet = (...ids) => `facet normal 0 0 1\nouter loop\n${ids.map((i) => `vertex ${corners[i].join(' ')}\n`).join('')}endloop\nendfacet\n`;
  put('plate.stl', `solid s\n${facet(0, 1, 2)}${facet(0, 2, 3)}endsolid s\n`);
  put('plate.txt', '0.05\n0.1\n0.1\n0.05\n');
  const run = qmcf('mesh', 'plate.stl', '-o', 'plate.obj', '--sizing', 'plate.txt', '--sizing-out', 'plate.out.txt', '--quiet');
  assert.equal(run.status, 0, run.stderr);
  assert.deepEqual(get('plate.out.txt').trimEnd().split('\n').map(Number), [0.05, 0.1, 0.1, 0.05]);
});

test('a file of sizes that can not be used is exit 3 and named with its line', () => {
  put('cube.obj', cube());
  const cases = [
    ['1\n1\nabc\n1\n1\n1\n1\n1\n', /Line 3: "abc" is not a number/],
    ['1\n1 2\n', /Line 2: "1 2" is not a number/],
    ['1\n\n1\n', /Line 2: there is no number/],
    ['1\n1\n1\n0\n1\n1\n1\n1\n', /Line 4: "0" is not above 0/],
    ['-2\n', /Line 1: "-2" is not above 0/],
    ['1\ninf\n', /Line 2: "inf" is no finite number/],
    ['1\n1\n1\n', /3 lines, but the model has 8 vertices/],
    ['', /is empty/],
  ];
  for (const [content, pattern] of cases) {
    put('wrong.txt', content);
    const { status, stderr } = qmcf('mesh', 'cube.obj', '-o', 'refused.obj', '--sizing', 'wrong.txt');
    assert.equal(status, 3, stderr);
    assert.match(stderr, pattern);
    assert.ok(stderr.startsWith('qmcf: wrong.txt: '), stderr);
  }
  const missing = qmcf('mesh', 'cube.obj', '-o', 'refused.obj', '--sizing', 'nowhere.txt');
  assert.equal(missing.status, 3);
  assert.match(missing.stderr, /nowhere\.txt: .*No such file/);
  assert.equal(existsSync(join(folder, 'refused.obj')), false);
});

test('mesh --curvature keeps edges near curved faces', () => {
  // A cylinder of radius 1, open, in needles.
  const ring = Array.from({ length: 96 }, (_, i) => [Math.cos((i * Math.PI) / 48), Math.sin((i * Math.PI) / 48)]);
  const next = (i) => (i + 1) % 96;
  put('tube.obj', `${[0, 4].map((z) => ring.map((p) => `v ${p.join(' ')} ${z}\n`).join('')).join('')}${ring
    .map((_, i) => `f ${i + 1} ${next(i) + 1} ${next(i) + 97} ${i + 97}\n`).join('')}`);
  const run = qmcf('mesh', 'tube.obj', '-o', 'tube.quads.obj', '--size', '0.8', '--curvature', '0.01', '--report', 'tube.json', '--quiet');
  assert.equal(run.status, 0, run.stderr);
  const { sizing, quality } = JSON.parse(get('tube.json'));
  assert.equal(sizing.byCurvature, 192);
  assert.equal(sizing.floored, 0);
  // Chords of 2 sqrt(0.02) are in 22 divisions around, 14 along.
  assert.ok(Math.abs(quality.quads - 22 * 14) < 40, String(quality.quads));
  assert.ok(quality.largestDistance < 0.02, String(quality.largestDistance));
});

test('mesh --quads makes the number of elements asked for within 6 %', () => {
  put('counted.obj', cube(3));
  // Rows of a disc close in on its centre, so that the front alone would make 8 % too many.
  const rim = Array.from({ length: 200 }, (_, i) => [Math.cos((i * Math.PI) / 100), Math.sin((i * Math.PI) / 100)]);
  put('disc.obj', `v 0 0 0\n${rim.map((p) => `v ${p.join(' ')} 0\n`).join('')}${rim.map((_, i) => `f 1 ${i + 2} ${((i + 1) % 200) + 2}\n`).join('')}`);
  for (const [model, quads] of [['counted.obj', 1350], ['disc.obj', 1000], ['disc.obj', 2000]]) {
    assert.equal(qmcf('mesh', model, '-o', 'counted.quads.obj', '--quads', String(quads), '--report', 'counted.json', '--quiet').status, 0);
    const { quality } = JSON.parse(get('counted.json'));
    const made = quality.quads + quality.triangles;
    assert.ok(Math.abs(made / quads - 1) <= 0.06, `${model}: ${made} of ${quads}`);
  }
});
