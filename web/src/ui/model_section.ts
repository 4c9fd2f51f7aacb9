import type { RepairItem } from 'qmcf';
import { button, el, setText } from '../dom.js';
import * as format from '../format.js';
import type { Session } from '../session.js';
import type { State, Store } from '../state.js';
import { icons } from './icons.js';
import { lookUp } from './look_up.js';

/** Which part is open, what is known of it, and how to open another. */
export function modelSection(store: Store, openControl: HTMLElement): HTMLElement {
  const name = el('h2', { class: 'model-name' });
  const facts = el('p', { class: 'facts' });
  const repairs = el('div', {});
  const gallery = button(icons.gallery(), { class: 'quiet icon-text' }, () => store.update({ galleryOpen: true }));
  gallery.append('Samples');
  const row = el('div', { class: 'row' }, gallery);
  const section = el('section', { class: 'model', 'aria-label': 'Model' }, name, facts, row, lookUp(store), repairs);
  store.subscribe((state, before) => {
    if (!state.galleryOpen && openControl.parentElement !== row) {
      row.prepend(openControl);
    }
    if (state === before || state.model !== before.model) {
      setText(name, state.model?.name ?? 'No part yet');
      setText(facts, factsOf(state));
      repairs.replaceChildren(...(state.model ? repairReport(state.model.part.report.repair) : []));
    }
  });
  return section;
}

/**
 * The file picker; the input itself is hidden from sight only. There is one on the page, so that its name is unique: it
 * is where it can be seen, in the gallery or in the panel.
 */
export function openControl(session: Session): HTMLElement {
  const input = el('input', { type: 'file', class: 'visually-hidden', accept: '.obj,.stl,.ply', 'aria-label': 'Open model' });
  input.addEventListener('change', () => {
    const file = input.files?.[0];
    input.value = '';
    if (file) {
      void session.openFile(file);
    }
  });
  const face = el('span', { 'aria-hidden': 'true' }, 'Open a part');
  return el('label', { class: 'button icon-text' }, input, icons.open(), face);
}

function factsOf({ model }: State): string {
  if (!model) {
    return 'OBJ, STL or PLY. It stays on your machine.';
  }
  const { triangles, faces, edges } = model.part.report.counts;
  return [
    format.counted(triangles, 'triangle'),
    format.counted(faces, 'face'),
    format.counted(edges.total, 'edge'),
  ].join(' · ');
}

/** What was repaired, item by item with counts; nothing when all was well. */
export function repairReport(items: readonly RepairItem[]): HTMLElement[] {
  if (items.length === 0) {
    return [];
  }
  const rows = items.map(({ count, defect, action, elements }) =>
    el(
      'tr',
      {},
      el('td', {}, format.count(count)),
      el('th', { scope: 'row' }, format.words(defect), el('small', {}, action), ...idList(elements, count)),
    ),
  );
  const summary = el('summary', {}, 'What was repaired', el('span', { class: 'count' }, format.counted(items.length, 'item')));
  return [el('details', { class: 'repairs' }, summary, el('table', { class: 'repair-items' }, el('tbody', {}, ...rows)))];
}

/** The first ids in the file, to look for them there. */
function idList(elements: readonly number[], count: number): HTMLElement[] {
  const shown = elements.slice(0, 4);
  const text = `ids ${shown.join(', ')}${shown.length < Math.max(count, elements.length) ? ' …' : ''}`;
  return shown.length > 0 ? [el('small', { class: 'ids' }, text)] : [];
}
