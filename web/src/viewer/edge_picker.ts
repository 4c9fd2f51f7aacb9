import type { InspectResult } from 'qmcf';
import { Vector3, type PerspectiveCamera } from 'three';

/** How near the pointer has to be, in CSS pixels. */
const reach = 7;
/** Part of the distance by which an edge may lie behind the surface that is hit, and still be seen. */
const tolerance = 0.01;

/** Finds the edge of a part that is drawn at a place of the screen. */
export class EdgePicker {
  /** Per point along all edges: x and y in CSS pixels, distance from the camera. */
  private readonly seen: Float32Array;
  private readonly places: Float32Array;

  constructor(
    private readonly part: InspectResult,
    positions: Float32Array,
  ) {
    this.places = new Float32Array(3 * part.edgePoints.length);
    part.edgePoints.forEach((point, i) => this.places.set(positions.subarray(3 * point, 3 * point + 3), 3 * i));
    this.seen = new Float32Array(this.places.length);
  }

  /**
   * @param depth - Distance from the camera of the surface there; what lies behind is hidden.
   * @returns the nearest edge on the screen, if one is near enough.
   */
  pick(camera: PerspectiveCamera, x: number, y: number, width: number, height: number, depth: number): number | undefined {
    this.project(camera, width, height);
    const { edgeOffsets } = this.part;
    let [best, least] = [-1, reach * reach];
    for (let edge = 0; edge + 1 < edgeOffsets.length; ++edge) {
      for (let i = edgeOffsets[edge]!; i < edgeOffsets[edge + 1]! - 1; ++i) {
        const distance = this.squaredDistance(i, x, y, depth * (1 + tolerance));
        if (distance < least) {
          [best, least] = [edge, distance];
        }
      }
    }
    return best < 0 ? undefined : best;
  }

  private project(camera: PerspectiveCamera, width: number, height: number): void {
    const point = new Vector3();
    for (let i = 0; i < this.places.length; i += 3) {
      point.fromArray(this.places, i);
      this.seen[i + 2] = point.distanceTo(camera.position);
      point.project(camera);
      this.seen[i] = ((point.x + 1) / 2) * width;
      this.seen[i + 1] = ((1 - point.y) / 2) * height;
      if (point.z > 1) {
        this.seen[i + 2] = Infinity;
      }
    }
  }

  private squaredDistance(segment: number, x: number, y: number, depth: number): number {
    const a = 3 * segment;
    const [ax, ay] = [this.seen[a]!, this.seen[a + 1]!];
    const [bx, by] = [this.seen[a + 3]! - ax, this.seen[a + 4]! - ay];
    const share = Math.min(1, Math.max(0, ((x - ax) * bx + (y - ay) * by) / (bx * bx + by * by || 1)));
    const isHidden = this.seen[a + 2]! + share * (this.seen[a + 5]! - this.seen[a + 2]!) > depth;
    return isHidden ? Infinity : (ax + share * bx - x) ** 2 + (ay + share * by - y) ** 2;
  }
}
