import type { EdgeKind, InspectResult } from 'qmcf';
import { BufferAttribute, BufferGeometry, type Color, DoubleSide, Mesh, MeshStandardMaterial } from 'three';
import type { Frame } from './frame.js';
import { Layer } from './layer.js';
import { lineSegments, gather } from './lines.js';
import { cornerNormals } from './normals.js';
import type { Palette } from './palette.js';
import { faceTints } from './tints.js';

/** How the part is shown: alone, or as the quiet ground of a field or of nothing. */
export interface PartLook {
  readonly faceColors: boolean;
  /** Paler, so that what is drawn on it stands out. */
  readonly ground: boolean;
}

const lineWidths: Record<EdgeKind, number> = { sharp: 2, label: 1.5, boundary: 2.5, nonManifold: 3 };

/** The shaded part with its feature lines. */
export class PartLayer extends Layer {
  private paint: (() => void) | undefined;
  private look: PartLook = { faceColors: true, ground: false };

  show(part: InspectResult, frame: Frame, palette: Palette): void {
    this.clear();
    const positions = frame.place(part.positions);
    this.add(this.surface(part, positions, palette));
    for (const kind of ['sharp', 'label', 'boundary', 'nonManifold'] as const) {
      const pairs = segmentPairs(part, kind);
      if (pairs.length > 0) {
        const lines = lineSegments(gather(positions, pairs), lineColor(kind, palette), lineWidths[kind]);
        lines.renderOrder = 1;
        this.add(lines);
      }
    }
  }

  setLook(look: PartLook): void {
    if (look.faceColors !== this.look.faceColors || look.ground !== this.look.ground) {
      this.look = look;
      this.paint?.();
    }
  }

  private surface(part: InspectResult, positions: Float32Array, palette: Palette): Mesh {
    const corners = part.triangles;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(gather(positions, corners), 3));
    const normals = cornerNormals({ positions, corners, cornersEach: 3, face: part.triangleFace });
    geometry.setAttribute('normal', new BufferAttribute(normals, 3));
    const colors = new BufferAttribute(new Float32Array(3 * corners.length), 3);
    geometry.setAttribute('color', colors);
    const tints = faceTints(part.triangles, 3, part.triangleFace, part.faceNames.length);
    this.paint = () => {
      const faceColors = Array.from(tints, (tint) => this.colorOf(tint, palette));
      for (let corner = 0; corner < corners.length; ++corner) {
        const color = faceColors[part.triangleFace[Math.floor(corner / 3)]!] ?? palette.plain;
        colors.setXYZ(corner, color.r, color.g, color.b);
      }
      colors.needsUpdate = true;
    };
    this.paint();
    return new Mesh(geometry, surfaceMaterial());
  }

  private colorOf(tint: number, palette: Palette): Color {
    const color = (this.look.faceColors ? palette.faces[tint]! : palette.plain).clone();
    return this.look.ground ? color.lerp(palette.plain, 0.55) : color;
  }
}

/** The material of everything solid; pushed back a little so that lines on it are drawn whole. */
export function surfaceMaterial(): MeshStandardMaterial {
  return new MeshStandardMaterial({
    vertexColors: true,
    side: DoubleSide,
    roughness: 0.62,
    metalness: 0,
    polygonOffset: true,
    polygonOffsetFactor: 1.5,
    polygonOffsetUnits: 2,
  });
}

function lineColor(kind: EdgeKind, palette: Palette): Color {
  return kind === 'boundary' ? palette.boundary : kind === 'nonManifold' ? palette.nonManifold : palette.sharp;
}

function segmentPairs(part: InspectResult, kind: EdgeKind): number[] {
  const pairs: number[] = [];
  part.edgeKinds.forEach((edgeKind, edge) => {
    const last = part.edgeOffsets[edge + 1]! - 1;
    for (let i = part.edgeOffsets[edge]!; edgeKind === kind && i < last; ++i) {
      pairs.push(part.edgePoints[i]!, part.edgePoints[i + 1]!);
    }
  });
  return pairs;
}
