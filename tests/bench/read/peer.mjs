// The same for three.js's loaders: peer.mjs FILE [RUNS], the CPU seconds of the fastest run.

import { readFileSync } from 'node:fs';
import { OBJLoader } from 'three/addons/loaders/OBJLoader.js';
import { PLYLoader } from 'three/addons/loaders/PLYLoader.js';
import { STLLoader } from 'three/addons/loaders/STLLoader.js';

const [file, runs = '5'] = process.argv.slice(2);
const bytes = readFileSync(file);
const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);

function load() {
  if (/\.stl$/i.test(file)) return [new STLLoader().parse(buffer)];
  if (/\.ply$/i.test(file)) return [new PLYLoader().parse(buffer)];
  const group = new OBJLoader().parse(new TextDecoder().decode(buffer));
  return group.children.map((mesh) => mesh.geometry);
}

let best = Infinity;
let triangles = 0;
for (let run = 0; run < Number(runs); ++run) {
  const begin = process.cpuUsage();
  const geometries = load();
  const { user, system } = process.cpuUsage(begin);
  best = Math.min(best, (user + system) / 1e6);
  triangles = geometries.reduce((sum, g) => sum + (g.index ?? g.getAttribute('position')).count / 3, 0);
}
console.log(JSON.stringify({ bytes: bytes.length, triangles, seconds: best }));
