// A part under construction: triangles over shared vertices, and its text or bytes as a file.

import { triangulate } from './triangulate.mjs';

const kDecimals = 6;
const round = (x) => Number(x.toFixed(kDecimals)) + 0; // + 0 turns -0 into 0.

const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** Points of a circle or arc about (x, y), counter-clockwise from angle `from` to `to` in radians; an arc has both ends. */
export function arc(x, y, radius, segments, from = 0, to = 2 * Math.PI) {
  const closed = to - from >= 2 * Math.PI - 1e-9;
  return Array.from({ length: closed ? segments : segments + 1 }, (_, i) => {
    const angle = from + ((to - from) * i) / segments;
    return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
  });
}

export class Part {
  positions = [];
  triangles = [];
  #indexOf = new Map();

  vertex(point) {
    const rounded = point.map(round);
    const key = rounded.join(' ');
    if (!this.#indexOf.has(key)) {
      this.#indexOf.set(key, this.positions.length);
      this.positions.push(rounded);
    }
    return this.#indexOf.get(key);
  }

  triangle(a, b, c) {
    const corners = [a, b, c].map((point) => this.vertex(point));
    if (new Set(corners).size === 3) this.triangles.push(corners);
  }

  /** Quads between two rows of points, seen from outside: b above a when a runs to the right. */
  strip(a, b, { closed = false } = {}) {
    const count = closed ? a.length : a.length - 1;
    for (let i = 0; i < count; ++i) {
      const j = (i + 1) % a.length;
      this.triangle(a[i], a[j], b[j]);
      this.triangle(a[i], b[j], b[i]);
    }
  }

  /** A grid of points, rows[i][j], each cell split along the shorter diagonal. closed: the last row and column meet the first. */
  grid(rows, { closedRows = false, closedColumns = false } = {}) {
    const length = (a, b) => Math.hypot(...subtract(a, b));
    for (let i = 0; i < rows.length - (closedRows ? 0 : 1); ++i) {
      const low = rows[i];
      const high = rows[(i + 1) % rows.length];
      for (let j = 0; j < low.length - (closedColumns ? 0 : 1); ++j) {
        const k = (j + 1) % low.length;
        if (length(low[j], high[k]) <= length(low[k], high[j])) {
          this.triangle(low[j], low[k], high[k]);
          this.triangle(low[j], high[k], high[j]);
        } else {
          this.triangle(low[j], low[k], high[j]);
          this.triangle(low[k], high[k], high[j]);
        }
      }
    }
  }

  /** A flat face with the given unit normal along an axis, bounded by an outline and holes (loops of points). */
  planar(loops, normal) {
    const axis = normal.findIndex((x) => x !== 0);
    const [u, v] = normal[axis] > 0 ? [(axis + 1) % 3, (axis + 2) % 3] : [(axis + 2) % 3, (axis + 1) % 3];
    const points = loops.flat();
    let next = 0;
    const indices = loops.map((loop) => loop.map(() => next++));
    const flat = points.map((point) => [point[u], point[v]]);
    for (const [a, b, c] of triangulate(flat, indices)) this.triangle(points[a], points[b], points[c]);
  }

  /** A prism along z of a region given by its outline (counter-clockwise) and holes (counter-clockwise), all in the plane. */
  extrude(outline, holes, low, high) {
    const at = (loop, z) => loop.map(([x, y]) => [x, y, z]);
    const loops = [outline, ...holes];
    this.planar(loops.map((loop) => at(loop, high)), [0, 0, 1]);
    this.planar(loops.map((loop) => at(loop, low)), [0, 0, -1]);
    this.strip(at(outline, low), at(outline, high), { closed: true });
    for (const hole of holes) this.strip(at(hole, high), at(hole, low), { closed: true });
  }

  /** The surface swept by a profile [radius, z][] (from bottom to top, outside to its right) about the z axis. */
  revolve(profile, segments) {
    const ring = ([radius, z]) => arc(0, 0, radius, segments).map(([x, y]) => [x, y, z]);
    for (let i = 0; i + 1 < profile.length; ++i) {
      this.strip(ring(profile[i]), ring(profile[i + 1]), { closed: true });
    }
  }

  toObj(title) {
    const lines = [`# QMCF sample: ${title}. Made by samples/generate.mjs.`];
    for (const position of this.positions) lines.push(`v ${position.join(' ')}`);
    for (const corners of this.triangles) lines.push(`f ${corners.map((v) => v + 1).join(' ')}`);
    return Buffer.from(`${lines.join('\n')}\n`);
  }

  toBinaryStl(title) {
    const bytes = Buffer.alloc(84 + 50 * this.triangles.length);
    bytes.write(`QMCF sample: ${title}`.slice(0, 80), 0, 'latin1');
    bytes.writeUInt32LE(this.triangles.length, 80);
    this.triangles.forEach((corners, i) => {
      const [a, b, c] = corners.map((v) => this.positions[v]);
      const normal = cross(subtract(b, a), subtract(c, a));
      const length = Math.hypot(...normal);
      const numbers = [...normal.map((x) => x / length), ...a, ...b, ...c];
      numbers.forEach((x, k) => bytes.writeFloatLE(k < 3 ? round(x) : x, 84 + 50 * i + 4 * k));
    });
    return bytes;
  }
}
