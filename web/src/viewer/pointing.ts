import type { Store, Target } from '../state.js';
import type { Viewer } from './viewer.js';

/** A pointer that moved further than this between press and release, in CSS pixels, turned the view; else it clicked. */
const clickDistance = 5;

/** Marks what a mouse is on, chooses what is clicked or tapped, and goes to what is clicked twice. */
export function watchPointer(
  canvas: HTMLCanvasElement,
  viewer: Viewer,
  store: Store,
  zoomTo: (target: Target) => void,
): void {
  let place: PointerEvent | undefined;
  let scheduled = false;
  const look = () => {
    scheduled = false;
    const { hover } = store.state;
    const found = place && viewer.pick(place.clientX, place.clientY);
    if (!place || !found) {
      if (hover) {
        store.update({ hover: undefined });
      }
      return;
    }
    // The same object for the same target: what depends on it needs no new look.
    const target = isSame(hover?.target, found) ? hover!.target : found;
    store.update({ hover: { target, x: place.clientX, y: place.clientY } });
  };
  const lookSoon = (at: PointerEvent | undefined) => {
    place = at;
    if (!scheduled) {
      scheduled = true;
      requestAnimationFrame(look);
    }
  };
  canvas.addEventListener('pointermove', (event) => lookSoon(event.pointerType === 'mouse' && event.buttons === 0 ? event : undefined));
  canvas.addEventListener('pointerleave', () => lookSoon(undefined));
  let pressed = { x: 0, y: 0 };
  canvas.addEventListener('pointerdown', ({ clientX, clientY }) => (pressed = { x: clientX, y: clientY }));
  canvas.addEventListener('click', ({ clientX, clientY }) => {
    if (Math.hypot(clientX - pressed.x, clientY - pressed.y) <= clickDistance) {
      store.update({ chosen: viewer.pick(clientX, clientY) });
    }
  });
  canvas.addEventListener('dblclick', ({ clientX, clientY }) => {
    const target = viewer.pick(clientX, clientY);
    if (target) {
      zoomTo(target);
    }
  });
  window.addEventListener('keydown', ({ key }) => {
    if (key === 'Escape' && store.state.chosen && !store.state.galleryOpen) {
      store.update({ chosen: undefined });
    }
  });
}

/** Whether both are the same face, edge or element, or both nothing. */
export function isSame(a: Target | undefined, b: Target | undefined): boolean {
  return a?.kind === b?.kind && a?.id === b?.id;
}
