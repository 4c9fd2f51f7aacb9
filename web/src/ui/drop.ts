import { el, show } from '../dom.js';
import type { Session } from '../session.js';

/** Opens a file that is dropped anywhere on the page. */
export function dropZone(session: Session): HTMLElement {
  const element = el('div', { class: 'drop', hidden: true, 'aria-hidden': 'true' }, el('p', {}, 'Drop to open'));
  let depth = 0;
  const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
  const enter = (step: number) => (event: DragEvent) => {
    if (hasFiles(event)) {
      event.preventDefault();
      depth += step;
      show(element, depth > 0);
    }
  };
  window.addEventListener('dragenter', enter(1));
  window.addEventListener('dragleave', enter(-1));
  window.addEventListener('dragover', (event) => {
    if (hasFiles(event)) {
      event.preventDefault();
    }
  });
  window.addEventListener('drop', (event) => {
    depth = 0;
    show(element, false);
    const file = event.dataTransfer?.files[0];
    if (file) {
      event.preventDefault();
      void session.openFile(file);
    }
  });
  return element;
}
