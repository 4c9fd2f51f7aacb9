import { button } from '../dom.js';

/** A pointer that moved further than this, in CSS pixels, dragged the handle; else it pressed it. */
const dragDistance = 24;

/**
 * Makes the panel a sheet at the bottom of a small screen, that a drag or a press of its handle opens and closes.
 * Returns what closes it.
 */
export function makeSheet(panel: HTMLElement): () => void {
  let start = 0;
  let moved = 0;
  const setOpen = (open: boolean) => {
    panel.dataset['sheet'] = open ? 'open' : 'peek';
    handle.setAttribute('aria-expanded', String(open));
  };
  const handle = button('', { class: 'handle', 'aria-label': 'Show all settings' }, ({ detail }) => {
    // A press of a key makes a click without a pointer: detail is 0.
    const dragged = detail > 0 && Math.abs(moved) > dragDistance;
    setOpen(dragged ? moved < 0 : panel.dataset['sheet'] !== 'open');
  });
  handle.addEventListener('pointerdown', (event) => {
    start = event.clientY;
    moved = 0;
    handle.setPointerCapture(event.pointerId);
  });
  handle.addEventListener('pointerup', (event) => (moved = event.clientY - start));
  setOpen(false);
  panel.prepend(handle);
  return () => setOpen(false);
}
