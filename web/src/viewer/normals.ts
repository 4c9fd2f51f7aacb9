/** Polygons of one size, and the face that each belongs to. A corner of -1 is left out. */
export interface Polygons {
  readonly positions: Float32Array;
  readonly corners: Int32Array;
  readonly cornersEach: number;
  readonly face: Int32Array;
}

/**
 * One normal per corner (x, y, z each): smooth inside a face, sharp between faces. Each polygon counts by its area.
 */
export function cornerNormals({ positions, corners, cornersEach, face }: Polygons): Float32Array {
  // Vertices are split by face: a list of splits per vertex, in flat arrays.
  const firstSplit = new Int32Array(positions.length / 3).fill(-1);
  const nextSplit: number[] = [];
  const faceOfSplit: number[] = [];
  const splitOfCorner = new Int32Array(corners.length).fill(-1);
  for (let i = 0; i < corners.length; ++i) {
    const vertex = corners[i]!;
    if (vertex < 0) {
      continue;
    }
    const wanted = face[Math.floor(i / cornersEach)]!;
    let split = firstSplit[vertex]!;
    while (split >= 0 && faceOfSplit[split] !== wanted) {
      split = nextSplit[split]!;
    }
    if (split < 0) {
      split = faceOfSplit.length;
      faceOfSplit.push(wanted);
      nextSplit.push(firstSplit[vertex]!);
      firstSplit[vertex] = split;
    }
    splitOfCorner[i] = split;
  }
  const sums = new Float32Array(3 * faceOfSplit.length);
  for (let first = 0; first < corners.length; first += cornersEach) {
    const area = areaVector(positions, corners, first, cornersEach);
    for (let i = first; i < first + cornersEach; ++i) {
      const split = splitOfCorner[i]!;
      for (let axis = 0; axis < 3 && split >= 0; ++axis) {
        sums[3 * split + axis]! += area[axis]!;
      }
    }
  }
  const normals = new Float32Array(3 * corners.length);
  for (let i = 0; i < corners.length; ++i) {
    const at = 3 * splitOfCorner[i]!;
    if (at >= 0) {
      const [x, y, z] = [sums[at]!, sums[at + 1]!, sums[at + 2]!];
      const size = Math.hypot(x, y, z) || 1;
      normals.set([x / size, y / size, z / size], 3 * i);
    }
  }
  return normals;
}

/** Half the cross product of the diagonals, or of two edges of a triangle, doubled. */
function areaVector(
  positions: Float32Array,
  corners: Int32Array,
  first: number,
  cornersEach: number,
): [number, number, number] {
  const isQuad = cornersEach === 4 && corners[first + 3]! >= 0;
  const at = (corner: number, axis: number) => positions[3 * corners[first + corner]! + axis]!;
  const span = (from: number, to: number) =>
    [at(to, 0) - at(from, 0), at(to, 1) - at(from, 1), at(to, 2) - at(from, 2)] as const;
  const a = isQuad ? span(0, 2) : span(0, 1);
  const b = isQuad ? span(1, 3) : span(0, 2);
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}
