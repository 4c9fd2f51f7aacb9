import { el, setInvalid, show } from '../dom.js';
import { seenPart, type Store, type Target } from '../state.js';

type Kind = Extract<Target['kind'], 'face' | 'edge'>;

/** Chooses faces and edges by their numbers: what the pointer can do, for the keyboard and for ids from a report. */
export function lookUp(store: Store): HTMLElement {
  const kind = el(
    'select',
    { 'aria-label': 'Look up' },
    el('option', { value: 'face' }, 'Face'),
    el('option', { value: 'edge' }, 'Edge'),
  );
  const number = el('input', { type: 'number', min: 0, step: 1, inputmode: 'numeric', 'aria-label': 'Its number' });
  const amount = (of: Kind) => seenPart(store.state)?.report.counts[of === 'face' ? 'faces' : 'edges'];
  const howMany = () => {
    const counted = amount(kind.value as Kind);
    return typeof counted === 'object' ? counted.total : (counted ?? 0);
  };
  const choose = () => {
    const id = number.valueAsNumber;
    const isValid = Number.isInteger(id) && id >= 0 && id < howMany();
    setInvalid(number, number.value !== '' && !isValid);
    store.update({ chosen: isValid ? { kind: kind.value as Kind, id } : undefined });
  };
  number.addEventListener('input', choose);
  kind.addEventListener('change', choose);
  const element = el('div', { class: 'row look-up' }, kind, number);
  store.subscribe(({ model, chosen }) => {
    show(element, model !== undefined);
    const last = howMany() - 1;
    number.max = String(last);
    number.placeholder = last < 0 ? 'none' : `number, 0 to ${last}`;
    if (document.activeElement === number || document.activeElement === kind) {
      return;
    }
    if (chosen && chosen.kind !== 'element') {
      kind.value = chosen.kind;
      number.value = String(chosen.id);
    } else {
      number.value = '';
    }
    setInvalid(number, false);
  });
  return element;
}
