import { outputFormats, type OutputFormat } from 'qmcf';
import { button, el, setText, show } from '../dom.js';
import * as format from '../format.js';
import type { Session } from '../session.js';
import { optionsKey, type Running, type State, type Store } from '../state.js';
import { icons } from './icons.js';

const formatNames: Record<OutputFormat, string> = {
  obj: 'OBJ',
  vtu: 'VTU',
  ply: 'PLY',
  stl: 'STL, triangles',
  msh: 'Gmsh MSH',
  inp: 'Abaqus INP',
  bdf: 'Nastran BDF',
};

/** What can always be reached: messages, progress, and the buttons that make, stop and save a mesh. */
export function footer(store: Store, session: Session): HTMLElement {
  const status = el('p', { class: 'status', role: 'status' });
  const generate = button('Generate mesh', { class: 'button primary' }, () => void session.generate());
  const cancel = button('Cancel', { class: 'button' }, () => session.cancel());
  const { element: saving, saveButton } = downloadControls(session);
  const isSeen = ({ galleryOpen }: State) => !galleryOpen;
  const progress = progressBar(store, isSeen);
  const controls = el('div', { class: 'row actions' }, generate, cancel);
  store.subscribe((state) => {
    const { running, model, mesh } = state;
    setText(status, state.status);
    status.classList.toggle('visually-hidden', running !== undefined);
    generate.disabled = !model || running?.task === 'mesh' || running?.task === 'open';
    show(generate, running?.task !== 'mesh');
    show(cancel, running !== undefined);
    show(saving, mesh !== undefined && running?.task !== 'mesh');
    const isFresh = mesh !== undefined && mesh.optionsKey === optionsKey(state.settings);
    saveButton.classList.toggle('primary', isFresh);
    generate.classList.toggle('primary', !isFresh);
  });
  return el('footer', { class: 'foot' }, messageBox(store, isSeen), progress, status, controls, saving);
}

function downloadControls(session: Session): { element: HTMLElement; saveButton: HTMLButtonElement } {
  const type = el(
    'select',
    { 'aria-label': 'File format' },
    ...outputFormats.map((value) => el('option', { value }, formatNames[value])),
  );
  const saveButton = button(icons.download(), { class: 'button icon-text' }, () => {
    void session.download(type.value as OutputFormat);
  });
  saveButton.append('Download');
  return { element: el('div', { class: 'row saving' }, type, saveButton), saveButton };
}

/** What happens while the gallery covers the footer: progress with a way to stop it, and messages. */
export function notice(store: Store, session: Session): HTMLElement {
  const isSeen = ({ galleryOpen }: State) => galleryOpen;
  const cancel = button('Cancel', { class: 'button' }, () => session.cancel());
  store.subscribe((state) => show(cancel, isSeen(state) && state.running !== undefined));
  return el('div', { class: 'notice' }, messageBox(store, isSeen), progressBar(store, isSeen), cancel);
}

/** Seen while something runs and `isSeen` holds. */
function progressBar(store: Store, isSeen: (state: State) => boolean): HTMLElement {
  const stage = el('span', { class: 'stage' });
  const time = el('span', { class: 'time' });
  const fill = el('div', { class: 'fill' });
  const bar = el('div', { class: 'bar', role: 'progressbar', 'aria-label': 'Progress', 'aria-valuemin': 0, 'aria-valuemax': 100 }, fill);
  const element = el('div', { class: 'progress', hidden: true }, el('div', { class: 'row' }, stage, time), bar);
  let clock: ReturnType<typeof setInterval> | undefined;
  const tick = ({ since }: Running) => setText(time, format.duration((performance.now() - since) / 1000));
  store.subscribe((state) => {
    const running = isSeen(state) ? state.running : undefined;
    show(element, running !== undefined);
    if (!running) {
      clearInterval(clock);
      clock = undefined;
      return;
    }
    clock ??= setInterval(() => {
      const { running: current } = store.state;
      if (current) {
        tick(current);
      }
    }, 100);
    tick(running);
    setText(stage, running.stage);
    fill.style.transform = `scaleX(${running.fraction.toFixed(4)})`;
    bar.setAttribute('aria-valuenow', String(Math.round(100 * running.fraction)));
  });
  return element;
}

function messageBox(store: Store, isSeen: (state: State) => boolean): HTMLElement {
  const title = el('strong', {});
  const text = el('p', {});
  const close = button(icons.close(), { class: 'quiet icon', 'aria-label': 'Close message' }, () => store.update({ message: undefined }));
  const content = el('div', { class: 'message' }, icons.warn(), el('div', {}, title, text), close);
  // The live region is always there, so that what is put into it is read out.
  const region = el('div', { role: 'alert' });
  store.subscribe((state, before) => {
    const message = isSeen(state) ? state.message : undefined;
    if (!message) {
      region.replaceChildren();
    } else if (message !== before.message || !region.hasChildNodes()) {
      setText(title, message.title);
      setText(text, message.text);
      region.replaceChildren(content);
    }
  });
  return region;
}
