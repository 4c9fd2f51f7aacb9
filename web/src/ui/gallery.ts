import { button, el, show } from '../dom.js';
import { samples, type Sample } from '../samples.js';
import type { Session } from '../session.js';
import type { Store } from '../state.js';
import { notice } from './footer.js';
import { icons, mark } from './icons.js';

/** The first thing that is seen: drop a part, open one with the page's file picker, or take a sample. */
export function gallery(store: Store, session: Session, openControl: HTMLElement): HTMLElement {
  const close = button(icons.close(), { class: 'quiet icon close', 'aria-label': 'Close samples' }, () => store.update({ galleryOpen: false }));
  const welcome = el(
    'div',
    { class: 'welcome' },
    mark(),
    el('h1', {}, 'Drop a part, get quads'),
    el(
      'p',
      {},
      'A quad mesh that follows the edges, the curvature and the element size you ask for. Everything is computed on this machine; nothing is uploaded.',
    ),
  );
  const row = el('div', { class: 'row' });
  const list = el('ul', { class: 'samples' }, ...samples.map((sample) => el('li', {}, sampleCard(sample, session))));
  const element = el(
    'div',
    { class: 'gallery', role: 'region', 'aria-label': 'Samples' },
    close,
    welcome,
    row,
    notice(store, session),
    el('h2', { class: 'divider' }, 'or take one of ours'),
    list,
  );
  element.addEventListener('keydown', (event) => {
    if (event.key === 'Escape' && store.state.model) {
      store.update({ galleryOpen: false });
    }
  });
  store.subscribe((state) => {
    show(element, state.galleryOpen);
    if (state.galleryOpen && openControl.parentElement !== row) {
      row.append(openControl);
    }
    show(close, state.model !== undefined);
    element.classList.toggle('first', state.model === undefined);
  });
  return element;
}

function sampleCard(sample: Sample, session: Session): HTMLButtonElement {
  const picture = sample.picture
    ? [el('img', { src: sample.picture, alt: '', width: 220, height: 150, loading: 'lazy', draggable: 'false' })]
    : [];
  const text = el('span', {}, el('strong', {}, sample.name), el('small', {}, sample.description));
  const card = button(text, { class: 'sample' }, () => void session.openSample(sample));
  card.prepend(...picture);
  return card;
}
