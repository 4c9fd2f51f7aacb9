// The committed sample files are what the generator writes, and they are the surfaces they claim to be.

import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { generate } from '../../samples/generate.mjs';
import { samples } from '../../samples/lib/parts.mjs';

const folder = join(import.meta.dirname, '../../samples');

function readObj(bytes) {
  const rows = bytes.toString().split('\n').map((line) => line.split(' '));
  const numbers = (keyword) => rows.filter(([first]) => first === keyword).map((row) => row.slice(1).map(Number));
  return { positions: numbers('v'), triangles: numbers('f').map((corners) => corners.map((v) => v - 1)) };
}

function readBinaryStl(bytes) {
  const count = bytes.readUInt32LE(80);
  assert.equal(bytes.length, 84 + 50 * count);
  const positions = [];
  const indexOf = new Map();
  const triangles = Array.from({ length: count }, (_, i) =>
    [12, 24, 36].map((offset) => {
      const point = [0, 4, 8].map((k) => bytes.readFloatLE(84 + 50 * i + offset + k));
      const key = point.join();
      if (!indexOf.has(key)) indexOf.set(key, positions.push(point) - 1);
      return indexOf.get(key);
    }),
  );
  return { positions, triangles };
}

const read = (file) => {
  const bytes = readFileSync(join(folder, file));
  return file.endsWith('.obj') ? readObj(bytes) : readBinaryStl(bytes);
};

/** Per undirected edge: how many triangles run along it in the one and in the other direction. */
function edgeUses(triangles) {
  const uses = new Map();
  for (const corners of triangles) {
    corners.forEach((a, i) => {
      const b = corners[(i + 1) % 3];
      const key = a < b ? `${a},${b}` : `${b},${a}`;
      if (!uses.has(key)) uses.set(key, [0, 0]);
      ++uses.get(key)[a < b ? 0 : 1];
    });
  }
  return uses;
}

const determinant = ([a, b, c]) =>
  a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);

function smallestArea({ positions, triangles }) {
  return Math.min(
    ...triangles.map((corners) => {
      const [a, b, c] = corners.map((v) => positions[v]);
      const [u, v] = [b.map((x, k) => x - a[k]), c.map((x, k) => x - a[k])];
      return Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
    }),
  );
}

test('the generator writes the committed files, byte for byte, and no others', () => {
  const made = generate();
  for (const { file, bytes } of made) assert.ok(readFileSync(join(folder, file)).equals(bytes), file);
  const present = readdirSync(folder).filter((file) => /\.(obj|stl|json)$/.test(file));
  assert.deepEqual(present.sort(), made.map(({ file }) => file).sort());
});

test('no file is larger than 600 kB', () => {
  for (const { file, bytes } of generate()) assert.ok(bytes.length < 600_000, file);
});

for (const sample of samples) {
  test(`${sample.file}: closed or open, orientation and Euler characteristic`, () => {
    const mesh = read(sample.file);
    const uses = edgeUses(mesh.triangles);
    const open = [...uses.values()].filter(([forward, backward]) => forward !== 1 || backward !== 1).length;
    assert.equal(open === 0, sample.closed, `${open} edges do not join two triangles head to tail`);
    assert.equal(new Set(mesh.triangles.flat()).size, mesh.positions.length, 'a vertex is unused');
    assert.equal(mesh.positions.length - uses.size + mesh.triangles.length, sample.euler);
    assert.ok(smallestArea(mesh) > 1e-4, 'a triangle has no area');
  });
}

for (const sample of samples.filter(({ closed }) => closed)) {
  test(`${sample.file}: volume`, () => {
    const { positions, triangles } = read(sample.file);
    const volume = triangles.reduce((sum, corners) => sum + determinant(corners.map((v) => positions[v])) / 6, 0);
    assert.ok(volume > 0, 'the surface is inside out');
    if (sample.volume) assert.ok(Math.abs(volume / sample.volume - 1) < 0.015, `${volume} instead of ${sample.volume}`);
  });
}

test('t_sheets.obj: three triangles meet in each edge of the seam, and nowhere else', () => {
  const { positions, triangles } = read('t_sheets.obj');
  for (const [key, [forward, backward]] of edgeUses(triangles)) {
    const onSeam = key.split(',').every((v) => positions[v][0] === 0 && positions[v][2] === 0);
    assert.equal(forward + backward === 3, onSeam, key);
  }
});
