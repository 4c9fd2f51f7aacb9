import { Color } from 'three';

/** The colours of the scene; the page's own are in styles/tokens.css. */
export interface Palette {
  /** Of the faces, by tint. */
  readonly faces: readonly Color[];
  readonly plain: Color;
  readonly sharp: Color;
  readonly boundary: Color;
  readonly nonManifold: Color;
  readonly meshEdge: Color;
  readonly triangle: Color;
  readonly cross: Color;
  readonly pinnedCross: Color;
  /** By what pins the cross: nothing, a boundary, a sharp, a non-manifold edge, curvature, the user. */
  readonly pins: readonly Color[];
  readonly removedPin: Color;
  /** What the pointer is on, or what was chosen. */
  readonly highlight: Color;
  /** Edges of the front by how many side edges are missing, 0 to 2, and those to be closed by a seam. */
  readonly frontStates: readonly Color[];
  /** Edges of the front that were put off. */
  readonly failedFront: Color;
  /** Elements of the history: those of the last step, and the others. */
  readonly freshElement: Color;
  readonly grownElement: Color;
  readonly positive: Color;
  readonly negative: Color;
  readonly ring: Color;
  readonly skyLight: Color;
  readonly groundLight: Color;
}

/** Twelve quiet colours, far apart in hue, with turns in lightness for those who see hues less well. */
const faceColors = [
  '#a3dbd2',
  '#f4c59d',
  '#b9c7f4',
  '#eebcd9',
  '#cfe39f',
  '#f3e6a0',
  '#a8d6f5',
  '#d7bdf2',
  '#f3b3ae',
  '#acdfb3',
  '#dccbae',
  '#bccad1',
].map((color) => new Color(color));

const shared = {
  triangle: new Color('#f0883a'),
  positive: new Color('#d63649'),
  negative: new Color('#2f6be0'),
  ring: new Color('#ffffff'),
  highlight: new Color('#ffc400'),
};

export const lightPalette: Palette = {
  ...shared,
  faces: faceColors,
  plain: new Color('#e3e7e2'),
  sharp: new Color('#17211d'),
  boundary: new Color('#0a7f66'),
  nonManifold: new Color('#a3238f'),
  meshEdge: new Color('#1d2b26'),
  cross: new Color('#4a5b54'),
  pinnedCross: new Color('#07806a'),
  pins: ['#4a5b54', '#0a7f66', '#17211d', '#a3238f', '#2a50d0', '#c05a00'].map((color) => new Color(color)),
  removedPin: new Color('#e0141f'),
  frontStates: ['#0a9a5c', '#2f6be0', '#5b3fc4', '#c2188f'].map((color) => new Color(color)),
  failedFront: new Color('#e0141f'),
  freshElement: new Color('#ffd34d'),
  grownElement: new Color('#a3dbd2'),
  skyLight: new Color('#ffffff'),
  groundLight: new Color('#9fa9a6'),
};

export const darkPalette: Palette = {
  ...shared,
  faces: faceColors.map((color) => color.clone().multiplyScalar(0.62)),
  plain: new Color('#b4bcb6'),
  sharp: new Color('#050807'),
  boundary: new Color('#5ff0c6'),
  nonManifold: new Color('#ff7be9'),
  meshEdge: new Color('#0a100e'),
  cross: new Color('#1f2b27'),
  pinnedCross: new Color('#006c56'),
  pins: ['#1f2b27', '#5ff0c6', '#050807', '#ff7be9', '#1733a8', '#8a3d00'].map((color) => new Color(color)),
  removedPin: new Color('#c00012'),
  frontStates: ['#2fe08f', '#6ea4ff', '#a78bff', '#ff6ad0'].map((color) => new Color(color)),
  failedFront: new Color('#ff4a5c'),
  freshElement: new Color('#e0b030'),
  grownElement: new Color('#5f938a'),
  skyLight: new Color('#ffffff'),
  groundLight: new Color('#59625d'),
};

/** Good elements are pale, so that the bad ones are what is seen. */
const qualityStops: readonly [number, Color][] = [
  [0, new Color('#8f1038')],
  [0.3, new Color('#df4a32')],
  [0.6, new Color('#f3bd4e')],
  [0.85, new Color('#c3e0a4')],
  [1, new Color('#d9eee4')],
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
