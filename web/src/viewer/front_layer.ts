import type { MeshTrace } from 'qmcf';
import { BufferAttribute, BufferGeometry, type Color, DoubleSide, Mesh, MeshStandardMaterial } from 'three';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import type { Corners, FaceReplay, Playback } from '../replay.js';
import type { Frame } from './frame.js';
import { Layer } from './layer.js';
import { drawNearer, gather, lineSegments } from './lines.js';
import type { Palette } from './palette.js';

const frontWidth = 3.2;
const baseWidth = 5.5;
/** Of the front where the part is before it. */
const throughOpacity = 0.3;

/** The mesh of a face while it grows, and the front by state. */
export class FrontLayer extends Layer {
  private readonly past = new Layer();
  private readonly present = new Layer();
  private pastCount = -1;

  constructor() {
    super();
    this.add(this.past, this.present);
  }

  /** Forgets everything. */
  hide(): void {
    this.past.clear();
    this.present.clear();
    this.pastCount = -1;
  }

  show(playback: Playback, frame: Frame, palette: Palette): void {
    const { finished, current, trace } = playback;
    if (finished.length !== this.pastCount) {
      this.past.clear();
      this.pastCount = finished.length;
      for (const face of finished) {
        addElements(this.past, face, placed(face, trace, frame), palette, true);
      }
    }
    this.present.clear();
    const positions = placed(current, trace, frame);
    addElements(this.present, current, positions, palette, false);
    this.addFront(current, positions, palette);
  }

  private addFront(face: FaceReplay, positions: Float32Array, palette: Palette): void {
    const byState: number[][] = palette.frontStates.map(() => []);
    for (const { from, to, state = 2 } of face.front()) {
      byState[state]!.push(from, to);
    }
    byState.forEach((pairs, state) => this.addLines(gather(positions, pairs), palette.frontStates[state]!, frontWidth));
    const { failed = [], base = [] } = face.last ?? {};
    this.addLines(gather(positions, failed), palette.failedFront, baseWidth);
    this.addLines(gather(positions, base), palette.highlight, baseWidth);
  }

  private addLines(ends: Float32Array, color: Color, width: number): void {
    if (ends.length === 0) {
      return;
    }
    const lines = lineSegments(ends, color, width);
    drawNearer(lines);
    lines.renderOrder = 4;
    this.present.add(lines);
    // On the far side of the part it shows through.
    const hidden = lineSegments(ends, color, width, throughOpacity);
    if (hidden instanceof LineSegments2) {
      hidden.material.depthTest = false;
      hidden.renderOrder = 3;
      this.present.add(hidden);
    }
  }
}

/** The face's vertices in the scene. */
function placed(face: FaceReplay, { origin, unit }: MeshTrace, frame: Frame): Float32Array {
  return frame.place(Float64Array.from(face.positions, (value, i) => origin[i % 3]! + unit * value));
}

function addElements(layer: Layer, face: FaceReplay, positions: Float32Array, palette: Palette, isPast: boolean): void {
  const corners: number[] = [];
  const colors: number[] = [];
  const edges: number[] = [];
  const drawn = new Set<number>();
  for (const [id, element] of face.elements) {
    const color = face.fresh.has(id) && !isPast ? palette.freshElement : element[3] < 0 ? palette.triangle : palette.grownElement;
    for (const corner of trianglesOf(element)) {
      corners.push(corner);
      colors.push(color.r, color.g, color.b);
    }
    const count = element[3] < 0 ? 3 : 4;
    for (let i = 0; i < count; ++i) {
      const [from, to] = [element[i]!, element[(i + 1) % count]!];
      // Most edges have two elements: the line is drawn once.
      const key = Math.min(from, to) * 2 ** 26 + Math.max(from, to);
      if (!drawn.has(key)) {
        drawn.add(key);
        edges.push(from, to);
      }
    }
  }
  if (corners.length === 0) {
    return;
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(gather(positions, corners), 3));
  geometry.setAttribute('color', new BufferAttribute(new Float32Array(colors), 3));
  geometry.computeVertexNormals();
  const surface = new Mesh(geometry, elementMaterial());
  surface.renderOrder = 1;
  const lines = lineSegments(gather(positions, edges), palette.meshEdge, 1, isPast ? 0.5 : 0.85);
  drawNearer(lines);
  lines.renderOrder = 2;
  layer.add(surface, lines);
}

/** On the part, but below every line. */
function elementMaterial(): MeshStandardMaterial {
  return new MeshStandardMaterial({
    vertexColors: true,
    side: DoubleSide,
    roughness: 0.62,
    metalness: 0,
    polygonOffset: true,
    polygonOffsetFactor: -0.4,
    polygonOffsetUnits: -2,
  });
}

function trianglesOf([a, b, c, d]: Corners): number[] {
  return d < 0 ? [a, b, c] : [a, b, c, a, c, d];
}
