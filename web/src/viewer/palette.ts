import { Color } from 'three';

/** The colours of the scene; the page's own are in styles/tokens.css. */
export interface Palette {
  /** Lightness and chroma of the faces, OKLCH-like. */
  readonly faceLightness: number;
  readonly faceSaturation: number;
  readonly plain: Color;
  readonly sharp: Color;
  readonly boundary: Color;
  readonly nonManifold: Color;
  readonly meshEdge: Color;
  readonly triangle: Color;
  readonly cross: Color;
  readonly pinnedCross: Color;
  readonly positive: Color;
  readonly negative: Color;
  readonly ring: Color;
  readonly skyLight: Color;
  readonly groundLight: Color;
}

const shared = {
  triangle: new Color('#f0883a'),
  positive: new Color('#d63649'),
  negative: new Color('#2f6be0'),
  ring: new Color('#ffffff'),
};

export const lightPalette: Palette = {
  ...shared,
  faceLightness: 0.83,
  faceSaturation: 0.42,
  plain: new Color('#e3e7e2'),
  sharp: new Color('#17211d'),
  boundary: new Color('#0a7f66'),
  nonManifold: new Color('#a3238f'),
  meshEdge: new Color('#1d2b26'),
  cross: new Color('#4a5b54'),
  pinnedCross: new Color('#07806a'),
  skyLight: new Color('#ffffff'),
  groundLight: new Color('#9fa9a6'),
};

export const darkPalette: Palette = {
  ...shared,
  faceLightness: 0.68,
  faceSaturation: 0.24,
  plain: new Color('#b4bcb6'),
  sharp: new Color('#050807'),
  boundary: new Color('#5ff0c6'),
  nonManifold: new Color('#ff7be9'),
  meshEdge: new Color('#0a100e'),
  cross: new Color('#1f2b27'),
  pinnedCross: new Color('#006c56'),
  skyLight: new Color('#ffffff'),
  groundLight: new Color('#59625d'),
};

const goldenRatio = 0.6180339887498949;

/** A quiet colour for a face; neighbours in number are far apart in hue. */
export function faceColor(face: number, palette: Palette): Color {
  const hue = (0.42 + face * goldenRatio) % 1;
  // Alternating lightness keeps faces apart for those who see hues less well.
  const lightness = palette.faceLightness + (face % 3) * 0.025 - 0.025;
  return new Color().setHSL(hue, palette.faceSaturation, lightness);
}

const qualityStops: readonly [number, Color][] = [
  [0, new Color('#a01c3c')],
  [0.3, new Color('#e0583a')],
  [0.6, new Color('#f3c55b')],
  [0.85, new Color('#9fd4a4')],
  [1, new Color('#178f79')],
];

/** The colour of a scaled Jacobian; 0 and below share the worst one. */
export function qualityColor(value: number): Color {
  const upper = Math.max(1, qualityStops.findIndex(([at]) => at >= Math.min(1, Math.max(0, value))));
  const [from, low] = qualityStops[upper - 1]!;
  const [to, high] = qualityStops[upper]!;
  return low.clone().lerp(high, Math.min(1, Math.max(0, (value - from) / (to - from))));
}

/** The quality scale for a legend in the page. */
export function qualityGradient(): string {
  return `linear-gradient(90deg, ${qualityStops.map(([at, c]) => `#${c.getHexString()} ${at * 100}%`).join(', ')})`;
}
