// Constrained Delaunay triangulation of a polygon with holes from its boundary points only, as CAD tessellators do it:
// holes are joined to the outline by bridges (Eberly, "Triangulation by Ear Clipping"), ears are clipped, then edges are
// flipped (Lawson).

const orientation = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

function inTriangle(p, a, b, c) {
  return orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0;
}

/** Twice the signed area of a loop of indices into points. */
export function loopArea(points, loop) {
  let sum = 0;
  loop.forEach((index, i) => {
    const [ax, ay] = points[index];
    const [bx, by] = points[loop[(i + 1) % loop.length]];
    sum += ax * by - ay * bx;
  });
  return sum;
}

/** Position in `outline` of a point from which the rightmost point of the hole can be seen. */
function bridgeTarget(points, outline, from) {
  const p = points[from];
  let best = -1;
  let nearest = Infinity;
  outline.forEach((index, i) => {
    const a = points[index];
    const b = points[outline[(i + 1) % outline.length]];
    if (a[1] > p[1] || b[1] < p[1] || a[1] === b[1]) return;
    const x = a[0] + ((p[1] - a[1]) / (b[1] - a[1])) * (b[0] - a[0]);
    if (x >= p[0] && x < nearest) {
      nearest = x;
      best = a[0] > b[0] ? i : (i + 1) % outline.length;
    }
  });
  const hit = [nearest, p[1]];
  const target = points[outline[best]];
  const [low, high] = hit[1] < target[1] ? [hit, target] : [target, hit];
  let smallestSlope = Infinity;
  outline.forEach((index, i) => {
    const q = points[index];
    if (q === target || q[0] <= p[0] || !inTriangle(q, p, low, high)) return;
    const slope = Math.abs(q[1] - p[1]) / (q[0] - p[0]);
    if (slope < smallestSlope) {
      smallestSlope = slope;
      best = i;
    }
  });
  return best;
}

function joinHoles(points, outline, holes) {
  const rightmost = (hole) => hole.reduce((best, index, i) => (points[index][0] > points[hole[best]][0] ? i : best), 0);
  const sorted = holes
    .map((hole) => ({ hole, start: rightmost(hole) }))
    .sort((a, b) => points[b.hole[b.start]][0] - points[a.hole[a.start]][0]);
  let joined = outline;
  for (const { hole, start } of sorted) {
    const at = bridgeTarget(points, joined, hole[start]);
    const turned = [...hole.slice(start), ...hole.slice(0, start), hole[start]];
    joined = [...joined.slice(0, at + 1), ...turned, ...joined.slice(at)];
  }
  return joined;
}

function clipEars(points, polygon) {
  const ring = [...polygon];
  const triangles = [];
  while (ring.length > 3) {
    let best = -1;
    let bestQuality = 0;
    for (let i = 0; i < ring.length; ++i) {
      const ear = [ring.at(i - 1), ring[i], ring[(i + 1) % ring.length]];
      const [a, b, c] = ear.map((index) => points[index]);
      const area = orientation(a, b, c);
      if (area <= 1e-12) continue;
      if (ring.some((index) => !ear.includes(index) && inTriangle(points[index], a, b, c))) continue;
      const quality = area / ((c[0] - a[0]) ** 2 + (c[1] - a[1]) ** 2);
      if (quality > bestQuality * (1 + 1e-9)) {
        bestQuality = quality;
        best = i;
      }
    }
    if (best < 0) throw new Error('no ear left: the polygon crosses itself');
    triangles.push([ring.at(best - 1), ring[best], ring[(best + 1) % ring.length]]);
    ring.splice(best, 1);
  }
  triangles.push(ring);
  return triangles;
}

/** Positive when d is inside the circle through a, b, c (counter-clockwise). */
function inCircle(a, b, c, d) {
  const row = (p) => [p[0] - d[0], p[1] - d[1], (p[0] - d[0]) ** 2 + (p[1] - d[1]) ** 2];
  const [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = [row(a), row(b), row(c)];
  return ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx);
}

function flipToDelaunay(points, triangles, fixed) {
  const scale = Math.max(...points.flat().map(Math.abs));
  const tolerance = 1e-9 * scale ** 4;
  for (let changed = true; changed; ) {
    changed = false;
    const owner = new Map();
    triangles.forEach((t, i) => t.forEach((v, c) => owner.set(`${v},${t[(c + 1) % 3]}`, [i, c])));
    for (const [edge, [i, ci]] of owner) {
      const [u, v] = edge.split(',').map(Number);
      const other = owner.get(`${v},${u}`);
      if (u > v || fixed.has(edge) || fixed.has(`${v},${u}`) || !other) continue;
      const [j, cj] = other;
      if (triangles[i][ci] !== u || triangles[j][cj] !== v) continue; // Replaced in this sweep.
      if (triangles[i][(ci + 1) % 3] !== v || triangles[j][(cj + 1) % 3] !== u) continue;
      const p = triangles[i][(ci + 2) % 3];
      const q = triangles[j][(cj + 2) % 3];
      if (inCircle(points[u], points[v], points[p], points[q]) <= tolerance) continue;
      triangles[i] = [p, u, q];
      triangles[j] = [q, v, p];
      changed = true;
    }
  }
  return triangles;
}

/**
 * Triangles (indices into points, counter-clockwise) of the region inside the first loop and outside the others.
 * points: [x, y][]; loops: arrays of indices into points, in any direction.
 */
export function triangulate(points, loops) {
  const directed = loops.map((loop, i) => (loopArea(points, loop) > 0 === (i === 0) ? loop : [...loop].reverse()));
  const fixed = new Set(directed.flatMap((loop) => loop.map((v, i) => `${v},${loop[(i + 1) % loop.length]}`)));
  const [outline, ...holes] = directed;
  return flipToDelaunay(points, clipEars(points, joinHoles(points, outline, holes)), fixed);
}
