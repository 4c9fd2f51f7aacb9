// One picture of a cross field: the shaded part, streamlines, edges, pins and singularities.

import { Raster } from '../../tests/tools/lib/raster.mjs';

const SUPERSAMPLING = 2;
const MARGIN = 0.05;
const COLOURS = {
  surface: [232, 236, 242], line: [92, 112, 146], edge: [20, 26, 36], pinned: [30, 140, 90], removed: [240, 140, 0],
  positive: [214, 20, 20], negative: [24, 84, 226], text: [30, 36, 46],
};
const CURVATURE_PIN = 4;

const subtract = (a, b) => a.map((x, k) => x - b[k]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

/** An orthographic view from the direction `eye`, z up, of all points: maps them to [x, y, depth] in pixels. */
function makeCamera(points, eye, width, height, top) {
  const direction = unit(eye);
  const right = unit(Math.abs(direction[2]) > 0.99 ? [1, 0, 0] : cross([0, 0, 1], direction));
  const up = cross(direction, right);
  const low = [Infinity, Infinity];
  const high = [-Infinity, -Infinity];
  for (const p of points) {
    [right, up].forEach((axis, k) => {
      low[k] = Math.min(low[k], dot(p, axis));
      high[k] = Math.max(high[k], dot(p, axis));
    });
  }
  const room = [width * (1 - 2 * MARGIN), (height - top) * (1 - 2 * MARGIN)];
  const scale = Math.min(room[0] / (high[0] - low[0]), room[1] / (high[1] - low[1])) * SUPERSAMPLING;
  const middle = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
  const project = (p) => [
    (dot(p, right) - middle[0]) * scale + (SUPERSAMPLING * width) / 2,
    (SUPERSAMPLING * (height + top)) / 2 - (dot(p, up) - middle[1]) * scale,
    dot(p, direction) * scale,
  ];
  return { direction, right, up, scale, project };
}

function shade(colour, normal, { direction, right, up }) {
  const facing = dot(normal, direction);
  const light = unit(direction.map((x, k) => x + 0.45 * up[k] - 0.35 * right[k]));
  const level = 0.55 + 0.47 * Math.max(0, dot(facing < 0 ? normal.map((x) => -x) : normal, light));
  return colour.map((x) => Math.min(255, x * level * (facing < 0 ? 0.82 : 1)));
}

/**
 * drawing: what field_study --draw writes. pins: whether to mark what was pinned to curvature, and taken back.
 * caption: lines of text. Returns a Raster.
 */
export function drawField(drawing, { eye, width, height, caption, pins = false }) {
  const top = 4 + 20 * caption.length;
  const raster = new Raster(width, height, SUPERSAMPLING);
  const camera = makeCamera(drawing.patches.flatMap((patch) => patch.positions), eye, width, height, top);
  const element = drawing.size * camera.scale;
  const bias = 0.35 * element;
  for (const { positions, triangles } of drawing.patches) {
    const screen = positions.map(camera.project);
    for (const corners of triangles) {
      const [a, b, c] = corners.map((v) => positions[v]);
      const normal = cross(subtract(b, a), subtract(c, a));
      if (Math.hypot(...normal) === 0) continue;
      const colour = shade(COLOURS.surface, unit(normal), camera);
      raster.polygon(corners.map((v) => screen[v]), colour, colour, 0);
    }
  }
  const polyline = (points, thickness, colour) => {
    const screen = points.map(camera.project);
    for (let i = 1; i < screen.length; i++) raster.line(screen[i - 1], screen[i], thickness * SUPERSAMPLING, colour, bias);
  };
  for (const points of drawing.lines) polyline(points, 1, COLOURS.line);
  for (const points of drawing.edges) polyline(points, 2.2, COLOURS.edge);
  if (pins) {
    for (const { positions, constrained, removed } of drawing.patches) {
      positions.forEach((p, v) => {
        const colour = removed[v] ? COLOURS.removed : COLOURS.pinned;
        if (removed[v] || constrained[v] === CURVATURE_PIN) raster.stamp(camera.project(p), 1.6 * SUPERSAMPLING, colour, bias);
      });
    }
  }
  const radius = Math.max(4, Math.min(6.5, 0.35 * (element / SUPERSAMPLING))) * SUPERSAMPLING;
  for (const { point, index } of drawing.singularities) {
    raster.disc(camera.project(point), radius, index > 0 ? COLOURS.positive : COLOURS.negative, 2 * bias);
  }
  caption.forEach((text, i) => raster.text(8, 8 + 20 * i, text, COLOURS.text, 2));
  return raster;
}
