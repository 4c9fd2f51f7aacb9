/** Number of different colours that faces get while no face has more neighbours than that. */
export const tintCount = 12;

/** Steps from face to face, so that also faces that are not neighbours differ. */
const stride = 5;

/**
 * A colour number per face, such that faces that touch, be it in a point, have different ones wherever that is possible
 * with tintCount colours. Polygons have `cornersEach` corners; a corner of -1 is left out.
 */
export function faceTints(corners: Int32Array, cornersEach: number, face: Int32Array, faceCount: number): Uint8Array {
  const neighbours = neighboursOf(corners, cornersEach, face, faceCount);
  const tints = new Uint8Array(faceCount).fill(255);
  for (let f = 0; f < faceCount; ++f) {
    const taken = new Set<number>();
    for (const other of neighbours[f]!) {
      taken.add(tints[other]!);
    }
    const wanted = (stride * f) % tintCount;
    const free = Array.from({ length: tintCount }, (_, i) => (wanted + i) % tintCount).find((tint) => !taken.has(tint));
    tints[f] = free ?? wanted;
  }
  return tints;
}

function neighboursOf(corners: Int32Array, cornersEach: number, face: Int32Array, faceCount: number): Set<number>[] {
  const neighbours = Array.from({ length: faceCount }, () => new Set<number>());
  const facesAt = new Map<number, Set<number>>();
  const firstFace = new Map<number, number>();
  for (let i = 0; i < corners.length; ++i) {
    const vertex = corners[i]!;
    const own = face[Math.floor(i / cornersEach)]!;
    const first = firstFace.get(vertex);
    if (vertex < 0 || first === own) {
      continue;
    }
    if (first === undefined) {
      firstFace.set(vertex, own);
      continue;
    }
    const faces = facesAt.get(vertex) ?? new Set([first]);
    facesAt.set(vertex, faces.add(own));
  }
  for (const faces of facesAt.values()) {
    for (const a of faces) {
      for (const b of faces) {
        if (a !== b) {
          neighbours[a]!.add(b);
        }
      }
    }
  }
  return neighbours;
}
