import { button, el, show } from '../dom.js';
import type { Session } from '../session.js';
import type { Store, View } from '../state.js';

const views: readonly (readonly [View, string])[] = [
  ['part', 'Part'],
  ['field', 'Field'],
  ['mesh', 'Mesh'],
  ['front', 'Front'],
];

/** Switches between the part, its field, its mesh and, where that was recorded, how it was made. */
export function viewBar(store: Store, session: Session): HTMLElement {
  const buttons = views.map(
    ([view, label]) => [view, button(label, { 'aria-pressed': 'false' }, () => session.setView(view))] as const,
  );
  const element = el('div', { class: 'views', role: 'group', 'aria-label': 'View' }, ...buttons.map(([, b]) => b));
  store.subscribe((state) => {
    show(element, state.model !== undefined);
    for (const [view, b] of buttons) {
      b.setAttribute('aria-pressed', String(view === state.view));
      b.disabled = view === 'mesh' && !state.mesh;
      show(b, view !== 'front' || state.mesh?.result.trace !== undefined);
    }
  });
  return element;
}
