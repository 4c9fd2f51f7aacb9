import { el, uniqueId } from '../dom.js';
import * as format from '../format.js';
import type { Session } from '../session.js';
import type { Store } from '../state.js';
import { numberField } from './fields.js';

const sliderMin = 100;
const sliderMax = 100_000;
const largestCount = 10_000_000;

/** The element size as a length and as a count, which follow each other. */
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
    onChange: (value) => session.changeSettings({ sizedBy: 'quads', quads: Math.round(value) }),
  });
  const id = uniqueId();
  const slider = el('input', { id, type: 'range', min: 0, max: 1, step: 0.005, 'aria-label': 'Fineness' });
  slider.addEventListener('input', () => {
    const count = sliderMin * (sliderMax / sliderMin) ** slider.valueAsNumber;
    session.changeSettings({ sizedBy: 'quads', quads: Number(count.toPrecision(2)) });
  });
  store.subscribe(({ settings, model }) => {
    size.set(settings.size > 0 ? format.length(settings.size) : '');
    quads.set(String(settings.quads));
    const place = Math.log(settings.quads / sliderMin) / Math.log(sliderMax / sliderMin);
    const text = Math.min(1, Math.max(0, place)).toFixed(3);
    slider.value = text;
    slider.style.setProperty('--at', text);
    slider.setAttribute('aria-valuetext', `about ${format.counted(settings.quads, 'quad')}`);
    size.element.dataset['leading'] = String(settings.sizedBy === 'size');
    quads.element.dataset['leading'] = String(settings.sizedBy === 'quads');
    for (const input of [size.input, quads.input, slider]) {
      input.disabled = !model;
    }
  });
  return el(
    'section',
    { 'aria-label': 'Size' },
    el('div', { class: 'pair' }, size.element, quads.element),
    slider,
    el('div', { class: 'ends', 'aria-hidden': 'true' }, el('span', {}, 'coarse'), el('span', {}, 'fine')),
  );
}
