import type { EdgeKind, FieldResult, InspectResult, MeshResult } from 'qmcf';
import { el, show } from '../dom.js';
import * as format from '../format.js';
import type { Session } from '../session.js';
import type { Display, State, Store } from '../state.js';
import { qualityGradient } from '../viewer/palette.js';
import { toggle } from './fields.js';
import { indexSign } from './icons.js';

/** What is drawn, with switches, and what its colours and signs mean. */
export function displayCard(store: Store, session: Session): HTMLElement {
  const change = (part: Partial<Display>) => store.update({ display: { ...store.state.display, ...part } });
  const crosses = toggle('Show cross field', (on) => session.setCrosses(on));
  const streamlines = toggle('Streamlines', (on) => change({ streamlines: on }), 'Lines along the field instead of crosses');
  const constraints = toggle('Constraints', (on) => change({ constraints: on }), 'What pins the field, and which pins were taken back');
  const faceColors = toggle('Face colours', (on) => change({ faceColors: on }));
  const irregular = toggle('Irregular vertices', (on) => change({ irregular: on }));
  const quality = toggle('Colour by quality', (on) => change({ quality: on }));
  const toggles = [crosses, streamlines, constraints, faceColors, irregular, quality];
  const legend = el('ul', { class: 'legend', 'aria-label': 'Legend' });
  const card = el(
    'section',
    { class: 'display', 'aria-label': 'Display' },
    el('div', { class: 'toggles' }, ...toggles.map(({ element }) => element)),
    legend,
  );
  store.subscribe((state, before) => {
    const { display, view } = state;
    const isSame = (['model', 'field', 'mesh', 'view', 'display'] as const).every((key) => state[key] === before[key]);
    if (isSame && state !== before) {
      return;
    }
    show(card, state.model !== undefined);
    crosses.input.checked = display.crosses;
    streamlines.input.checked = display.streamlines;
    constraints.input.checked = display.constraints;
    faceColors.input.checked = display.faceColors;
    irregular.input.checked = display.irregular;
    quality.input.checked = display.quality;
    show(streamlines.element, display.crosses);
    show(constraints.element, display.crosses);
    show(irregular.element, view === 'mesh');
    show(quality.element, view === 'mesh');
    const entries = legendEntries(state);
    legend.replaceChildren(...entries);
    show(legend, entries.length > 0);
  });
  return card;
}

function legendEntries(state: State): HTMLElement[] {
  const { view, display, field, mesh, model } = state;
  return [
    ...(view === 'part' && model ? edgeEntries(model.part) : []),
    ...(display.crosses && field ? fieldEntries(field.result, display) : []),
    ...(view === 'mesh' && mesh ? meshEntries(mesh.result, display) : []),
  ];
}

function entry(sign: Node, text: string, amount: number | undefined): HTMLElement {
  const end = amount === undefined ? [] : [el('b', {}, format.count(amount))];
  return el('li', {}, sign, el('span', {}, text), ...end);
}

function swatch(kind: string): HTMLElement {
  return el('i', { class: `swatch ${kind}`, 'aria-hidden': 'true' });
}

const edgeNames: readonly (readonly [EdgeKind, string])[] = [
  ['sharp', 'Sharp edges'],
  ['label', 'Edges of groups'],
  ['boundary', 'Open boundary'],
  ['nonManifold', 'Non-manifold edges'],
];

function edgeEntries({ report }: InspectResult): HTMLElement[] {
  return edgeNames.flatMap(([kind, name]) => {
    const amount = report.counts.edges[kind];
    return amount > 0 ? [entry(swatch(`line ${kind}`), name, amount)] : [];
  });
}

/** Of `constrained`: kind, swatch, name, and whether it is named without any such pin. */
const pinNames: readonly (readonly [number, string, string, boolean])[] = [
  [1, 'boundary', 'Pinned to boundaries', false],
  [2, 'sharp', 'Pinned to sharp edges', false],
  [3, 'nonManifold', 'Pinned to non-manifold edges', false],
  [4, 'to-curvature', 'Pinned to curvature', true],
  [5, 'to-stroke', 'Pinned to lines', false],
];

function fieldEntries({ singularities, crosses, streamlines }: FieldResult, display: Display): HTMLElement[] {
  const indices = [...new Set(singularities.indices)].sort((a, b) => b - a);
  const signs = indices.map((index) => {
    const amount = singularities.indices.filter((other) => other === index).length;
    return entry(indexSign(index > 0 ? 1 : -1), `Singularity ${index > 0 ? '+' : '−'}${Math.abs(index)} (${4 - index} quads)`, amount);
  });
  const pinnedTo = (kind: number) => crosses.constrained.filter((other) => other === kind).length;
  const lines = display.streamlines ? [entry(swatch('line cross'), 'Streamlines', streamlines.offsets.length - 1)] : [];
  const free = display.streamlines ? [] : [entry(swatch('line cross'), 'Free crosses', pinnedTo(0))];
  if (!display.constraints) {
    const pinned = display.streamlines ? [] : [entry(swatch('line pinned'), 'Pinned crosses', crosses.constrained.length - pinnedTo(0))];
    return [...signs, ...lines, ...pinned, ...free];
  }
  const pins = pinNames.flatMap(([kind, sign, name, always]) => {
    const amount = pinnedTo(kind);
    return amount > 0 || always ? [entry(swatch(`line ${sign}`), name, amount)] : [];
  });
  return [
    ...signs,
    ...lines,
    ...pins,
    entry(swatch('line removed'), 'Pins taken back', crosses.removed.filter((taken) => taken === 1).length),
    ...free,
  ];
}

function meshEntries({ report }: MeshResult, display: Display): HTMLElement[] {
  const { triangles, irregularVertices } = report.quality;
  const scale = el('i', { class: 'scale', 'aria-hidden': 'true' });
  scale.style.background = qualityGradient();
  return [
    ...(display.quality ? [el('li', { class: 'wide' }, el('span', {}, '0'), scale, el('span', {}, '1'), el('span', {}, 'scaled Jacobian'))] : []),
    ...(triangles > 0 ? [entry(swatch(display.quality ? 'triangle outlined' : 'triangle'), 'Triangles', triangles)] : []),
    ...(display.irregular
      ? [entry(indexSign(1), 'Fewer than four elements', undefined), entry(indexSign(-1), 'More than four', undefined), entry(swatch('none'), 'Irregular vertices', irregularVertices)]
      : []),
  ];
}
