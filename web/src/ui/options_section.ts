import { el } from '../dom.js';
import type { Session } from '../session.js';
import type { Settings, Store } from '../state.js';
import { numberField, select, toggle } from './fields.js';

type Constraint = Extract<keyof Settings, `align${string}`>;

const constraints: readonly (readonly [Constraint, string, string])[] = [
  ['alignBoundary', 'Open boundaries', 'Quads run along the edges where the surface ends.'],
  ['alignSharp', 'Sharp edges', 'Quads run along the edges that are sharper than the feature angle.'],
  ['alignNonManifold', 'Non-manifold edges', 'Quads run along the edges where more than two sheets meet.'],
  ['alignCurvature', 'Curvature', 'Quads run along the directions of principal curvature where these are clear.'],
];

/** Features, what the field follows, and the method. */
export function optionsSection(store: Store, session: Session): HTMLElement {
  const angle = numberField({
    label: 'Feature angle',
    unit: '°',
    min: 0,
    max: 180,
    open: true,
    onChange: (featureAngle) => session.changeSettings({ featureAngle }),
  });
  const method = select(
    'Method',
    [
      ['qmcf', 'Cross field (QMCF)'],
      ['qmorph', 'Classic Q-Morph'],
    ],
    (mode) => session.changeSettings({ mode }),
  );
  const toggles = constraints.map(
    ([name, label, hint]) => [name, toggle(label, (on) => session.changeSettings({ [name]: on }), hint)] as const,
  );
  store.subscribe(({ settings }) => {
    angle.set(String(settings.featureAngle));
    method.input.value = settings.mode;
    for (const [name, { input }] of toggles) {
      input.checked = settings[name];
    }
  });
  return el(
    'details',
    { class: 'options' },
    el('summary', {}, 'Features and directions'),
    el('div', { class: 'pair' }, angle.element, method.element),
    el(
      'fieldset',
      {},
      el('legend', {}, 'The field follows'),
      el('div', { class: 'toggles' }, ...toggles.map(([, { element }]) => element)),
    ),
  );
}
