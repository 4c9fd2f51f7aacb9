import type { EdgeKind, FaceReport, InspectResult } from 'qmcf';
import * as format from '../format.js';
import { seenPart, type State, type Target } from '../state.js';

/** What is known of a face, edge or element, for a person. */
export interface TargetInfo {
  readonly title: string;
  readonly facts: readonly (readonly [label: string, value: string])[];
}

const edgeKindNames: Record<EdgeKind, string> = {
  sharp: 'sharp edge',
  label: 'edge between groups',
  boundary: 'open boundary',
  nonManifold: 'non-manifold edge',
};

export const methodNames: Record<FaceReport['method'], string> = {
  qmcf: 'cross field',
  qmorph: 'Q-Morph',
  strip: 'one row',
  recombined: 'paired triangles',
  triangles: 'triangles only',
  given: 'the part’s own triangles',
  omitted: 'left out',
};

/** Undefined when there is no such thing any more. */
export function describe(target: Target, state: State): TargetInfo | undefined {
  switch (target.kind) {
    case 'face':
      return describeFace(target.id, state);
    case 'edge':
      return describeEdge(target.id, state);
    case 'element':
      return describeElement(target.id, state);
  }
}

/** "Face 3", with its name where the file gives one. */
export function faceTitle(face: number, name: string | undefined): string {
  return name === undefined || name === `face ${face}` ? `Face ${face}` : `Face ${face}, ${name}`;
}

function describeFace(id: number, state: State): TargetInfo | undefined {
  const { mesh, view } = state;
  const part = seenPart(state);
  const face = part?.report.faces[id];
  if (!part || !face) {
    return undefined;
  }
  const edges = new Set(face.loops.flat().map(({ edge }) => edge)).size;
  const made = view === 'mesh' ? mesh?.result.report.faces.find((report) => report.face === id) : undefined;
  const counts = made && [
    format.counted(made.quads, 'quad'),
    ...(made.triangles > 0 ? [format.counted(made.triangles, 'triangle')] : []),
  ];
  return {
    title: faceTitle(id, face.name),
    facts: [
      ['Type', `${isFlat(part, id) ? 'flat' : 'curved'}${edges === 0 ? ', closed' : ''}`],
      ['Area', format.length(face.area)],
      ['Border', edges === 0 ? 'none' : `${format.counted(face.loops.length, 'loop')}, ${format.counted(edges, 'edge')}`],
      ['Triangles', format.count(face.triangles)],
      ...(made && counts ? ([['Meshed', `${methodNames[made.method]}: ${counts.join(', ')}`]] as const) : []),
    ],
  };
}

function describeEdge(id: number, state: State): TargetInfo | undefined {
  const part = seenPart(state);
  const edge = part?.report.edges[id];
  if (!part || !edge) {
    return undefined;
  }
  const faces = part.report.faces.flatMap(({ loops }, face) => (loops.flat().some((c) => c.edge === id) ? [face] : []));
  const shape = edge.start === edge.end ? 'closed' : isStraight(part, id, edge.length) ? 'straight' : 'curved';
  return {
    title: `Edge ${id}`,
    facts: [
      ['Type', `${edgeKindNames[edge.kind]}, ${shape}`],
      ['Length', format.length(edge.length)],
      ['Segments', format.count(edge.points - 1)],
      [faces.length === 1 ? 'Face' : 'Faces', faces.join(', ')],
    ],
  };
}

function describeElement(id: number, { mesh }: State): TargetInfo | undefined {
  if (!mesh || id >= mesh.result.elementFace.length) {
    return undefined;
  }
  const { elements, elementFace, elementScaledJacobian, faceNames, report } = mesh.result;
  const face = elementFace[id]!;
  const made = report.faces.find((entry) => entry.face === face);
  return {
    title: `Element ${id}`,
    facts: [
      ['Type', elements[4 * id + 3]! < 0 ? 'triangle' : 'quad'],
      ['Scaled Jacobian', format.figure(elementScaledJacobian[id])],
      ['On', faceTitle(face, faceNames[face])],
      ...(made && made.reason !== '' ? ([['Fallback', methodNames[made.method]]] as const) : []),
    ],
  };
}

/** All normals within a degree of the first one of any length. */
function isFlat({ positions, triangles, triangleFace }: InspectResult, face: number): boolean {
  const least = Math.cos(Math.PI / 180);
  let first: readonly number[] | undefined;
  for (let t = 0; t < triangleFace.length; ++t) {
    if (triangleFace[t] !== face) {
      continue;
    }
    const [a = 0, b = 0, c = 0] = triangles.subarray(3 * t, 3 * t + 3);
    const span = (to: number) => [0, 1, 2].map((axis) => positions[3 * to + axis]! - positions[3 * a + axis]!);
    const [[ux = 0, uy = 0, uz = 0], [vx = 0, vy = 0, vz = 0]] = [span(b), span(c)];
    const normal = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const length = Math.hypot(...normal);
    // The normal of a needle is mere rounding.
    if (length < 1e-3 * Math.max(Math.hypot(ux, uy, uz), Math.hypot(vx, vy, vz)) ** 2) {
      continue;
    }
    const unit = normal.map((n) => n / length);
    first ??= unit;
    if (unit.reduce((sum, n, axis) => sum + n * first![axis]!, 0) < least) {
      return false;
    }
  }
  return true;
}

function isStraight({ positions, edgePoints, edgeOffsets }: InspectResult, edge: number, length: number): boolean {
  const start = 3 * edgePoints[edgeOffsets[edge]!]!;
  const end = 3 * edgePoints[edgeOffsets[edge + 1]! - 1]!;
  const chord = Math.hypot(...[0, 1, 2].map((axis) => positions[end + axis]! - positions[start + axis]!));
  return length - chord < 1e-4 * length;
}
