// The installed package at work in Node.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { inProject, native, qmcf, root, sample } from './packed.mjs';

const { createMesher, outputFormats, QmcfError } = qmcf;

let mesher;
before(async () => (mesher = await createMesher()));
after(() => mesher.dispose());

const text = (bytes) => new TextDecoder().decode(bytes);
const withCode = (code) => (error) => error instanceof QmcfError && error.code === code && error.message.length > 10;

/** Positions and triangles of an OBJ with nothing but triangles. */
function parseObj(source) {
  const rows = text(source).split('\n').map((line) => line.trim().split(/\s+/));
  const numbers = (kind, parse) => rows.filter(([first]) => first === kind).flatMap((row) => row.slice(1).map(parse));
  return {
    positions: new Float64Array(numbers('v', Number)),
    triangles: new Uint32Array(numbers('f', (corner) => parseInt(corner, 10) - 1)),
  };
}

async function expectNativeBytes(file, mode) {
  const output = inProject(`${file}.native.obj`);
  const run = native('mesh', `${root}/samples/${file}`, '-o', output, '--quads', '800', '--mode', mode, '--quiet');
  assert.equal(run.status, 0, run.stderr);
  const mesh = await mesher.mesh(sample(file), { quads: 800, mode });
  assert.equal(mesh.report.quality.valid, true);
  assert.equal(mesh.elements.length, 4 * (mesh.report.quality.quads + mesh.report.quality.triangles));
  const ours = Buffer.from(await mesh.file('obj'));
  assert.ok(ours.length > 1000);
  assert.ok(ours.equals(readFileSync(output)), 'the files differ');
}

for (const { file } of JSON.parse(readFileSync(`${root}/samples/index.json`, 'utf8'))) {
  for (const mode of ['qmcf', 'qmorph']) {
    test(`${file}, ${mode}: the same bytes as from the native program`, () => expectNativeBytes(file, mode));
  }
}

test('buffers give the same mesh as the file they come from', async () => {
  const file = sample('t_sheets.obj');
  const fromFile = await mesher.mesh(file, { quads: 300 });
  const fromBuffers = await mesher.mesh(parseObj(file), { quads: 300 });
  assert.deepEqual(fromBuffers.positions, fromFile.positions);
  assert.deepEqual(fromBuffers.elements, fromFile.elements);
});

test('inspect recovers the faces and edges of a cylinder', async () => {
  const { faceNames, edgeKinds, triangleFace, triangles, edgeOffsets, edgePoints, report } = await mesher.inspect(
    sample('cylinder.obj'),
  );
  assert.equal(faceNames.length, 3);
  assert.deepEqual([...edgeKinds], ['sharp', 'sharp']);
  assert.equal(triangleFace.length, triangles.length / 3);
  assert.deepEqual(new Set(triangleFace), new Set([0, 1, 2]));
  assert.equal(edgeOffsets.at(-1), edgePoints.length);
  assert.equal(report.counts.bodies, 1);
  assert.equal(report.bodies[0].closed, true);
});

test('inspect finds the edge of three sheets', async () => {
  const { report } = await mesher.inspect(sample('t_sheets.obj'));
  assert.equal(report.counts.edges.nonManifold, 1);
});

test('the field of a torus has no net index, and its directions are tangent unit vectors', async () => {
  const { crosses, singularities, size } = await mesher.field(sample('torus.obj'), { quads: 1000 });
  assert.ok(size > 0);
  assert.equal(singularities.indices.reduce((sum, index) => sum + index, 0), 0);
  for (let i = 0; i < crosses.directions.length; i += 3) {
    const [d, n] = [crosses.directions, crosses.normals].map((a) => a.subarray(i, i + 3));
    assert.ok(Math.abs(Math.hypot(...d) - 1) < 1e-9);
    assert.ok(Math.abs(d[0] * n[0] + d[1] * n[1] + d[2] * n[2]) < 1e-9);
  }
});

test('streamlines of the field lie on the torus, and there is a pin or none for every cross', async () => {
  const { crosses, streamlines } = await mesher.field(sample('torus.obj'), { quads: 1000 });
  const { positions, offsets } = streamlines;
  assert.ok(offsets.length > 20);
  assert.equal(offsets.at(-1), positions.length / 3);
  assert.ok(offsets.every((offset, line) => line === 0 || offset >= offsets[line - 1] + 2));
  // The radii follow from the crosses; between their points the background's chords lie below the surface.
  const rings = (p) => Array.from({ length: p.length / 3 }, (_, i) => [Math.hypot(p[3 * i], p[3 * i + 1]), p[3 * i + 2]]);
  const around = rings(crosses.positions).map(([r]) => r);
  const [inner, outer] = [around.reduce((a, b) => Math.min(a, b)), around.reduce((a, b) => Math.max(a, b))];
  const [major, minor] = [(inner + outer) / 2, (outer - inner) / 2];
  for (const [r, z] of rings(positions)) {
    assert.ok(Math.abs(Math.hypot(r - major, z) / minor - 1) < 0.1);
  }
  assert.equal(crosses.removed.length, crosses.constrained.length);
});

test('the field of a capsule has eight quarter turns, four times its Euler characteristic', async () => {
  const { singularities } = await mesher.field(sample('capsule.obj'), { quads: 1000 });
  assert.equal(singularities.indices.reduce((sum, index) => sum + index, 0), 8);
});

test('progress passes through the stages in order', async () => {
  const seen = [];
  await mesher.mesh(sample('cylinder.obj'), { quads: 500 }, { onProgress: ({ stage }) => seen.push(stage) });
  const order = seen.map((stage) => qmcf.stages.indexOf(stage));
  assert.ok(seen.includes('read') && seen.includes('front') && seen.includes('quality'), seen.join());
  assert.ok(Math.min(...order) >= 0);
  assert.equal(order.indexOf(qmcf.stages.indexOf('front')) > order.indexOf(qmcf.stages.indexOf('field')), true);
});

test('every format can be written, and an unknown one is an error', async () => {
  const mesh = await mesher.mesh(sample('cylinder.obj'), { quads: 200 });
  for (const format of outputFormats) {
    assert.ok((await mesh.file(format)).length > 1000, format);
  }
  await assert.rejects(mesh.file('docx'), withCode('unsupportedOutput'));
});

test('an aborted run stops, and the next one is as if nothing had been', async () => {
  const input = sample('stepped_shaft.stl');
  const expected = await (await mesher.mesh(input, { quads: 500 })).file('obj');
  const stop = new AbortController();
  let late = 0;
  const run = mesher.mesh(input, { quads: 100_000 }, {
    signal: stop.signal,
    onProgress: ({ stage }) => {
      late += stop.signal.aborted ? 1 : 0;
      if (stage === 'background') stop.abort();
    },
  });
  await assert.rejects(run, withCode('cancelled'));
  const again = await (await mesher.mesh(input, { quads: 500 })).file('obj');
  assert.deepEqual(again, expected);
  assert.equal(late, 0);
});

test('a signal that was aborted before starts nothing', async () => {
  const run = mesher.mesh(sample('cylinder.obj'), {}, { signal: AbortSignal.abort() });
  await assert.rejects(run, withCode('cancelled'));
});

test('a waiting run can be cancelled without harm to the one before it', async () => {
  const stop = new AbortController();
  const first = mesher.mesh(sample('cylinder.obj'), { quads: 300 });
  const second = mesher.mesh(sample('cylinder.obj'), { quads: 300 }, { signal: stop.signal });
  stop.abort();
  await assert.rejects(second, withCode('cancelled'));
  assert.ok((await first).report.quality.quads > 100);
});

test('dispose settles what is under way and refuses what comes after', async () => {
  const other = await createMesher();
  const running = other.mesh(sample('torus.obj'), { quads: 50_000 });
  const waiting = other.inspect(sample('torus.obj'));
  other.dispose();
  await assert.rejects(running, withCode('cancelled'));
  await assert.rejects(waiting, withCode('cancelled'));
  await assert.rejects(other.inspect(sample('torus.obj')), withCode('cancelled'));
});

test('input is copied, or given away when asked for', async () => {
  const kept = new Uint8Array(sample('cylinder.obj'));
  await mesher.inspect(kept);
  assert.ok(kept.length > 0);
  const given = new Uint8Array(sample('cylinder.obj'));
  await mesher.inspect(given, {}, { transferInput: true });
  assert.equal(given.length, 0);
});

const brokenFiles = {
  emptyInput: '',
  truncatedInput: sample('plate_with_holes.stl').subarray(0, 4000),
  indexOutOfRange: 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n',
  nonFiniteCoordinate: 'v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n',
  unknownFormat: '<html>no mesh</html>',
};
for (const [code, content] of Object.entries(brokenFiles)) {
  test(`a broken file is ${code}, with the sentence of the command line`, async () => {
    const path = inProject(`${code}.${code === 'truncatedInput' ? 'stl' : 'obj'}`);
    writeFileSync(path, content);
    const run = native('mesh', path, '-o', inProject('never.obj'), '--quiet');
    assert.equal(run.status, 3);
    await assert.rejects(mesher.mesh(new Uint8Array(Buffer.from(content))), (error) => {
      assert.ok(withCode(code)(error), `${error.code}: ${error.message}`);
      assert.ok(run.stderr.includes(error.message), run.stderr);
      return true;
    });
  });
}

const wrongOptions = [
  { size: -1 },
  { size: Number.NaN },
  { size: '1' },
  { quads: 0 },
  { quads: 1.5 },
  { size: 1, quads: 100 },
  { featureAngle: 200 },
  { alignSharp: 1 },
  { strokes: [[0, 0, 0]] },
  { strokes: [{ from: [0, 0], to: [1, 0, 0] }] },
  { strokes: [{ from: [1, 0, 0], to: [1, 0, 0] }] },
  { sizes: 1 },
  { sizes: [0.1, 0.2] },
  { sizes: ['a'] },
  { sizes: [0.1], quads: 100 },
  { curvature: 0 },
  { curvature: '1' },
  { sises: [1] },
];
for (const options of wrongOptions) {
  test(`the options ${JSON.stringify(options)} are refused`, async () => {
    await assert.rejects(mesher.mesh(sample('cylinder.obj'), options), withCode('invalidOption'));
  });
}

test('sizes at the vertices are those of the native program, from buffers, a file and an STL', async () => {
  const file = sample('torus.obj');
  const buffers = parseObj(file);
  const sizes = Float64Array.from({ length: buffers.positions.length / 3 }, (_, v) => 2 + 0.05 * Math.abs(buffers.positions[3 * v]));
  const [path, output] = ['sizes.txt', 'sizes.native.obj'].map(inProject);
  writeFileSync(path, [...sizes].join('\n'));
  const run = native('mesh', `${root}/samples/torus.obj`, '-o', output, '--sizing', path, '--quiet');
  assert.equal(run.status, 0, run.stderr);
  const fromFile = await mesher.mesh(file, { sizes: [...sizes] });
  assert.ok(Buffer.from(await fromFile.file('obj')).equals(readFileSync(output)), 'the files differ');
  assert.ok(fromFile.report.sizing.bySizes > 0);
  const fromBuffers = await mesher.mesh(buffers, { sizes });
  assert.deepEqual(fromBuffers.elements, fromFile.elements);

  const facet = (...points) => `facet normal 0 0 1\nouter loop\n${points.map((p) => `vertex ${p} 0\n`).join('')}endloop\nendfacet\n`;
  const stl = Buffer.from(`solid s\n${facet('0 0', '1 0', '1 1')}${facet('0 0', '1 1', '0 1')}endsolid s\n`);
  const plate = await mesher.mesh(new Uint8Array(stl), { sizes: [0.1, 0.1, 0.1, 0.1] });
  assert.equal(plate.report.quality.quads, 100);
});

test('a chord error makes the same smaller elements as in the native program', async () => {
  const output = inProject('curvature.native.obj');
  const options = ['--size', '8', '--curvature', '0.1', '--quiet'];
  const run = native('mesh', `${root}/samples/capsule.obj`, '-o', output, ...options);
  assert.equal(run.status, 0, run.stderr);
  const [plain, fine] = [
    await mesher.mesh(sample('capsule.obj'), { size: 8 }),
    await mesher.mesh(sample('capsule.obj'), { size: 8, curvature: 0.1 }),
  ];
  assert.ok(Buffer.from(await fine.file('obj')).equals(readFileSync(output)), 'the files differ');
  assert.ok(fine.report.sizing.byCurvature > 0);
  assert.equal(plain.report.sizing.byCurvature, 0);
  assert.ok(fine.report.quality.meanDistance < plain.report.quality.meanDistance / 2);
});

test('with quadrilaterals only the last triangles are paired, or all elements are cut', async () => {
  const output = inProject('quads.native.obj');
  const run = native('mesh', `${root}/samples/plate_with_holes.stl`, '-o', output, '--quads', '800', '--all-quad', '--quiet');
  assert.equal(run.status, 0, run.stderr);
  const paired = await mesher.mesh(sample('plate_with_holes.stl'), { quads: 800, allQuad: true });
  assert.ok(Buffer.from(await paired.file('obj')).equals(readFileSync(output)), 'the files differ');
  assert.equal(paired.report.quality.triangles, 0);
  assert.equal(paired.report.elementsCut, false);
  // Under a flat pyramid lies a plate with the same four corners: one of two equal elements would be left out.
  const corners = ['0 0 0', '1 0 0', '1 1 0', '0 1 0', '0.5 0.5 0.01'];
  const layers = ['1 2 3', '1 3 4', '1 2 5', '2 3 5', '3 4 5', '4 1 5'];
  const lines = [...corners.map((p) => `v ${p}`), ...layers.map((f) => `f ${f}`), ''];
  const cut = await mesher.mesh(new TextEncoder().encode(lines.join('\n')), { size: 3, allQuad: true });
  assert.equal(cut.report.quality.valid, true);
  assert.equal(cut.report.quality.triangles, 0);
  assert.equal(cut.report.elementsCut, true);
});

test('sizes that fit the field are those of the native program', async () => {
  const output = inProject('fitted.native.obj');
  const run = native('mesh', `${root}/samples/wavy_sheet.obj`, '-o', output, '--quads', '800', '--quiet');
  assert.equal(run.status, 0, run.stderr);
  const fitted = await mesher.mesh(sample('wavy_sheet.obj'), { quads: 800 });
  assert.ok(Buffer.from(await fitted.file('obj')).equals(readFileSync(output)), 'the files differ');
  assert.equal(fitted.report.fittedSizes, true);
  const even = await mesher.mesh(sample('wavy_sheet.obj'), { quads: 800, fitSizes: false });
  assert.equal(even.report.fittedSizes, false);
  await assert.rejects(mesher.mesh(sample('wavy_sheet.obj'), { fitSizes: 1 }), withCode('invalidOption'));
  await assert.rejects(mesher.mesh(sample('wavy_sheet.obj'), { fitSizes: true, mode: 'qmorph' }), withCode('invalidOption'));
});

test('what is no model at all is refused', async () => {
  await assert.rejects(mesher.mesh({ positions: [0, 0, 0], triangles: [0, 0, 0] }), withCode('malformedInput'));
  await assert.rejects(mesher.mesh(undefined), withCode('malformedInput'));
  const uneven = { positions: new Float64Array(8), triangles: new Uint32Array(3) };
  await assert.rejects(mesher.mesh(uneven), withCode('malformedInput'));
});

test('a buffer that was given away before is told as such', async () => {
  const detached = (error) => withCode('malformedInput')(error) && /transferInput/.test(error.message);
  for (const transferInput of [true, false]) {
    const given = new Uint8Array(sample('cylinder.obj'));
    await mesher.inspect(given, {}, { transferInput: true });
    await assert.rejects(mesher.inspect(given, {}, { transferInput }), detached);
    await assert.rejects(mesher.inspect(given.buffer, {}, { transferInput }), detached);
  }
  // Given twice before either is sent: the second one waits in the queue for what is gone by then.
  const before = mesher.inspect(sample('torus.obj'));
  const twice = new Uint8Array(sample('cylinder.obj'));
  const [one, two] = [1, 2].map(() => mesher.inspect(twice, {}, { transferInput: true }));
  await assert.rejects(two, detached);
  assert.equal((await one).faceNames.length, 3);
  await before;
});

test('options that can not be cloned are refused by name, and the next run works', async () => {
  const strokes = new Proxy([{ from: [0, 0, 0], to: [1, 0, 0] }], {});
  for (const options of [{ strokes }, { strokes: () => {} }]) {
    const run = mesher.mesh(sample('cylinder.obj'), options);
    await assert.rejects(run, (error) => withCode('invalidOption')(error) && error.message.includes('strokes'));
  }
  assert.equal((await mesher.inspect(sample('cylinder.obj'))).faceNames.length, 3);
});

test('the WebAssembly may come from a path, a file address or a data address', async () => {
  const path = inProject('node_modules/qmcf/dist/qmcf.wasm');
  const data = `data:application/wasm;base64,${readFileSync(path, 'base64')}`;
  for (const wasm of [path, pathToFileURL(path).href, pathToFileURL(path), data, new URL(data)]) {
    (await createMesher({ wasm })).dispose();
  }
});

test('WebAssembly that can not be loaded is told', async () => {
  await assert.rejects(createMesher({ wasm: '/no/such/file.wasm' }), withCode('internal'));
  await assert.rejects(createMesher({ wasm: new Uint8Array(8) }), withCode('internal'));
});

test('one compiled module serves several meshers, and using disposes of them', async () => {
  const wasm = await WebAssembly.compile(readFileSync(inProject('node_modules/qmcf/dist/qmcf.wasm')));
  const [one, two] = await Promise.all([createMesher({ wasm }), createMesher({ wasm })]);
  const [a, b] = await Promise.all([one, two].map((m) => m.inspect(sample('cylinder.obj'))));
  assert.deepEqual(a.positions, b.positions);
  one[Symbol.dispose]();
  two.dispose();
  await assert.rejects(one.inspect(sample('cylinder.obj')), withCode('cancelled'));
});

test('the history of the front is kept when asked for, and leads to the mesh', async () => {
  const model = sample('bracket_with_fillets.stl');
  const plain = await mesher.mesh(model, { quads: 400 });
  const traced = await mesher.mesh(model, { quads: 400, trace: true });
  assert.equal(plain.trace, undefined);
  assert.deepEqual(traced.elements, plain.elements);
  const { format, faces, unit } = traced.trace;
  assert.equal(format, 'qmcf-trace');
  assert.ok(unit > 0);
  assert.equal(faces.length, traced.report.faces.length);
  for (const { face, steps } of faces) {
    let elements = new Set();
    for (const { boundary, elements: changed = [], removed = [] } of steps) {
      if (boundary) elements = new Set();
      removed.forEach((id) => assert.ok(elements.delete(id)));
      for (let i = 0; i < changed.length; i += 5) elements.add(changed[i]);
    }
    const { quads, triangles } = traced.report.faces[face];
    assert.equal(elements.size, quads + triangles);
  }
  const output = inProject('traced.json');
  const run = native('mesh', `${root}/samples/bracket_with_fillets.stl`, '-o', inProject('traced.obj'), '--quads', '400', '--trace', output, '--quiet');
  assert.equal(run.status, 0, run.stderr);
  assert.deepEqual(traced.trace, JSON.parse(readFileSync(output, 'utf8')));
});
