import { button, el, setText, show, uniqueId } from '../dom.js';
import * as format from '../format.js';
import type { Session } from '../session.js';
import { canFit, fitsSizes, type Store } from '../state.js';
import { numberField, toggle } from './fields.js';

const sliderMin = 100;
const sliderMax = 100_000;
const largestCount = 10_000_000;

/** The element size as a length and as a count, which follow each other, and what else makes for smaller elements. */
export function sizeSection(store: Store, session: Session): HTMLElement {
  const size = numberField({
    label: 'Element size',
    min: 0,
    max: Infinity,
    open: true,
    onChange: (value) => session.changeSettings({ sizedBy: 'size', size: value }),
  });
  const quads = numberField({
    label: 'Number of quads',
    min: 1,
    max: largestCount,
    step: '1',
    onChange: (value) => session.changeSettings({ sizedBy: 'quads', quads: Math.round(value), sizes: undefined }),
  });
  const chordError = numberField({
    label: 'Chord error',
    min: 0,
    max: Infinity,
    open: true,
    placeholder: 'any',
    hint: 'How far edges of elements may be from curved faces, in units of the part: less makes smaller ones there.',
    onChange: (curvature) => session.changeSettings({ curvature }),
    onClear: () => session.changeSettings({ curvature: undefined }),
  });
  const sizes = sizesControl(store, session);
  const fit = toggle(
    'Fit sizes to the field',
    (fitSizes) => session.changeSettings({ fitSizes }),
    'Let sizes vary, mostly by less than 1.5 and by 3 at most either way, where that promises better elements: fewer rows end inside faces.',
  );
  const id = uniqueId();
  const slider = el('input', { id, type: 'range', min: 0, max: 1, step: 0.005, 'aria-label': 'Fineness' });
  slider.addEventListener('input', () => {
    const count = sliderMin * (sliderMax / sliderMin) ** slider.valueAsNumber;
    session.changeSettings({ sizedBy: 'quads', quads: Number(count.toPrecision(2)), sizes: undefined });
  });
  store.subscribe(({ settings, model }) => {
    size.set(settings.size > 0 ? format.length(settings.size) : '');
    quads.set(String(settings.quads));
    chordError.set(settings.curvature === undefined ? '' : String(settings.curvature));
    const place = Math.log(settings.quads / sliderMin) / Math.log(sliderMax / sliderMin);
    const text = Math.min(1, Math.max(0, place)).toFixed(3);
    slider.value = text;
    slider.style.setProperty('--at', text);
    slider.setAttribute('aria-valuetext', `about ${format.counted(settings.quads, 'quad')}`);
    size.element.dataset['leading'] = String(settings.sizedBy === 'size');
    quads.element.dataset['leading'] = String(settings.sizedBy === 'quads');
    fit.input.checked = fitsSizes(settings);
    for (const input of [size.input, quads.input, chordError.input, slider]) {
      input.disabled = !model;
    }
    fit.input.disabled = !model || !canFit(settings);
  });
  return el(
    'section',
    { 'aria-label': 'Size' },
    el('div', { class: 'pair' }, size.element, quads.element),
    slider,
    el('div', { class: 'ends', 'aria-hidden': 'true' }, el('span', {}, 'coarse'), el('span', {}, 'fine')),
    el('div', { class: 'pair' }, chordError.element, sizes),
    fit.element,
  );
}

/** The picker of a file with sizes at the vertices, which file that is, and the way to do without again. */
function sizesControl(store: Store, session: Session): HTMLElement {
  const input = el('input', {
    type: 'file',
    class: 'visually-hidden',
    accept: '.txt,text/plain',
    'aria-label': 'Sizes file',
  });
  input.addEventListener('change', () => {
    const file = input.files?.[0];
    input.value = '';
    if (file) {
      void session.openSizes(file);
    }
  });
  const name = el('span', { class: 'file-name', 'aria-hidden': 'true' });
  const picker = el('label', { class: 'button file' }, input, name);
  const clear = button('×', { class: 'quiet icon', 'aria-label': 'Clear sizes file' }, () => session.clearSizes());
  store.subscribe(({ settings, model }) => {
    setText(name, settings.sizes?.name ?? 'Open a file');
    picker.dataset['leading'] = String(settings.sizes !== undefined);
    input.disabled = !model;
    show(clear, settings.sizes !== undefined);
  });
  return el(
    'div',
    { class: 'field', title: 'One edge length per line for each vertex of the part, in the order of its file.' },
    el('span', { class: 'label', 'aria-hidden': 'true' }, 'Sizes at vertices'),
    el('div', { class: 'row' }, picker, clear),
  );
}
