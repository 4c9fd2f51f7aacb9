import type { FieldResult } from 'qmcf';
import type { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import type { Frame } from './frame.js';
import { Layer } from './layer.js';
import { lineSegments } from './lines.js';
import { markerPoints, type Marker } from './markers.js';
import type { Palette } from './palette.js';

/** Half the length of a cross's arms, in element sizes. */
const armLength = 0.3;
/** Height above the surface, in element sizes. */
const lift = 0.04;

/** Width of the lines in element sizes, and its limits in CSS pixels: small crosses must not run into each other. */
const relativeWidth = 0.075;
const widthLimits = [0.45, 1.7] as const;
/** Pinned crosses are that much bolder. */
const pinnedFactor = 1.5;

/** The crosses, those that are pinned in another colour, and the singularities. */
export class FieldLayer extends Layer {
  private lines: { readonly material: LineMaterial; readonly factor: number }[] = [];
  private size = 0;

  /** Fits the lines to what a length of 1 measures on the screen, in CSS pixels. */
  setZoom(pixels: number): void {
    const width = Math.min(widthLimits[1], Math.max(widthLimits[0], relativeWidth * this.size * pixels));
    for (const { material, factor } of this.lines) {
      material.linewidth = width * factor;
    }
  }

  show(field: FieldResult, frame: Frame, palette: Palette): void {
    this.clear();
    this.lines = [];
    this.size = frame.length(field.size);
    for (const pinned of [false, true]) {
      const ends = crossEnds(field, frame, pinned);
      if (ends.length > 0) {
        const lines = lineSegments(ends, pinned ? palette.pinnedCross : palette.cross, 1);
        lines.renderOrder = 2;
        this.add(lines);
        if (lines instanceof LineSegments2) {
          this.lines.push({ material: lines.material, factor: pinned ? pinnedFactor : 1 });
        }
      }
    }
    const markers = singularMarkers(field, frame);
    if (markers.length > 0) {
      this.add(markerPoints(markers, 17, palette));
    }
  }
}

function crossEnds({ crosses }: FieldResult, frame: Frame, pinned: boolean): Float32Array {
  const places = frame.place(crosses.positions);
  const chosen = Array.from(crosses.constrained.keys()).filter((i) => crosses.constrained[i]! > 0 === pinned);
  const ends = new Float32Array(12 * chosen.length);
  let at = 0;
  for (const i of chosen) {
    const size = frame.length(crosses.sizes[i]!);
    const [nx = 0, ny = 0, nz = 0] = crosses.normals.subarray(3 * i, 3 * i + 3);
    const [dx = 0, dy = 0, dz = 0] = crosses.directions.subarray(3 * i, 3 * i + 3);
    const [x, y, z] = [
      places[3 * i]! + nx * lift * size,
      places[3 * i + 1]! + ny * lift * size,
      places[3 * i + 2]! + nz * lift * size,
    ];
    const arm = armLength * size;
    const other = [ny * dz - nz * dy, nz * dx - nx * dz, nx * dy - ny * dx] as const;
    for (const [ax, ay, az] of [[dx, dy, dz] as const, other]) {
      ends[at++] = x - arm * ax;
      ends[at++] = y - arm * ay;
      ends[at++] = z - arm * az;
      ends[at++] = x + arm * ax;
      ends[at++] = y + arm * ay;
      ends[at++] = z + arm * az;
    }
  }
  return ends;
}

function singularMarkers({ singularities, size }: FieldResult, frame: Frame): Marker[] {
  const places = frame.place(singularities.positions);
  const height = 2 * lift * frame.length(size);
  return Array.from(singularities.indices, (index, i) => ({
    index,
    position: [0, 1, 2].map((axis) => places[3 * i + axis]! + height * singularities.normals[3 * i + axis]!) as [
      number,
      number,
      number,
    ],
  }));
}
