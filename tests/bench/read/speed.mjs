// Megabytes per second of CPU time, one core, of our readers and of three.js's loaders on the same files, in turns.
//
//   node tests/bench/read/speed.mjs [TRIANGLES]     default 1,000,000; builds what it measures
//
// Exit status 1 if binary STL is read at less than 150 MB/s, OBJ at less than 60 MB/s, or any format slower than the peer.

import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';

const ROOT = resolve(import.meta.dirname, '../../..');
const LEAST = { 'binary STL': 150, OBJ: 60 };
const RUNS = '5';

/** A wavy torus of n x 2n quadrilaterals, cut in two: coordinates with as many digits as real ones have. */
function torus(n) {
  const points = [];
  for (let i = 0; i < n; ++i) {
    for (let j = 0; j < 2 * n; ++j) {
      const u = (2 * Math.PI * i) / n;
      const v = (Math.PI * j) / n;
      const r = 30 + (10 + Math.sin(9 * v)) * Math.cos(u);
      points.push([r * Math.cos(v), r * Math.sin(v), (10 + Math.cos(7 * v)) * Math.sin(u)]);
    }
  }
  const at = (i, j) => (i % n) * 2 * n + (j % (2 * n));
  const triangles = [];
  for (let i = 0; i < n; ++i) {
    for (let j = 0; j < 2 * n; ++j) {
      const [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
      triangles.push([a, b, c], [a, c, d]);
    }
  }
  return { points, triangles };
}

function binaryStl({ points, triangles }) {
  const bytes = Buffer.alloc(84 + 50 * triangles.length);
  bytes.writeUInt32LE(triangles.length, 80);
  triangles.forEach((corners, t) => {
    corners.forEach((corner, k) => points[corner].forEach((x, axis) => bytes.writeFloatLE(x, 96 + 50 * t + 12 * k + 4 * axis)));
  });
  return bytes;
}

function binaryPly({ points, triangles }) {
  const header = Buffer.from(
    `ply\nformat binary_little_endian 1.0\nelement vertex ${points.length}\nproperty float x\nproperty float y\n` +
      `property float z\nelement face ${triangles.length}\nproperty list uchar int vertex_indices\nend_header\n`,
  );
  const body = Buffer.alloc(12 * points.length + 13 * triangles.length);
  points.flat().forEach((x, i) => body.writeFloatLE(x, 4 * i));
  triangles.forEach((corners, t) => {
    const start = 12 * points.length + 13 * t;
    body[start] = 3;
    corners.forEach((corner, k) => body.writeInt32LE(corner, start + 1 + 4 * k));
  });
  return Buffer.concat([header, body]);
}

const obj = ({ points, triangles }) =>
  [
    ...points.map((p) => `v ${p.map((x) => x.toFixed(6)).join(' ')}`),
    ...triangles.map((corners) => `f ${corners.map((c) => c + 1).join(' ')}`),
    '',
  ].join('\n');

function asciiStl({ points, triangles }) {
  const facets = triangles.map((corners) => {
    const vertices = corners.map((c) => `vertex ${points[c].map((x) => x.toExponential(6)).join(' ')}`);
    return ['facet normal 0 0 0', 'outer loop', ...vertices, 'endloop', 'endfacet'].join('\n');
  });
  return ['solid torus', ...facets, 'endsolid torus', ''].join('\n');
}

function main() {
  const wanted = Number(process.argv[2] ?? 1_000_000);
  const model = torus(Math.max(4, Math.round(Math.sqrt(wanted / 4))));
  execFileSync('cmake', ['--preset', 'native', '--log-level=WARNING'], { cwd: ROOT, stdio: 'ignore' });
  execFileSync('cmake', ['--build', '--preset', 'native', '--target', 'read_speed'], { cwd: ROOT, stdio: 'ignore' });
  const folder = mkdtempSync(join(tmpdir(), 'qmcf-read-'));
  const files = {
    'binary STL': ['model.stl', binaryStl],
    'ASCII STL': ['ascii.stl', asciiStl],
    OBJ: ['model.obj', obj],
    'binary PLY': ['model.ply', binaryPly],
  };
  let failed = false;
  console.log('| Format | MB | triangles | ours, MB/s | three.js, MB/s |\n| --- | --- | --- | --- | --- |');
  try {
    for (const [name, [file, content]] of Object.entries(files)) {
      const path = join(folder, file);
      writeFileSync(path, content(model));
      const ours = JSON.parse(execFileSync(join(ROOT, 'build/native/bin/read_speed'), [path, RUNS]));
      const peer = JSON.parse(execFileSync(process.execPath, [join(import.meta.dirname, 'peer.mjs'), path, RUNS]));
      if (ours.triangles !== peer.triangles) throw new Error(`${name}: ${ours.triangles} triangles, the peer read ${peer.triangles}`);
      const speed = ({ bytes, seconds }) => bytes / seconds / 1e6;
      failed ||= speed(ours) < (LEAST[name] ?? 0) || speed(ours) < speed(peer);
      const cells = [name, ours.bytes / 1e6, ours.triangles, speed(ours), speed(peer)];
      console.log(`| ${cells.map((cell) => (typeof cell === 'number' ? Math.round(cell) : cell)).join(' | ')} |`);
      rmSync(path);
    }
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
  process.exitCode = failed ? 1 : 0;
}

main();
