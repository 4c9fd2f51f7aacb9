type Child = Node | string;
type Attribute = string | number | boolean | undefined;

/** An element with attributes (a false or undefined one is left out) and children. */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, Attribute> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== undefined && value !== false) {
      element.setAttribute(name, value === true ? '' : String(value));
    }
  }
  element.append(...children);
  return element;
}

/** A button with a handler. */
export function button(
  label: Child,
  attributes: Record<string, Attribute>,
  onClick: (event: MouseEvent) => void,
): HTMLButtonElement {
  const element = el('button', { type: 'button', ...attributes }, label);
  element.addEventListener('click', onClick);
  return element;
}

let lastId = 0;

/** An id for a control and its label. */
export function uniqueId(): string {
  return `c${++lastId}`;
}

/** Parses one of our own constant drawings. */
export function svg(markup: string): SVGElement {
  const holder = document.createElement('template');
  holder.innerHTML = markup;
  return holder.content.firstElementChild as SVGElement;
}

/** Shows or hides without a change where there is none. */
export function show(element: HTMLElement, visible: boolean): void {
  if (element.hidden === visible) {
    element.hidden = !visible;
  }
}

/** Marks what was typed as wrong, or no longer. */
export function setInvalid(input: HTMLInputElement, invalid: boolean): void {
  if (invalid) {
    input.setAttribute('aria-invalid', 'true');
  } else {
    input.removeAttribute('aria-invalid');
  }
}

/** Sets the text without a change where there is none, so that nothing is read out twice. */
export function setText(element: HTMLElement, text: string): void {
  if (element.textContent !== text) {
    element.textContent = text;
  }
}
