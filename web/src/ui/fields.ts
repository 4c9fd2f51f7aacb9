import { el, setInvalid, uniqueId } from '../dom.js';

/** A number that the user types; only numbers in the range are passed on. */
export interface NumberField {
  readonly element: HTMLElement;
  readonly input: HTMLInputElement;
  /** Shows a value unless the user is typing one. */
  set(text: string): void;
}

interface NumberFieldSettings {
  readonly label: string;
  readonly unit?: string;
  readonly min: number;
  readonly max: number;
  readonly step?: string;
  /** The limits themselves are excluded. */
  readonly open?: boolean;
  /** More about it, for a pointer that stays on it. */
  readonly hint?: string;
  readonly onChange: (value: number) => void;
  /** What an empty field means; without it a number is needed. */
  readonly onClear?: () => void;
  /** Shown in an empty field. */
  readonly placeholder?: string;
}

export function numberField(settings: NumberFieldSettings): NumberField {
  const { label, unit, min, max, step = 'any', open = false, hint, onChange, onClear, placeholder } = settings;
  const id = uniqueId();
  const input = el('input', { id, type: 'number', inputmode: 'decimal', step, min, max, placeholder });
  const isValid = (value: number) => Number.isFinite(value) && (open ? value > min && value < max : value >= min && value <= max);
  input.addEventListener('input', () => {
    const value = input.valueAsNumber;
    if (onClear && input.value === '' && !input.validity.badInput) {
      setInvalid(input, false);
      onClear();
      return;
    }
    setInvalid(input, !isValid(value));
    if (isValid(value)) {
      onChange(value);
    }
  });
  const box = el('div', { class: 'number' }, input, ...(unit ? [el('span', { class: 'unit', 'aria-hidden': 'true' }, unit)] : []));
  return {
    element: el('div', { class: 'field', title: hint }, el('label', { for: id }, label), box),
    input,
    set(text) {
      if (document.activeElement !== input) {
        input.value = text;
        setInvalid(input, false);
      }
    },
  };
}

/** A labelled check box. */
export interface Toggle {
  readonly element: HTMLElement;
  readonly input: HTMLInputElement;
}

export function toggle(label: string, onChange: (on: boolean) => void, hint?: string): Toggle {
  const input = el('input', { type: 'checkbox' });
  input.addEventListener('change', () => onChange(input.checked));
  const text = el('span', {}, label);
  const element = el('label', { class: 'toggle', title: hint }, input, text);
  return { element, input };
}
