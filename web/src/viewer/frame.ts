/**
 * Where the model is in the scene: moved to the origin and scaled to a diagonal of 2, in double precision, so that parts
 * of any size and offset look the same.
 */
export class Frame {
  private constructor(
    private readonly centre: readonly [number, number, number],
    private readonly scale: number,
  ) {}

  static around(positions: Float64Array): Frame {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < positions.length; ++i) {
      const axis = i % 3;
      low[axis] = Math.min(low[axis]!, positions[i]!);
      high[axis] = Math.max(high[axis]!, positions[i]!);
    }
    const half = low.map((l, axis) => (high[axis]! - l) / 2);
    const centre = low.map((l, axis) => l + half[axis]!) as [number, number, number];
    return new Frame(centre, 1 / (Math.hypot(...half) || 1));
  }

  /** Positions of the model as positions of the scene. */
  place(positions: Float64Array): Float32Array<ArrayBuffer> {
    const out = new Float32Array(positions.length);
    for (let i = 0; i < positions.length; ++i) {
      out[i] = (positions[i]! - this.centre[i % 3]!) * this.scale;
    }
    return out;
  }

  /** A length of the model as a length of the scene. */
  length(value: number): number {
    return value * this.scale;
  }
}
