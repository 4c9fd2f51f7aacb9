import type { Ray } from 'three';

/** Triangles in one box: few enough to test them all, many enough to save boxes. */
const blockSize = 128;

/** A point where a ray meets a surface. */
export interface SurfaceHit {
  readonly triangle: number;
  /** From the ray's origin. */
  readonly distance: number;
}

/**
 * Finds the first triangle on a ray. Consecutive triangles share a bounding box: files list neighbours near each other,
 * and where one does not, it is only slower.
 */
export class SurfacePicker {
  private readonly boxes: Float32Array;

  /** @param corners - Three vertices of each triangle. */
  constructor(
    private readonly positions: Float32Array,
    private readonly corners: ArrayLike<number>,
  ) {
    const blocks = Math.ceil(corners.length / 3 / blockSize);
    this.boxes = new Float32Array(6 * blocks);
    for (let block = 0; block < blocks; ++block) {
      const box = this.boxes.subarray(6 * block, 6 * block + 6).fill(-Infinity, 3).fill(Infinity, 0, 3);
      const end = Math.min(corners.length, 3 * blockSize * (block + 1));
      for (let i = 3 * blockSize * block; i < end; ++i) {
        for (let axis = 0; axis < 3; ++axis) {
          const value = positions[3 * corners[i]! + axis]!;
          box[axis] = Math.min(box[axis]!, value);
          box[axis + 3] = Math.max(box[axis + 3]!, value);
        }
      }
    }
  }

  pick(ray: Ray): SurfaceHit | undefined {
    const origin = ray.origin.toArray();
    const direction = ray.direction.toArray();
    let [triangle, distance] = [-1, Infinity];
    for (let block = 0; 6 * block < this.boxes.length; ++block) {
      if (!meetsBox(this.boxes, 6 * block, origin, direction, distance)) {
        continue;
      }
      const end = Math.min(this.corners.length / 3, blockSize * (block + 1));
      for (let t = blockSize * block; t < end; ++t) {
        const at = this.distanceTo(t, origin, direction);
        if (at < distance) {
          [triangle, distance] = [t, at];
        }
      }
    }
    return triangle < 0 ? undefined : { triangle, distance };
  }

  /** Möller and Trumbore 1997; infinite without a hit. */
  private distanceTo(triangle: number, origin: readonly number[], direction: readonly number[]): number {
    const { positions, corners } = this;
    const [a, b, c] = [3 * corners[3 * triangle]!, 3 * corners[3 * triangle + 1]!, 3 * corners[3 * triangle + 2]!];
    const [ax, ay, az] = [positions[a]!, positions[a + 1]!, positions[a + 2]!];
    const [ux, uy, uz] = [positions[b]! - ax, positions[b + 1]! - ay, positions[b + 2]! - az];
    const [vx, vy, vz] = [positions[c]! - ax, positions[c + 1]! - ay, positions[c + 2]! - az];
    const [dx = 0, dy = 0, dz = 0] = direction;
    const [px, py, pz] = [dy * vz - dz * vy, dz * vx - dx * vz, dx * vy - dy * vx];
    const determinant = ux * px + uy * py + uz * pz;
    const [sx, sy, sz] = [origin[0]! - ax, origin[1]! - ay, origin[2]! - az];
    const first = (sx * px + sy * py + sz * pz) / determinant;
    const [qx, qy, qz] = [sy * uz - sz * uy, sz * ux - sx * uz, sx * uy - sy * ux];
    const second = (dx * qx + dy * qy + dz * qz) / determinant;
    const distance = (vx * qx + vy * qy + vz * qz) / determinant;
    return first >= 0 && second >= 0 && first + second <= 1 && distance > 0 ? distance : Infinity;
  }
}

function meetsBox(
  boxes: Float32Array,
  first: number,
  origin: readonly number[],
  direction: readonly number[],
  before: number,
): boolean {
  let [near, far] = [0, before];
  for (let axis = 0; axis < 3; ++axis) {
    const inverse = 1 / direction[axis]!;
    const a = (boxes[first + axis]! - origin[axis]!) * inverse;
    const b = (boxes[first + axis + 3]! - origin[axis]!) * inverse;
    near = Math.max(near, Math.min(a, b));
    far = Math.min(far, Math.max(a, b));
  }
  return near <= far;
}
