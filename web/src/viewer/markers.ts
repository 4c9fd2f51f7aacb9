import { BufferAttribute, BufferGeometry, type Color, Points, ShaderMaterial } from 'three';

/** A point of the scene with its sign: quarter turns, +1 for three quads, -1 for five. */
export interface Marker {
  readonly position: readonly [number, number, number];
  readonly index: number;
}

const vertexShader = /* glsl */ `
  attribute float index4;
  uniform float size;
  varying float turns;
  void main() {
    turns = index4;
    vec4 view = modelViewMatrix * vec4(position, 1.0);
    // A little towards the eye, so that the surface it lies on does not cut it.
    view.xyz *= 0.995;
    gl_Position = projectionMatrix * view;
    gl_PointSize = size;
  }
`;

// A triangle for +1 and a pentagon for -1: the shape tells what the colour tells.
const fragmentShader = /* glsl */ `
  uniform vec3 positive;
  uniform vec3 negative;
  uniform vec3 ring;
  varying float turns;
  float polygon(vec2 p, float sides) {
    float sector = 6.28318530718 / sides;
    float angle = atan(p.x, p.y);
    return cos(floor(0.5 + angle / sector) * sector - angle) * length(p);
  }
  void main() {
    vec2 p = (gl_PointCoord - 0.5) * vec2(2.0, -2.0);
    bool isPositive = turns > 0.0;
    if (isPositive) p.y = -p.y;
    float d = isPositive ? polygon(p + vec2(0.0, 0.16), 3.0) / 0.52 : polygon(p, 5.0) / 0.78;
    float soft = fwidth(d);
    float alpha = 1.0 - smoothstep(1.0 - soft, 1.0, d);
    if (alpha < 0.01) discard;
    vec3 inside = isPositive ? positive : negative;
    gl_FragColor = vec4(mix(inside, ring, smoothstep(0.72 - soft, 0.72, d)), alpha);
    #include <colorspace_fragment>
  }
`;

/** Markers of `size` CSS pixels at every distance. */
export function markerPoints(
  markers: readonly Marker[],
  size: number,
  colors: { positive: Color; negative: Color; ring: Color },
): Points {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(markers.flatMap((m) => m.position)), 3));
  geometry.setAttribute('index4', new BufferAttribute(new Float32Array(markers.map((m) => m.index)), 1));
  const material = new ShaderMaterial({
    vertexShader,
    fragmentShader,
    transparent: true,
    uniforms: {
      size: { value: size },
      positive: { value: colors.positive },
      negative: { value: colors.negative },
      ring: { value: colors.ring },
    },
  });
  const points = new Points(geometry, material);
  points.renderOrder = 3;
  points.onBeforeRender = (renderer) => (material.uniforms['size']!.value = size * renderer.getPixelRatio());
  return points;
}
