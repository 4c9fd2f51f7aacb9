import type { RepairItem } from 'qmcf';
import { button, el, setText, show } from '../dom.js';
import * as format from '../format.js';
import type { Session } from '../session.js';
import type { State, Store } from '../state.js';
import { icons } from './icons.js';

/** Which part is open, what is known of it, and how to open another. */
export function modelSection(store: Store, session: Session): HTMLElement {
  const name = el('h2', { class: 'model-name' });
  const facts = el('p', { class: 'facts' });
  const repairs = el('ul', { class: 'notes' });
  const repairBox = el('details', { class: 'repairs' }, el('summary', {}, 'What was repaired'), repairs);
  const gallery = button(icons.gallery(), { class: 'quiet icon-text' }, () => store.update({ galleryOpen: true }));
  gallery.append('Samples');
  const section = el(
    'section',
    { class: 'model', 'aria-label': 'Model' },
    name,
    facts,
    repairBox,
    el('div', { class: 'row' }, openControl(session), gallery),
  );
  store.subscribe((state, before) => {
    if (state === before || state.model !== before.model) {
      setText(name, state.model?.name ?? 'No part yet');
      setText(facts, factsOf(state));
      const items = state.model?.part.report.repair ?? [];
      repairs.replaceChildren(...items.map(repairNote));
      show(repairBox, items.length > 0);
    }
  });
  return section;
}

/** The file picker: the input itself is hidden from sight only. */
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

/** "12 duplicate vertices: merged" */
export function repairNote(item: RepairItem): HTMLElement {
  return el('li', {}, `${format.count(item.count)} ${format.words(item.defect)}: ${item.action}`);
}
