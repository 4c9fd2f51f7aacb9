import type { MeshReport, MeshResult, QualityReport } from 'qmcf';
import { button, el, show } from '../dom.js';
import * as format from '../format.js';
import { optionsKey, type Made, type Store, type Target } from '../state.js';
import { qualityColor } from '../viewer/palette.js';
import { icons } from './icons.js';
import { repairReport } from './model_section.js';
import { faceTitle, methodNames } from './target_info.js';

/** The figures of the mesh, and all that was not as it should be. */
export function resultSection(store: Store, zoomTo: (target: Target) => void): HTMLElement {
  const body = el('div', { class: 'result-body' });
  const old = el('p', { class: 'hint' }, 'The settings have changed since this mesh was made.');
  const section = el('section', { class: 'result', 'aria-label': 'Result' }, old, body);
  store.subscribe((state, before) => {
    const { mesh } = state;
    show(section, mesh !== undefined);
    show(old, mesh !== undefined && mesh.optionsKey !== optionsKey(state.settings));
    if (mesh && (state === before || mesh !== before.mesh)) {
      const hasCreases = mesh.part.edgeKinds.includes('sharp');
      body.replaceChildren(...report(mesh, hasCreases, zoomTo));
    }
  });
  return section;
}

function report({ result, seconds }: Made<MeshResult>, hasCreases: boolean, zoomTo: (target: Target) => void): HTMLElement[] {
  const { quality, repair } = result.report;
  // Without creases the edges counted as sharp are what curvature was cut into.
  const isNoise = !hasCreases && typeof quality.sharpRecall === 'number';
  const exceptions = exceptionsOf(result.report);
  return [
    verdict(quality),
    headline(quality),
    histogram(result.elementScaledJacobian),
    worstElement(result, zoomTo),
    figures(result.report, result.size, !isNoise),
    ...(isNoise
      ? [el('p', { class: 'facts' }, 'The part has no creases: where its triangles meet at more than the feature angle, that is taken as curvature.')]
      : []),
    methods(result, zoomTo),
    ...(exceptions === '' ? [] : [el('p', { class: 'facts' }, exceptions)]),
    ...repairReport(repair),
    el('p', { class: 'facts' }, `Made in ${format.duration(seconds)}, element size ${format.length(result.size)}.`),
  ];
}

function verdict({ valid, checks }: QualityReport): HTMLElement {
  const failed = checks.filter(({ status }) => status === 'fail');
  const warned = checks.filter(({ status }) => status === 'warn');
  const text = valid
    ? `Valid: ${checks.filter(({ status }) => status !== 'skip').length - warned.length} checks passed`
    : `Not valid: ${format.counted(failed.length, 'check')} failed`;
  const sentences = [...failed, ...warned].map(({ sentence }) => el('li', {}, sentence));
  return el(
    'div',
    { class: 'verdict', 'data-kind': valid ? 'good' : 'bad' },
    el('p', { class: 'badge' }, valid ? icons.check() : icons.warn(), text),
    ...(sentences.length > 0 ? [el('ul', { class: 'notes' }, ...sentences)] : []),
  );
}

function headline(quality: QualityReport): HTMLElement {
  const big = (value: string, label: string, kind = '') =>
    el('div', { class: `big ${kind}` }, el('dd', {}, value), el('dt', {}, label));
  return el(
    'dl',
    { class: 'headline' },
    big(format.count(quality.quads), quality.quads === 1 ? 'quad' : 'quads'),
    big(format.count(quality.triangles), quality.triangles === 1 ? 'triangle' : 'triangles', quality.triangles > 0 ? 'warm' : ''),
    big(format.percent(quality.regularShare), 'regular vertices'),
  );
}

const bins = 20;

/** How many elements have which scaled Jacobian; heights by square root, so that single bad elements can be seen. */
function histogram(values: Float64Array): HTMLElement {
  const counts = new Array<number>(bins).fill(0);
  for (const value of values) {
    const bin = Math.min(bins - 1, Math.max(0, Math.floor(value * bins)));
    counts[bin]! += 1;
  }
  const most = Math.max(...counts, 1);
  const bars = counts.map((amount, i) => {
    const bar = el('i', { title: `${(i / bins).toFixed(2)} to ${((i + 1) / bins).toFixed(2)}: ${format.counted(amount, 'element')}` });
    bar.style.height = `${amount === 0 ? 0 : Math.max(4, 100 * Math.sqrt(amount / most))}%`;
    bar.style.background = `#${qualityColor((i + 0.5) / bins).getHexString()}`;
    return bar;
  });
  return el(
    'figure',
    { class: 'histogram' },
    el('div', { class: 'bars', role: 'img', 'aria-label': 'Distribution of the scaled Jacobian' }, ...bars),
    el('figcaption', {}, el('span', {}, '0'), el('span', {}, 'scaled Jacobian'), el('span', {}, '1')),
  );
}

function figures({ quality, sizeConformity }: MeshReport, size: number, tellsCreases: boolean): HTMLElement {
  const shapes: [string, QualityReport['scaledJacobian']][] = [
    ['Scaled Jacobian', quality.scaledJacobian],
    ['Jacobian ratio', quality.jacobianRatio],
    ['Aspect ratio', quality.aspectRatio],
    ['Orthogonal quality', quality.orthogonalQuality],
  ];
  const distance = quality.largestDistance;
  const singles: [string, string][] = [
    ['Off the size wanted, mean', `${format.figure(sizeConformity.meanAbsLog2)} octaves`],
    ...(tellsCreases
      ? ([
          ['Sharp edges kept', format.percent(quality.sharpRecall)],
          ['Corners kept', format.percent(quality.cornerRecall)],
        ] as [string, string][])
      : []),
    ...(typeof quality.boundaryRecall === 'number'
      ? ([['Boundary kept', format.percent(quality.boundaryRecall)]] as [string, string][])
      : []),
    ['Largest distance', typeof distance === 'number' ? `${((100 * distance) / size).toFixed(1)} % of size` : format.none],
  ];
  const head = el('tr', {}, el('th', { scope: 'col' }, 'Shape of quads'), el('th', { scope: 'col' }, 'mean'), el('th', { scope: 'col' }, 'worst 1 %'), el('th', { scope: 'col' }, 'worst'));
  const rows = shapes.map(([label, { mean, p1, worst }]) =>
    el('tr', {}, el('th', { scope: 'row' }, label), ...[mean, p1, worst].map((v) => el('td', {}, format.figure(v)))),
  );
  const others = singles.map(([label, text]) => el('tr', {}, el('th', { scope: 'row' }, label), el('td', { colspan: 3 }, text)));
  return el('table', { class: 'figures' }, el('thead', {}, head), el('tbody', {}, ...rows, ...others));
}

/** Goes to the element with the least scaled Jacobian. */
function worstElement({ elementScaledJacobian }: MeshResult, zoomTo: (target: Target) => void): HTMLElement {
  let worst = 0;
  elementScaledJacobian.forEach((value, element) => (worst = value < elementScaledJacobian[worst]! ? element : worst));
  const label = el('span', {}, 'Worst element', el('b', {}, format.figure(elementScaledJacobian[worst])));
  const go = button(icons.zoom(), { class: 'button icon-text worst' }, () => zoomTo({ kind: 'element', id: worst }));
  go.append(label);
  return go;
}

/** Where the mesh could not be made as everywhere else. */
function exceptionsOf({ elementsCut, refinedPlaces, heldFaces, heldPlaces }: MeshReport): string {
  const told: string[] = [];
  if (elementsCut) told.push('Elements of twice the size, each cut up: with paired triangles there was no whole, valid mesh.');
  if (refinedPlaces > 0) {
    told.push(`Smaller elements at ${format.counted(refinedPlaces, 'place')} that elements of the size could not follow.`);
  }
  if (heldFaces > 0) {
    told.push(`${format.counted(heldFaces, 'face')} not relaxed with the others: the mesh would not be valid.`);
  }
  if (heldPlaces > 0) {
    told.push(`${format.counted(heldPlaces, 'place')} not relaxed: the mesh would not be valid.`);
  }
  return told.join(' ');
}

/** How the faces were meshed, and each one that another method than the first had to mesh. */
function methods({ report, faceNames }: MeshResult, zoomTo: (target: Target) => void): HTMLElement {
  const { faces } = report;
  const sized = report.fittedSizes ? ' Sizes vary to fit the field.' : '';
  const fallen = faces.filter(({ reason }) => reason !== '');
  if (fallen.length === 0) {
    const how = faces[0]?.method === 'qmorph' ? 'by the original Q-Morph' : 'along the cross field';
    const text = faces.length === 1 ? `The face was meshed ${how}` : `All ${format.count(faces.length)} faces were meshed ${how}`;
    const narrow = faces.filter(({ method }) => method === 'strip').length;
    return el('p', { class: 'facts' }, `${narrow === 0 ? text : `${text}; narrow ones, ${format.count(narrow)}, as one row of elements`}.${sized}`);
  }
  const items = fallen.map(({ face, method, reason }) =>
    el(
      'li',
      {},
      button(faceTitle(face, faceNames[face]), { class: 'link' }, () => zoomTo({ kind: 'face', id: face })),
      `, ${methodNames[method]}: ${reason}`,
    ),
  );
  const title = `${format.count(fallen.length)} of ${format.counted(faces.length, 'face')} meshed by a fallback${sized && `.${sized}`}`;
  return el('details', { open: fallen.length <= 5 }, el('summary', {}, title), el('ul', { class: 'notes' }, ...items));
}
