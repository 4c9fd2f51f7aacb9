// Polygon meshes for the picture tool: reading OBJ and STL, adjacency, element shape.

import { readFileSync } from 'node:fs';

/** { positions: Float64Array (xyz), faces: Int32Array[] } */
export function readPolygonMesh(path) {
  const bytes = readFileSync(path);
  if (path.toLowerCase().endsWith('.stl')) return readStl(bytes);
  return readObj(bytes.toString('latin1'));
}

function readObj(text) {
  const positions = [];
  const faces = [];
  for (const line of text.split('\n')) {
    if (line.startsWith('v ')) {
      const words = line.trim().split(/\s+/);
      positions.push(Number(words[1]), Number(words[2]), Number(words[3]));
    } else if (line.startsWith('f ')) {
      const count = positions.length / 3;
      const ids = line.trim().split(/\s+/).slice(1).map((word) => parseInt(word, 10));
      faces.push(Int32Array.from(ids, (id) => (id < 0 ? count + id : id - 1)));
    }
  }
  return { positions: Float64Array.from(positions), faces };
}

function readStl(bytes) {
  const corners = [];
  const count = bytes.length >= 84 ? bytes.readUInt32LE(80) : -1;
  if (bytes.length === 84 + 50 * count) {
    for (let t = 0; t < count; t++) {
      for (let k = 3; k < 12; k++) corners.push(bytes.readFloatLE(84 + 50 * t + 4 * k));
    }
  } else {
    for (const match of bytes.toString('latin1').matchAll(/vertex\s+(\S+)\s+(\S+)\s+(\S+)/gi)) {
      corners.push(Number(match[1]), Number(match[2]), Number(match[3]));
    }
  }
  return weld(corners);
}

function weld(corners) {
  const known = new Map();
  const positions = [];
  const ids = new Int32Array(corners.length / 3);
  for (let i = 0; i < ids.length; i++) {
    const [x, y, z] = [corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]];
    const key = `${x},${y},${z}`;
    let id = known.get(key);
    if (id === undefined) {
      id = positions.length / 3;
      known.set(key, id);
      positions.push(x, y, z);
    }
    ids[i] = id;
  }
  const faces = [];
  for (let i = 0; i + 2 < ids.length; i += 3) faces.push(ids.slice(i, i + 3));
  return { positions: Float64Array.from(positions), faces };
}

/** Area vector of a polygon (Newell), unit unless it has no area. */
export function faceNormal({ positions: p }, face) {
  const n = [0, 0, 0];
  for (let i = 0; i < face.length; i++) {
    const a = face[i] * 3;
    const b = face[(i + 1) % face.length] * 3;
    n[0] += (p[a + 1] - p[b + 1]) * (p[a + 2] + p[b + 2]);
    n[1] += (p[a + 2] - p[b + 2]) * (p[a] + p[b]);
    n[2] += (p[a] - p[b]) * (p[a + 1] + p[b + 1]);
  }
  const length = Math.hypot(...n);
  return length > 0 ? n.map((x) => x / length) : n;
}

/** Scaled Jacobian of a quadrilateral (Verdict); 1 for other polygons. */
export function scaledJacobian({ positions: p }, face) {
  if (face.length !== 4) return 1;
  const at = (i) => { const o = face[i & 3] * 3; return [p[o], p[o + 1], p[o + 2]]; };
  const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const normal = cross(minus(at(2), at(0)), minus(at(3), at(1)));
  let least = Infinity;
  for (let i = 0; i < 4; i++) {
    const before = minus(at(i), at(i + 3));
    const after = minus(at(i + 1), at(i));
    const scale = Math.hypot(...before) * Math.hypot(...after) * Math.hypot(...normal);
    least = Math.min(least, scale > 0 ? dot(normal, cross(before, after)) / scale : 0);
  }
  return least;
}

/** Edges as { a, b, faces: [ids] } with a < b. */
export function buildEdges({ positions, faces }) {
  const count = positions.length / 3;
  const edges = new Map();
  faces.forEach((face, f) => {
    for (let i = 0; i < face.length; i++) {
      const a = Math.min(face[i], face[(i + 1) % face.length]);
      const b = Math.max(face[i], face[(i + 1) % face.length]);
      const key = a * count + b;
      const edge = edges.get(key);
      if (edge) edge.faces.push(f);
      else edges.set(key, { a, b, faces: [f] });
    }
  });
  return [...edges.values()];
}

/** Leaves out faces that name vertices that do not exist or are not finite; says how many. */
export function dropUnusable(mesh) {
  const { positions: p, faces } = mesh;
  const usable = (v) => v >= 0 && 3 * v < p.length && Number.isFinite(p[3 * v] + p[3 * v + 1] + p[3 * v + 2]);
  const kept = faces.filter((face) => face.length > 2 && face.every(usable));
  return { mesh: { positions: p, faces: kept }, dropped: faces.length - kept.length };
}

/** Sharp (more than `angle` degrees), boundary and non-manifold edges. */
export function classifyEdges(mesh, edges, angle) {
  const cosine = Math.cos((angle * Math.PI) / 180);
  const normals = mesh.faces.map((face) => faceNormal(mesh, face));
  const result = { sharp: [], boundary: [], nonManifold: [] };
  for (const edge of edges) {
    if (edge.faces.length === 1) result.boundary.push(edge);
    else if (edge.faces.length > 2) result.nonManifold.push(edge);
    else {
      const [m, n] = edge.faces.map((f) => normals[f]);
      if (m[0] * n[0] + m[1] * n[1] + m[2] * n[2] < cosine) result.sharp.push(edge);
    }
  }
  return result;
}
