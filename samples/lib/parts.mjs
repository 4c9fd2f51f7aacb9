// The sample parts. Units are millimetres. Curves are sampled on the exact geometry and flat faces get no inner points,
// as in the tessellations that CAD programs export.

import { Part, arc } from './part.mjs';

const at = (loop, z) => loop.map(([x, y]) => [x, y, z]);

function cylinder() {
  const part = new Part();
  part.extrude(arc(0, 0, 10, 48), [], 0, 40);
  return part;
}

function plateWithHoles() {
  const [halfLength, halfWidth, corner] = [60, 40, 12];
  const outline = [
    [halfLength, halfWidth],
    [-halfLength, halfWidth],
    [-halfLength, -halfWidth],
    [halfLength, -halfWidth],
  ].flatMap(([x, y], i) => {
    const from = (i * Math.PI) / 2;
    return arc(x - Math.sign(x) * corner, y - Math.sign(y) * corner, corner, 8, from, from + Math.PI / 2);
  });
  const slot = [
    ...arc(44, 10, 5, 12, 0, Math.PI),
    ...arc(44, -10, 5, 12, Math.PI, 2 * Math.PI),
  ];
  const bolts = [
    [46, 26],
    [-46, 26],
    [-46, -26],
    [46, -26],
  ].map(([x, y]) => arc(x, y, 5, 24));
  const part = new Part();
  part.extrude(outline, [arc(-6, 0, 22, 56), slot, ...bolts], 0, 10);
  return part;
}

/** An L of sheet metal: bent about one axis (inner radius 10, thickness 8), with two bolt holes in each leg. */
function bracketWithFillets() {
  const [length, height, width, thickness, radius] = [80, 60, 50, 8, 10];
  const centre = thickness + radius;
  const bend = (r) => arc(centre, centre, r, 10, Math.PI, 1.5 * Math.PI);
  const inner = [[thickness, height], ...bend(radius), [length, thickness]];
  const outer = [[0, height], ...bend(radius + thickness), [length, 0]];
  const side = (y) => [...outer, ...[...inner].reverse()].map(([x, z]) => [x, y, z]);
  const along = (profile, y) => profile.map(([x, z]) => [x, y, z]);
  const base = (z) => (loop) => loop.map(([x, y]) => [x, y, z]);
  const wall = (x) => (loop) => loop.map(([z, y]) => [x, y, z]);
  const rectangle = (low, high) => [[low, 0], [high, 0], [high, width], [low, width]];
  const holes = (position) => [14, width - 14].map((y) => arc(position, y, 5, 24));

  const part = new Part();
  part.planar([rectangle(centre, length), ...holes(60)].map(base(thickness)), [0, 0, 1]);
  part.planar([rectangle(centre, length), ...holes(60)].map(base(0)), [0, 0, -1]);
  part.planar([rectangle(centre, height), ...holes(42)].map(wall(thickness)), [1, 0, 0]);
  part.planar([rectangle(centre, height), ...holes(42)].map(wall(0)), [-1, 0, 0]);
  for (const hole of holes(60)) part.strip(base(thickness)(hole), base(0)(hole), { closed: true });
  for (const hole of holes(42)) part.strip(wall(0)(hole), wall(thickness)(hole), { closed: true });
  part.strip(along(bend(radius), 0), along(bend(radius), width));
  part.strip(along(bend(radius + thickness), width), along(bend(radius + thickness), 0));
  part.planar([side(0)], [0, -1, 0]);
  part.planar([side(width)], [0, 1, 0]);
  part.planar([[[length, 0, 0], [length, width, 0], [length, width, thickness], [length, 0, thickness]]], [1, 0, 0]);
  part.planar([[[0, 0, height], [thickness, 0, height], [thickness, width, height], [0, width, height]]], [0, 0, 1]);
  return part;
}

function steppedShaft() {
  const segments = 48;
  const fillet = arc(18, 54, 4, 6, Math.PI, 1.5 * Math.PI).reverse(); // From the shoulder (18, 50) up to (14, 54).
  const profile = [
    [10, 0], [12, 2], [12, 30], [20, 30], [20, 48], [18, 50],
    ...fillet.slice(1),
    [14, 84], [10, 84], [10, 108], [8, 110],
  ];
  const part = new Part();
  part.revolve(profile, segments);
  part.planar([at(arc(0, 0, 10, segments), 0)], [0, 0, -1]);
  part.planar([at(arc(0, 0, 8, segments), 110)], [0, 0, 1]);
  return part;
}

function torus() {
  const rows = arc(30, 0, 10, 32).map(([radius, z]) => at(arc(0, 0, radius, 72), z));
  const part = new Part();
  part.grid(rows, { closedRows: true, closedColumns: true });
  return part;
}

function wavySheet() {
  const cells = 48;
  const side = 100;
  const rows = Array.from({ length: cells + 1 }, (_, i) =>
    Array.from({ length: cells + 1 }, (_, j) => {
      const [x, y] = [(side * j) / cells, (side * i) / cells];
      return [x, y, 8 * Math.sin((2 * Math.PI * x) / side) * Math.cos((1.5 * Math.PI * y) / side)];
    }),
  );
  const part = new Part();
  part.grid(rows);
  return part;
}

/** Two sheets that meet at right angles in a T: three faces share the edges along x = 0. */
function tSheets() {
  const [half, width, height] = [40, 60, 45];
  const part = new Part();
  for (const [low, high] of [[-half, 0], [0, half]]) {
    const loop = [[low, 0], [high, 0], [high, width], [low, width]];
    part.planar([at(loop, 0)], [0, 0, 1]);
  }
  const web = [[0, 0, 0], [0, width, 0], [0, width, height], [0, 0, height]];
  const opening = arc(30, 24, 11, 32).map(([y, z]) => [0, y, z]);
  part.planar([web, opening], [1, 0, 0]);
  return part;
}

/** A link with a wide and a narrow eye, like the part of varying sizes in figure 10 (c, d) of the paper. */
function varying() {
  const distance = 90;
  const [large, small] = [40, 12];
  const tangent = Math.acos((large - small) / distance);
  const outline = [
    ...arc(0, 0, large, 40, tangent, 2 * Math.PI - tangent),
    ...arc(distance, 0, small, 12, -tangent, tangent),
  ];
  const eyes = [arc(0, 0, 22, 48), arc(distance, 0, 6, 24)];
  const row = [[46, 5], [58, 3.5], [68, 2.5], [75.5, 1.5]].map(([x, radius]) => arc(x, 0, radius, 20));
  const part = new Part();
  part.extrude(outline, [...eyes, ...row], 0, 8);
  return part;
}

/** A cylinder between half spheres, with the poles and thin triangles of a tessellation by longitude and latitude. */
function capsule() {
  const [radius, length, segments, rings] = [12, 36, 40, 10];
  const quarter = arc(0, 0, radius, rings, 0, Math.PI / 2); // From the equator (radius, 0) to the pole (0, radius).
  const profile = [
    ...quarter.map(([r, z]) => [r, -z]).reverse(),
    ...quarter.map(([r, z]) => [r, z + length]),
  ];
  const part = new Part();
  part.revolve(profile, segments);
  return part;
}

/** All samples: `euler` and `closed` are what a check of the file must find, `volume` (closed parts) what the exact part has. */
export const samples = [
  {
    name: 'Bracket with fillets', file: 'bracket_with_fillets.stl', make: bracketWithFillets, euler: -6, closed: true,
    volume: 50 * (8 * (62 + 42) + (Math.PI / 4) * (18 ** 2 - 10 ** 2)) - 4 * 8 * Math.PI * 5 ** 2,
    description: 'A bent L bracket with a smooth inner and outer radius and four bolt holes.',
  },
  {
    name: 'Stepped shaft', file: 'stepped_shaft.stl', make: steppedShaft, euler: 2, closed: true,
    description: 'A turned shaft with four diameters, chamfers and a fillet.',
  },
  {
    name: 'Plate with holes', file: 'plate_with_holes.stl', make: plateWithHoles, euler: -10, closed: true,
    volume: 10 * (120 * 80 - (4 - Math.PI) * 12 ** 2 - Math.PI * (22 ** 2 + 4 * 5 ** 2) - (20 * 10 + Math.PI * 5 ** 2)),
    description: 'A plate with rounded corners, a bore, a slot and four bolt holes.',
  },
  {
    name: 'Link of varying size', file: 'varying.stl', make: varying, euler: -10, closed: true,
    description: 'A flat link whose holes shrink from 44 to 3 mm: small and large elements in one face.',
  },
  {
    name: 'Cylinder', file: 'cylinder.obj', make: cylinder, euler: 2, closed: true, volume: Math.PI * 10 ** 2 * 40,
    description: 'A closed cylinder in the needle triangles of a CAD export.',
  },
  {
    name: 'Capsule', file: 'capsule.obj', make: capsule, euler: 2, closed: true,
    volume: Math.PI * 12 ** 2 * 36 + (4 / 3) * Math.PI * 12 ** 3,
    description: 'A cylinder between half spheres: no edge anywhere, singularities only from curvature.',
  },
  {
    name: 'Torus', file: 'torus.obj', make: torus, euler: 0, closed: true, volume: 2 * Math.PI ** 2 * 30 * 10 ** 2,
    description: 'A smooth ring, which can be meshed without any irregular vertex.',
  },
  {
    name: 'Wavy sheet', file: 'wavy_sheet.obj', make: wavySheet, euler: 1, closed: false,
    description: 'An open, doubly curved sheet.',
  },
  {
    name: 'Two sheets in a T', file: 't_sheets.obj', make: tSheets, euler: 0, closed: false,
    description: 'Sheets that meet in an edge of three faces, one with an opening.',
  },
];
