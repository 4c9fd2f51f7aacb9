import type { Mode } from 'qmcf';
import { el, uniqueId } from '../dom.js';
import type { Session } from '../session.js';
import type { Settings, Store } from '../state.js';
import { numberField, toggle } from './fields.js';

type Constraint = Extract<keyof Settings, `align${string}`>;

const constraints: readonly (readonly [Constraint, string, string])[] = [
  ['alignBoundary', 'Open boundaries', 'Quads run along the edges where the surface ends.'],
  ['alignSharp', 'Sharp edges', 'Quads run along the edges that are sharper than the feature angle.'],
  ['alignNonManifold', 'Non-manifold edges', 'Quads run along the edges where more than two sheets meet.'],
  ['alignCurvature', 'Curvature', 'Quads run along the directions of principal curvature where these are clear.'],
];

const modes: readonly (readonly [Mode, string])[] = [
  ['qmcf', 'QMCF, along the cross field'],
  ['qmorph', 'Q-Morph, to compare with'],
];

/** Features, the advancing front, and what the field follows. */
export function optionsSection(store: Store, session: Session): HTMLElement {
  const angle = numberField({
    label: 'Feature angle',
    unit: '°',
    min: 0,
    max: 180,
    open: true,
    onChange: (featureAngle) => session.changeSettings({ featureAngle }),
  });
  const gradation = numberField({
    label: 'Gradation',
    min: 0.01,
    max: 1,
    hint: 'How much the element size may grow along a length of one: the less, the smoother and the more elements.',
    onChange: (value) => session.changeSettings({ gradation: value }),
  });
  const toggles = constraints.map(
    ([name, label, hint]) => [name, toggle(label, (on) => session.changeSettings({ [name]: on }), hint)] as const,
  );
  const id = uniqueId();
  const mode = el('select', { id }, ...modes.map(([value, label]) => el('option', { value }, label)));
  mode.addEventListener('change', () => session.changeSettings({ mode: mode.value as Mode }));
  const allQuad = toggle(
    'Quadrilaterals only',
    (on) => session.changeSettings({ allQuad: on }),
    'The last triangles become quads, too, together with what lies between them.',
  );
  const record = toggle(
    'Record the front',
    (on) => store.update({ record: on }),
    'Keep how each face is meshed, to be played step by step.',
  );
  store.subscribe(({ settings, record: isRecorded }) => {
    record.input.checked = isRecorded;
    angle.set(String(settings.featureAngle));
    gradation.set(String(settings.gradation));
    mode.value = settings.mode;
    allQuad.input.checked = settings.allQuad;
    for (const [name, { input }] of toggles) {
      input.checked = settings[name];
    }
  });
  return el(
    'details',
    { class: 'options' },
    el('summary', {}, 'Features and directions'),
    el('div', { class: 'pair' }, angle.element, gradation.element),
    el('div', { class: 'field' }, el('label', { for: id }, 'Advancing front'), mode),
    allQuad.element,
    record.element,
    el(
      'fieldset',
      {},
      el('legend', {}, 'The field follows'),
      el('div', { class: 'toggles' }, ...toggles.map(([, { element }]) => element)),
    ),
  );
}
