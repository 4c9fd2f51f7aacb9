import { el } from '../dom.js';
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

/** Features, and what the field follows. */
export function optionsSection(store: Store, session: Session): HTMLElement {
  const angle = numberField({
    label: 'Feature angle',
    unit: '°',
    min: 0,
    max: 180,
    open: true,
    onChange: (featureAngle) => session.changeSettings({ featureAngle }),
  });
  const toggles = constraints.map(
    ([name, label, hint]) => [name, toggle(label, (on) => session.changeSettings({ [name]: on }), hint)] as const,
  );
  store.subscribe(({ settings }) => {
    angle.set(String(settings.featureAngle));
    for (const [name, { input }] of toggles) {
      input.checked = settings[name];
    }
  });
  return el(
    'details',
    { class: 'options' },
    el('summary', {}, 'Features and directions'),
    angle.element,
    el(
      'fieldset',
      {},
      el('legend', {}, 'The field follows'),
      el('div', { class: 'toggles' }, ...toggles.map(([, { element }]) => element)),
    ),
  );
}
