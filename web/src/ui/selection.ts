import { button, el, show } from '../dom.js';
import type { Store, Target } from '../state.js';
import { icons } from './icons.js';
import { describe, type TargetInfo } from './target_info.js';

/** Distance of the tip from the pointer, in CSS pixels. */
const tipDistance = 16;

/** What the pointer is on, next to it. The same can be had by keyboard: see lookUp(). */
export function hoverTip(store: Store): HTMLElement {
  const tip = el('div', { class: 'tip', 'aria-hidden': 'true', hidden: true });
  store.subscribe((state, before) => {
    const { hover } = state;
    const info = hover && describe(hover.target, state);
    show(tip, info !== undefined);
    if (!hover || !info) {
      return;
    }
    if (hover.target !== before.hover?.target) {
      tip.replaceChildren(el('strong', {}, info.title), factList(info));
    }
    const { offsetWidth, offsetHeight } = tip;
    const left = hover.x + tipDistance + offsetWidth > innerWidth ? hover.x - tipDistance - offsetWidth : hover.x + tipDistance;
    const top = Math.min(hover.y + tipDistance, innerHeight - offsetHeight - tipDistance);
    tip.style.transform = `translate(${Math.max(0, left)}px, ${Math.max(0, top)}px)`;
  });
  return tip;
}

/** What was chosen, by a click, a tap or its number. */
export function selectionCard(store: Store, zoomTo: (target: Target) => void): HTMLElement {
  const content = el('div', { role: 'group', 'aria-live': 'polite', 'aria-label': 'Chosen' });
  const zoom = button(icons.zoom(), { class: 'quiet icon', 'aria-label': 'Zoom to it', title: 'Zoom to it' }, () => {
    const { chosen } = store.state;
    if (chosen) {
      zoomTo(chosen);
    }
  });
  const close = button(icons.close(), { class: 'quiet icon', 'aria-label': 'Choose nothing', title: 'Choose nothing' }, () =>
    store.update({ chosen: undefined }),
  );
  const card = el('section', { class: 'selection', 'aria-label': 'Selection', hidden: true }, content, zoom, close);
  store.subscribe((state, before) => {
    const info = state.chosen && describe(state.chosen, state);
    show(card, info !== undefined);
    const isSame = (['chosen', 'model', 'mesh', 'view'] as const).every((key) => state[key] === before[key]);
    if (info && !isSame) {
      content.replaceChildren(el('strong', {}, info.title), factList(info));
    }
  });
  return card;
}

function factList({ facts }: TargetInfo): HTMLElement {
  return el('dl', {}, ...facts.flatMap(([label, value]) => [el('dt', {}, label), el('dd', {}, value)]));
}
