import type { InspectResult, MeshResult } from 'qmcf';
import { Box3, BufferAttribute, BufferGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, Sphere, Vector3 } from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import type { Target } from '../state.js';
import { drawNearer, gather } from './lines.js';
import type { Palette } from './palette.js';

/** What can be marked: the part, and the mesh where that is what is seen. Positions are those in the scene. */
export interface Markable {
  readonly part: InspectResult;
  readonly partPositions: Float32Array;
  readonly mesh: MeshResult | undefined;
  readonly meshPositions: Float32Array;
}

/** Triangles and lines of something, as corners in the scene, three numbers each. */
export interface Outline {
  readonly triangles: Float32Array;
  readonly segments: Float32Array;
}

/** Marks one face, edge or element. What it is made of is kept: a new material would be compiled at every move. */
export class HighlightLayer extends Group {
  private readonly fill = new Mesh(
    new BufferGeometry(),
    new MeshBasicMaterial({ side: DoubleSide, transparent: true, opacity: 0.5, depthWrite: false }),
  );
  /** A dark border makes the bright line stand out from every colour below it. */
  private readonly border = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ linewidth: 8, depthWrite: false }));
  private readonly line = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ linewidth: 4.5 }));

  constructor() {
    super();
    for (const lines of [this.border, this.line]) {
      drawNearer(lines);
    }
    for (const [object, order] of [[this.fill, 1], [this.border, 4], [this.line, 5]] as const) {
      object.renderOrder = order;
      object.visible = false;
      this.add(object);
    }
  }

  show(outline: Outline | undefined, palette: Palette): void {
    const triangles = outline?.triangles ?? new Float32Array();
    const segments = outline?.segments ?? new Float32Array();
    this.fill.visible = triangles.length > 0;
    this.border.visible = this.line.visible = segments.length > 0;
    this.fill.material.color = palette.highlight;
    this.border.material.color = palette.sharp;
    this.line.material.color = palette.highlight;
    this.fill.geometry.dispose();
    this.border.geometry.dispose();
    if (this.fill.visible) {
      this.fill.geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(triangles, 3));
    }
    if (this.line.visible) {
      this.border.geometry = this.line.geometry = new LineSegmentsGeometry().setPositions(segments);
    }
  }
}

/** Where a target is in the scene; undefined when there is no such thing. */
export function outlineOf(target: Target, { part, partPositions, mesh, meshPositions }: Markable): Outline | undefined {
  const none = new Float32Array();
  switch (target.kind) {
    case 'face': {
      const corners = mesh ? cornersOfMeshFace(mesh, target.id) : cornersOfPartFace(part, target.id);
      const positions = mesh ? meshPositions : partPositions;
      return corners.length > 0 ? { triangles: gather(positions, corners), segments: none } : undefined;
    }
    case 'edge': {
      const pairs = mesh ? segmentsOnEdge(mesh, target.id) : pairsAlong(part, target.id);
      return pairs.length > 0 ? { triangles: none, segments: gather(mesh ? meshPositions : partPositions, pairs) } : undefined;
    }
    case 'element': {
      if (!mesh || target.id >= mesh.elementFace.length) {
        return undefined;
      }
      const corners = [...mesh.elements.subarray(4 * target.id, 4 * target.id + 4)].filter((v) => v >= 0);
      const sides = corners.flatMap((v, i) => [v, corners[(i + 1) % corners.length]!]);
      return { triangles: gather(meshPositions, halvesOf(mesh.elements, target.id)), segments: gather(meshPositions, sides) };
    }
  }
}

/** The sphere around an outline and its mean normal, zero for lines. */
export function placeOf({ triangles, segments }: Outline): { sphere: Sphere; normal: Vector3 } {
  const points = triangles.length > 0 ? triangles : segments;
  const sphere = new Box3().setFromArray(points).getBoundingSphere(new Sphere());
  const normal = new Vector3();
  const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
  for (let i = 0; i < triangles.length; i += 9) {
    a.fromArray(triangles, i);
    b.fromArray(triangles, i + 3).sub(a);
    c.fromArray(triangles, i + 6).sub(a);
    normal.add(b.cross(c));
  }
  return { sphere, normal: normal.normalize() };
}

function cornersOfPartFace({ triangles, triangleFace }: InspectResult, face: number): number[] {
  const corners: number[] = [];
  for (let t = 0; t < triangleFace.length; ++t) {
    if (triangleFace[t] === face) {
      corners.push(triangles[3 * t]!, triangles[3 * t + 1]!, triangles[3 * t + 2]!);
    }
  }
  return corners;
}

function cornersOfMeshFace({ elements, elementFace }: MeshResult, face: number): number[] {
  const corners: number[] = [];
  for (let e = 0; e < elementFace.length; ++e) {
    if (elementFace[e] === face) {
      corners.push(...halvesOf(elements, e));
    }
  }
  return corners;
}

/** The vertices of the one or two triangles of an element. */
function halvesOf(elements: Int32Array, element: number): number[] {
  const [a = -1, b = -1, c = -1, d = -1] = elements.subarray(4 * element, 4 * element + 4);
  return d < 0 ? [a, b, c] : [a, b, c, a, c, d];
}

function pairsAlong(part: InspectResult, edge: number): number[] {
  const points = [...part.edgePoints.subarray(part.edgeOffsets[edge] ?? 0, part.edgeOffsets[edge + 1] ?? 0)];
  return points.slice(1).flatMap((point, i) => [points[i]!, point]);
}

function segmentsOnEdge({ featureSegments }: MeshResult, edge: number): number[] {
  const pairs: number[] = [];
  for (let i = 0; i < featureSegments.length; i += 3) {
    if (featureSegments[i + 2] === edge) {
      pairs.push(featureSegments[i]!, featureSegments[i + 1]!);
    }
  }
  return pairs;
}
