import { BufferAttribute, BufferGeometry, type Color, LineBasicMaterial, LineSegments, type Object3D } from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';

/** Above this many segments lines are one pixel wide: wide ones cost a rectangle each. */
const wideLimit = 120_000;

/** Lines are drawn that much nearer than they are, in depth from -1 to 1: where chords pass below the part. */
const nearer = 0.0015;

/** Line segments, x, y, z of both ends each, `width` in CSS pixels. */
export function lineSegments(ends: Float32Array, color: Color, width: number, opacity = 1): Object3D {
  const transparent = opacity < 1;
  if (ends.length / 6 > wideLimit) {
    const geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(ends, 3));
    return new LineSegments(geometry, new LineBasicMaterial({ color, transparent, opacity }));
  }
  const geometry = new LineSegmentsGeometry();
  geometry.setPositions(ends);
  const material = new LineMaterial({ color: color.getHex(), linewidth: width, transparent, opacity });
  return new LineSegments2(geometry, material);
}

/** Draws wide lines nearer than they are; being triangles their depth can be shifted. Thin ones stay. */
export function drawNearer(lines: Object3D): void {
  if (lines instanceof LineSegments2) {
    lines.material.onBeforeCompile = (shader) => {
      shader.vertexShader = shader.vertexShader.replace(
        'gl_Position = clip;',
        `clip.z -= ${nearer.toFixed(5)} * clip.w;\n\t\t\tgl_Position = clip;`,
      );
    };
  }
}

/** The positions of the given vertices, one after the other. */
export function gather(positions: Float32Array, vertices: ArrayLike<number>): Float32Array {
  const out = new Float32Array(3 * vertices.length);
  for (let i = 0; i < vertices.length; ++i) {
    out.set(positions.subarray(3 * vertices[i]!, 3 * vertices[i]! + 3), 3 * i);
  }
  return out;
}
