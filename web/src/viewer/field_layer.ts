import type { Crosses, FieldResult } from 'qmcf';
import type { Color } from 'three';
import type { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import type { Frame } from './frame.js';
import { Layer } from './layer.js';
import { drawNearer, lineSegments } from './lines.js';
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

/** How the field is shown. */
export interface FieldLook {
  /** Lines along the field instead of crosses. */
  readonly streamlines: boolean;
  /** Pinned crosses by what pins them, and the pins that were taken back. */
  readonly constraints: boolean;
}

/** Some crosses that are drawn alike. */
interface CrossGroup {
  readonly wanted: (crosses: Crosses, i: number) => boolean;
  readonly color: Color;
  readonly factor: number;
  readonly opacity: number;
}

/** The crosses or lines along them, what pins them, and the singularities. */
export class FieldLayer extends Layer {
  private lines: { readonly material: LineMaterial; readonly factor: number }[] = [];
  private look: FieldLook = { streamlines: false, constraints: false };
  private shown: { readonly field: FieldResult; readonly frame: Frame; readonly palette: Palette } | undefined;
  private zoom = 0;

  /** Fits the lines to what a length of 1 measures on the screen, in CSS pixels. */
  setZoom(pixels: number): void {
    this.zoom = pixels;
    const size = this.shown ? this.shown.frame.length(this.shown.field.size) : 0;
    const width = Math.min(widthLimits[1], Math.max(widthLimits[0], relativeWidth * size * pixels));
    for (const { material, factor } of this.lines) {
      material.linewidth = width * factor;
    }
  }

  setLook(look: FieldLook): void {
    if (look.streamlines !== this.look.streamlines || look.constraints !== this.look.constraints) {
      this.look = look;
      this.rebuild();
    }
  }

  show(field: FieldResult, frame: Frame, palette: Palette): void {
    this.shown = { field, frame, palette };
    this.rebuild();
  }

  /** Forgets the field. */
  hide(): void {
    this.shown = undefined;
    this.clear();
  }

  override clear(): this {
    this.lines = [];
    return super.clear();
  }

  private rebuild(): void {
    this.clear();
    if (!this.shown) {
      return;
    }
    const { field, frame, palette } = this.shown;
    if (this.look.streamlines) {
      this.addLines(streamlineEnds(field, frame), palette.cross, 1.3, this.look.constraints ? 0.45 : 1);
    }
    for (const { wanted, color, factor, opacity } of crossGroups(this.look, palette)) {
      this.addLines(crossEnds(field, frame, wanted), color, factor, opacity);
    }
    const markers = singularMarkers(field, frame);
    if (markers.length > 0) {
      this.add(markerPoints(markers, 17, palette));
    }
    this.setZoom(this.zoom);
  }

  private addLines(ends: Float32Array, color: Color, factor: number, opacity: number): void {
    if (ends.length === 0) {
      return;
    }
    const lines = lineSegments(ends, color, 1, opacity);
    lines.renderOrder = 2;
    this.add(lines);
    if (lines instanceof LineSegments2) {
      drawNearer(lines);
      this.lines.push({ material: lines.material, factor });
    }
  }
}

function crossGroups({ streamlines, constraints }: FieldLook, palette: Palette): CrossGroup[] {
  const pinned = (kind: number) => (crosses: Crosses, i: number) => crosses.constrained[i] === kind;
  const free = (crosses: Crosses, i: number) => crosses.constrained[i] === 0;
  if (!constraints) {
    const any = (crosses: Crosses, i: number) => !free(crosses, i);
    return streamlines
      ? []
      : [
          { wanted: free, color: palette.cross, factor: 1, opacity: 1 },
          { wanted: any, color: palette.pinnedCross, factor: pinnedFactor, opacity: 1 },
        ];
  }
  const taken = (crosses: Crosses, i: number) => crosses.removed[i] === 1;
  return [
    ...(streamlines ? [] : [{ wanted: free, color: palette.cross, factor: 0.8, opacity: 0.4 }]),
    ...[1, 2, 3, 4, 5].map((kind) => ({ wanted: pinned(kind), color: palette.pins[kind]!, factor: 2, opacity: 1 })),
    { wanted: taken, color: palette.removedPin, factor: 2.4, opacity: 1 },
  ];
}

/** The segments of all streamlines, x, y, z of both ends each. */
function streamlineEnds({ streamlines }: FieldResult, frame: Frame): Float32Array {
  const places = frame.place(streamlines.positions);
  const { offsets } = streamlines;
  const points = places.length / 3;
  const ends = new Float32Array(6 * Math.max(0, points - (offsets.length - 1)));
  let at = 0;
  for (let line = 0; line + 1 < offsets.length; ++line) {
    for (let i = offsets[line]!; i + 1 < offsets[line + 1]!; ++i) {
      ends.set(places.subarray(3 * i, 3 * i + 6), at);
      at += 6;
    }
  }
  return ends;
}

function crossEnds({ crosses }: FieldResult, frame: Frame, wanted: CrossGroup['wanted']): Float32Array {
  const places = frame.place(crosses.positions);
  const chosen = Array.from(crosses.constrained.keys()).filter((i) => wanted(crosses, i));
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
      ends.set([x - arm * ax, y - arm * ay, z - arm * az, x + arm * ax, y + arm * ay, z + arm * az], at);
      at += 6;
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
