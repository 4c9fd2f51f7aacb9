#!/usr/bin/env node
// Draws a polygon mesh as a PNG picture without any dependency: the quickest way to look at a result.

import { writeFileSync } from 'node:fs';
import { basename } from 'node:path';
import { parseArgs } from 'node:util';
import { GLYPH_HEIGHT, GLYPH_WIDTH } from './lib/font.mjs';
import { buildEdges, classifyEdges, dropUnusable, faceNormal, readPolygonMesh, scaledJacobian } from './lib/polymesh.mjs';
import { encodeSheet, Raster } from './lib/raster.mjs';

const USAGE = `usage: render.mjs MESH.(obj|stl) OUT.png [options]
  --width N         width in pixels (1400)
  --height N        height in pixels (fits the mesh)
  --view X,Y,Z      direction from the mesh to the eye
  --iso N|all       one of the eight corner views, 0 to 7 (0), or four of them on one sheet
  --up x|y|z        axis that points up (z; y where the mesh is seen along z)
  --zoom CX,CY,CZ,R the part around a point; also eID or vID[,R]: around an element or vertex (0-based)
  --ref FILE        draws the feature edges of this triangle mesh in green
  --angle DEGREES   dihedral angle above which an edge is drawn as a feature (30)
  --bad SJ          quads with a smaller scaled Jacobian are orange (0.3)
  --no-legend       no text, no explanation
Quads are light, triangles red (unless there are triangles only), other polygons violet, inverted quads magenta, backs
of faces darker; dots are irregular interior vertices: 3 faces red, 5 blue, others orange. Thick lines: features dark,
boundary teal, non-manifold magenta.`;

const COLOURS = {
  quad: [226, 232, 240], triangle: [232, 84, 74], polygon: [150, 110, 220], bad: [247, 168, 60], inverted: [236, 40, 200],
  ink: [52, 64, 84], feature: [14, 20, 30], boundary: [0, 132, 122], nonManifold: [205, 0, 160], reference: [24, 160, 50],
  three: [214, 20, 20], five: [24, 84, 226], other: [240, 140, 0], text: [30, 36, 46],
};
const SUPERSAMPLING = 2;
const SHEET_VIEWS = [0, 3, 5, 6];
const DISC_FACE_LIMIT = 60000; // beyond it the dots would cover the picture

const subtract = (a, b) => a.map((x, i) => x - b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

function boundsOf({ positions: p, faces }) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const face of faces) {
    for (const v of face) {
      for (let k = 0; k < 3; k++) {
        low[k] = Math.min(low[k], p[3 * v + k]);
        high[k] = Math.max(high[k], p[3 * v + k]);
      }
    }
  }
  return { low, high };
}

/** One of the eight corners; the first four are above. */
function isoDirection(n, up) {
  const [side, front, height] = [n & 1 ? -1 : 1, n & 2 ? 1.25 : -1.25, n & 4 ? -0.9 : 0.9];
  if (up === 'x') return unit([height, side, front]);
  return unit(up === 'y' ? [side, height, -front] : [side, front, height]);
}

/** Directions to the eye: those asked for, else the flat side of a flat mesh, else the first corner view. */
function viewsOf(options, { low, high }) {
  if (options.view) return [unit(options.view.split(',').map(Number))];
  if (options.iso === 'all') return SHEET_VIEWS.map((n) => isoDirection(n, options.up));
  if (options.iso !== undefined) return [isoDirection(Number(options.iso), options.up)];
  const extent = subtract(high, low);
  const flat = extent.findIndex((x) => x < 1e-3 * Math.max(...extent));
  return [flat < 0 ? isoDirection(0, options.up) : [0, 1, 2].map((k) => (k === flat ? 1 : 0))];
}

function meanEdgeLength(mesh, edges) {
  const p = mesh.positions;
  let sum = 0;
  for (const { a, b } of edges) sum += Math.hypot(p[3 * a] - p[3 * b], p[3 * a + 1] - p[3 * b + 1], p[3 * a + 2] - p[3 * b + 2]);
  return edges.length > 0 ? sum / edges.length : 1;
}

/** { centre, radius } of --zoom, or null. */
function parseZoom(text, mesh, edgeLength) {
  if (text === undefined) return null;
  const words = text.split(',');
  const point = (v) => [0, 1, 2].map((k) => mesh.positions[3 * v + k]);
  if (/^[ev]\d/.test(text)) {
    const id = Number(words[0].slice(1));
    const vertices = text[0] === 'v' ? [id] : [...(mesh.faces[id] ?? [])];
    const centre = [0, 1, 2].map((k) => vertices.reduce((sum, v) => sum + point(v)[k], 0) / vertices.length);
    return { centre, radius: words[1] ? Number(words[1]) : 6 * edgeLength };
  }
  const [x, y, z, radius] = words.map(Number);
  return { centre: [x, y, z], radius };
}

/** An orthographic camera that maps points to [x, y, depth] in pixels, all axes in the same scale. */
function makeCamera(mesh, bounds, direction, up, zoom, options) {
  const axes = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
  const chosen = axes[up] ?? (Math.abs(direction[2]) > 0.95 ? axes.y : axes.z);
  const upwards = Math.abs(dot(chosen, direction)) > 0.999 ? axes.x : chosen;
  const right = unit(cross(upwards, direction));
  const top = cross(direction, right);
  let low = [Infinity, Infinity];
  let high = [-Infinity, -Infinity];
  const middle = zoom ? zoom.centre : bounds.low.map((x, k) => (x + bounds.high[k]) / 2);
  if (zoom) {
    low = [-zoom.radius, -zoom.radius];
    high = [zoom.radius, zoom.radius];
  } else {
    for (const face of mesh.faces) {
      for (const v of face) {
        const q = subtract([mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]], middle);
        [right, top].forEach((axis, k) => {
          low[k] = Math.min(low[k], dot(q, axis));
          high[k] = Math.max(high[k], dot(q, axis));
        });
      }
    }
  }
  const [w, h] = subtract(high, low).map((x) => Math.max(x, 1e-12));
  const margin = 0.04;
  const height = options.height ?? Math.round(options.width * Math.min(0.85, Math.max(0.4, h / w)));
  const scale = SUPERSAMPLING * (1 - 2 * margin) * Math.min(options.width / w, height / h);
  const centre = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
  const project = (p) => {
    const q = subtract(p, middle);
    return [
      (dot(q, right) - centre[0]) * scale + (SUPERSAMPLING * options.width) / 2,
      (SUPERSAMPLING * height) / 2 - (dot(q, top) - centre[1]) * scale,
      dot(q, direction) * scale,
    ];
  };
  return { project, direction, right, top, scale, height };
}

function projectAll(positions, camera) {
  const result = new Array(positions.length / 3);
  for (let v = 0; v < result.length; v++) {
    result[v] = camera.project([positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]]);
  }
  return result;
}

function faceColour(mesh, f, summary, bad) {
  const size = mesh.faces[f].length;
  if (size === 3) return summary.quads > 0 ? COLOURS.triangle : COLOURS.quad;
  if (size > 4) return COLOURS.polygon;
  if (summary.shape[f] <= 0) return COLOURS.inverted;
  return summary.shape[f] < bad ? COLOURS.bad : COLOURS.quad;
}

function shade(colour, normal, camera) {
  const facing = dot(normal, camera.direction);
  const light = unit(camera.direction.map((x, k) => x + 0.45 * camera.top[k] - 0.35 * camera.right[k]));
  const n = facing < 0 ? normal.map((x) => -x) : normal;
  const level = 0.5 + 0.53 * Math.max(0, dot(n, light));
  const back = facing < 0 ? [0.55, 0.6, 0.72] : [1, 1, 1];
  return colour.map((x, k) => Math.min(255, x * level * back[k]));
}

function drawView(mesh, summary, camera, options) {
  const raster = new Raster(options.width, camera.height, SUPERSAMPLING);
  const edgePixels = summary.edgeLength * camera.scale;
  const line = Math.min(0.65 * SUPERSAMPLING, 0.07 * edgePixels);
  const thick = Math.min(2.4 * SUPERSAMPLING, Math.max(SUPERSAMPLING, 0.2 * edgePixels));
  const bias = Math.max(2 * SUPERSAMPLING, 0.15 * edgePixels);
  const screen = projectAll(mesh.positions, camera);
  mesh.faces.forEach((face, f) => {
    const colour = shade(faceColour(mesh, f, summary, options.bad), faceNormal(mesh, face), camera);
    const ink = colour.map((x, k) => 0.25 * x + 0.75 * COLOURS.ink[k]);
    raster.polygon(Array.from(face, (v) => screen[v]), colour, ink, line);
  });
  for (const kind of ['sharp', 'boundary', 'nonManifold']) {
    const colour = COLOURS[kind === 'sharp' ? 'feature' : kind];
    const width = kind === 'sharp' ? 0.75 * thick : thick;
    for (const { a, b } of summary.features[kind]) raster.line(screen[a], screen[b], width, colour, bias);
  }
  if (summary.reference) {
    const ends = projectAll(summary.reference.positions, camera);
    for (const { a, b } of summary.reference.edges) raster.line(ends[a], ends[b], 0.6 * thick, COLOURS.reference, bias);
  }
  if (mesh.faces.length <= DISC_FACE_LIMIT && summary.quads > 0) {
    const radius = Math.min(5.5 * SUPERSAMPLING, Math.max(1.8 * SUPERSAMPLING, 0.2 * edgePixels));
    for (const { vertex, valence } of summary.irregular) {
      const colour = valence === 3 ? COLOURS.three : valence === 5 ? COLOURS.five : COLOURS.other;
      raster.disc(screen[vertex], radius, colour, bias);
    }
  }
  return raster;
}

function findIrregular(mesh, edges) {
  const count = mesh.positions.length / 3;
  const valence = new Int32Array(count);
  const inside = new Uint8Array(count).fill(1);
  for (const face of mesh.faces) for (const v of face) valence[v]++;
  for (const { a, b, faces } of edges) if (faces.length !== 2) inside[a] = inside[b] = 0;
  const result = [];
  for (let v = 0; v < count; v++) {
    if (valence[v] > 0 && inside[v] && valence[v] !== 4) result.push({ vertex: v, valence: valence[v] });
  }
  return result;
}

function summarise(mesh, options) {
  const edges = buildEdges(mesh);
  const shape = mesh.faces.map((face) => scaledJacobian(mesh, face));
  const summary = {
    edges,
    shape,
    edgeLength: meanEdgeLength(mesh, edges),
    features: classifyEdges(mesh, edges, options.angle),
    irregular: findIrregular(mesh, edges),
    quads: mesh.faces.filter((face) => face.length === 4).length,
    triangles: mesh.faces.filter((face) => face.length === 3).length,
  };
  if (options.ref) {
    const { mesh: part } = dropUnusable(readPolygonMesh(options.ref));
    const { sharp, boundary, nonManifold } = classifyEdges(part, buildEdges(part), options.angle);
    summary.reference = { positions: part.positions, edges: [...sharp, ...boundary, ...nonManifold] };
  }
  return summary;
}

function legendItems(name, mesh, summary, options, dropped) {
  const quadShape = summary.shape.filter((_, f) => mesh.faces[f].length === 4);
  const worst = quadShape.reduce((least, x) => Math.min(least, x), 1);
  const mean = quadShape.reduce((sum, x) => sum + x, 0) / Math.max(1, quadShape.length);
  const valences = (v) => summary.irregular.filter(({ valence }) => valence === v).length;
  const others = summary.irregular.length - valences(3) - valences(5);
  const polygons = mesh.faces.length - summary.quads - summary.triangles;
  const { sharp, boundary, nonManifold } = summary.features;
  const bad = quadShape.filter((x) => x < options.bad).length;
  const items = [[COLOURS.text, `${name}: ${summary.quads} quads, ${mesh.positions.length / 3} vertices`]];
  if (summary.quads > 0) {
    items.push([COLOURS.text, `scaled Jacobian mean ${mean.toFixed(3)} worst ${worst.toFixed(3)}`]);
    if (summary.triangles > 0) items.push([COLOURS.triangle, `${summary.triangles} triangles`]);
    if (bad > 0) items.push([COLOURS.bad, `${bad} quads below ${options.bad}`]);
    if (polygons > 0) items.push([COLOURS.polygon, `${polygons} larger polygons`]);
    if (valences(3) > 0) items.push([COLOURS.three, `${valences(3)} vertices with 3 faces`]);
    if (valences(5) > 0) items.push([COLOURS.five, `${valences(5)} vertices with 5 faces`]);
    if (others > 0) items.push([COLOURS.other, `${others} vertices with another number`]);
  } else {
    items.push([COLOURS.text, `${summary.triangles} triangles`]);
  }
  if (sharp.length > 0) items.push([COLOURS.feature, `${sharp.length} sharp edges`]);
  if (boundary.length > 0) items.push([COLOURS.boundary, `${boundary.length} boundary edges`]);
  if (nonManifold.length > 0) items.push([COLOURS.nonManifold, `${nonManifold.length} non-manifold edges`]);
  if (summary.reference) items.push([COLOURS.reference, 'features of the reference']);
  if (dropped > 0) items.push([COLOURS.inverted, `${dropped} faces can't be drawn`]);
  return items;
}

/** A strip as wide as the picture: the items flow from left to right. */
function drawLegend(width, items) {
  const size = width >= 1000 ? 2 : 1;
  const [margin, indent, step] = [8, 11 * size, (GLYPH_HEIGHT + 1) * size];
  const widthOf = (text) => indent + (text.length + 2) * GLYPH_WIDTH * size;
  const placed = [];
  let [x, y] = [margin, margin];
  for (const [colour, text] of items) {
    if (x > margin && x + widthOf(text) > width) [x, y] = [margin, y + step];
    placed.push({ x, y, colour, text });
    x += widthOf(text);
  }
  const raster = new Raster(width, y + step, 1);
  for (const item of placed) {
    raster.box(item.x, item.y, 7 * size, 7 * size, item.colour);
    raster.text(item.x + indent, item.y, item.text, COLOURS.text, size);
  }
  return raster;
}

function parseCommandLine(args) {
  const text = { type: 'string' };
  const { values, positionals } = parseArgs({
    args,
    allowPositionals: true,
    options: {
      width: text, height: text, view: text, iso: text, up: text, zoom: text, ref: text, angle: text, bad: text,
      'no-legend': { type: 'boolean' },
    },
  });
  if (positionals.length !== 2) throw new Error(USAGE);
  return {
    ...values,
    input: positionals[0],
    output: positionals[1],
    width: Number(values.width ?? 1400),
    height: values.height === undefined ? undefined : Number(values.height),
    angle: Number(values.angle ?? 30),
    bad: Number(values.bad ?? 0.3),
  };
}

function run(args) {
  const options = parseCommandLine(args);
  const { mesh, dropped } = dropUnusable(readPolygonMesh(options.input));
  if (mesh.faces.length === 0) throw new Error(`${options.input}: nothing to draw`);
  const summary = summarise(mesh, options);
  const bounds = boundsOf(mesh);
  const zoom = parseZoom(options.zoom, mesh, summary.edgeLength);
  const views = viewsOf(options, bounds);
  const columns = views.length > 1 ? 2 : 1;
  const tile = views.length > 1
    ? { ...options, width: Math.round(options.width / 2), height: Math.round((options.height ?? 0.75 * options.width) / 2) }
    : options;
  const rasters = views.map((direction) => {
    const camera = makeCamera(mesh, bounds, direction, options.up, zoom, tile);
    return drawView(mesh, summary, camera, tile);
  });
  const items = legendItems(basename(options.input), mesh, summary, options, dropped);
  const legend = options['no-legend'] ? null : drawLegend(tile.width * columns, items);
  writeFileSync(options.output, encodeSheet(legend, rasters, columns));
}

try {
  run(process.argv.slice(2));
} catch (error) {
  console.error(error.message);
  process.exitCode = 2;
}
