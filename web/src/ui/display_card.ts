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
  const faceColors = toggle('Face colours', (on) => change({ faceColors: on }));
  const irregular = toggle('Irregular vertices', (on) => change({ irregular: on }));
  const quality = toggle('Colour by quality', (on) => change({ quality: on }));
  const legend = el('ul', { class: 'legend', 'aria-label': 'Legend' });
  const card = el(
    'section',
    { class: 'display', 'aria-label': 'Display' },
    el('div', { class: 'toggles' }, crosses.element, faceColors.element, irregular.element, quality.element),
    legend,
  );
  store.subscribe((state) => {
    const { display, view } = state;
    show(card, state.model !== undefined);
    crosses.input.checked = display.crosses;
    faceColors.input.checked = display.faceColors;
    irregular.input.checked = display.irregular;
    quality.input.checked = display.quality;
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
    ...(display.crosses && field ? fieldEntries(field.result) : []),
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

function fieldEntries({ singularities, crosses }: FieldResult): HTMLElement[] {
  const positive = singularities.indices.filter((index) => index > 0).length;
  const pinned = crosses.constrained.filter((kind) => kind > 0).length;
  return [
    entry(indexSign(1), 'Singularity +1 (3 quads)', positive),
    entry(indexSign(-1), 'Singularity −1 (5 quads)', singularities.indices.length - positive),
    entry(swatch('line pinned'), 'Pinned crosses', pinned),
    entry(swatch('line cross'), 'Free crosses', crosses.constrained.length - pinned),
  ];
}

function meshEntries({ report }: MeshResult, display: Display): HTMLElement[] {
  const { triangles, irregularVertices } = report.quality;
  const scale = el('i', { class: 'scale', 'aria-hidden': 'true' });
  scale.style.background = qualityGradient();
  return [
    ...(display.quality ? [el('li', { class: 'wide' }, el('span', {}, '0'), scale, el('span', {}, '1'), el('span', {}, 'scaled Jacobian'))] : []),
    ...(!display.quality && triangles > 0 ? [entry(swatch('triangle'), 'Triangles', triangles)] : []),
    ...(display.irregular
      ? [entry(indexSign(1), 'Fewer than four elements', undefined), entry(indexSign(-1), 'More than four', undefined), entry(swatch('none'), 'Irregular vertices', irregularVertices)]
      : []),
  ];
}
