import type { MeshTrace, TraceKind, TraceStep } from 'qmcf';
import { button, el, show, uniqueId } from '../dom.js';
import * as format from '../format.js';
import { Playback } from '../replay.js';
import type { Store } from '../state.js';
import { icons } from './icons.js';
import { methodNames } from './target_info.js';

/** What a step is, for a person. */
const stepNames: Readonly<Record<TraceKind, string>> = {
  start: 'The front before its first quad',
  star: 'Pattern at a singularity',
  seed: 'First element',
  quad: 'Quad on a front edge',
  collision: 'Collision: the front meets itself',
  closure: 'Loop closed',
  seam: 'Seam: a wedge closed by merging',
  transition: 'Transition between sizes',
  leftover: 'What the front left over',
  paired: 'Fallback: triangles paired',
  strip: 'One row of elements',
  triangulated: 'Fallback: triangles as they are',
  cleanup: 'Clean-up begins',
  smooth: 'Clean-up: relaxed',
  doublet: 'Clean-up: doublet removed',
  pair: 'Clean-up: triangles paired',
  collapse: 'Clean-up: quad collapsed',
  refill: 'Clean-up: few elements replaced',
  cavity: 'Clean-up: cavity filled anew',
  untangle: 'Clean-up: untangled',
  subdivision: 'Every element cut up',
};

/** Steps that are more than one more quad: where one would like to look. */
const events: ReadonlySet<TraceKind> = new Set([
  'start', 'star', 'seed', 'closure', 'seam', 'transition', 'leftover', 'paired', 'strip', 'triangulated', 'cleanup', 'collapse', 'refill', 'cavity', 'subdivision',
] as const);

const stateNames = ['both sides there', 'one side missing', 'both missing', 'seam'] as const;

const speeds: readonly (readonly [number, string])[] = [
  [4, '4 a second'],
  [20, '20 a second'],
  [60, '60 a second'],
  [300, '300 a second'],
];

/** Plays the history of the mesh; `draw` shows where it is. */
export function frontPlayer(store: Store, draw: (playback: Playback | undefined) => void): HTMLElement {
  let playback: Playback | undefined;
  let timer: number | undefined;
  let before = 0;
  let due = 0;

  const play = button(icons.play(), { class: 'play', 'aria-label': 'Play' }, () => (timer === undefined ? start() : pause()));
  const step = (label: string, icon: SVGElement, by: 1 | -1, toEvent: boolean) =>
    button(icon, { 'aria-label': label, title: label }, () => {
      pause();
      go(toEvent ? (playback?.find(events, by) ?? (playback?.position ?? 0)) : (playback?.position ?? 0) + by);
    });
  const slider = el('input', { type: 'range', min: 0, value: 0, step: 1, 'aria-label': 'Step' });
  slider.addEventListener('input', () => {
    pause();
    go(slider.valueAsNumber);
  });
  const place = el('span', { class: 'place' });
  const what = el('p', { class: 'what' });
  const count = el('span', { class: 'grown' });
  const [faceId, speedId] = [uniqueId(), uniqueId()];
  const face = el('select', { id: faceId });
  face.addEventListener('change', () => choose(face.value === '' ? undefined : Number(face.value)));
  const speed = el('select', { id: speedId }, ...speeds.map(([value, label]) => el('option', { value, selected: value === 20 }, label)));
  const states = stateNames.map((name, i) => el('li', {}, el('i', { class: `swatch line front-${i}`, 'aria-hidden': 'true' }), name));
  const element = el(
    'section',
    { class: 'player', 'aria-label': 'Front player' },
    el('div', { class: 'said' }, what, count),
    el(
      'div',
      { class: 'transport' },
      step('Previous event', icons.previousEvent(), -1, true),
      step('One step back', icons.stepBack(), -1, false),
      play,
      step('One step forward', icons.stepForward(), 1, false),
      step('Next event', icons.nextEvent(), 1, true),
      slider,
      place,
    ),
    el(
      'div',
      { class: 'choices' },
      el('label', { for: faceId }, 'Face'),
      face,
      el('label', { for: speedId }, 'Steps'),
      speed,
      el('ul', { class: 'legend', 'aria-label': 'Front edges' }, ...states),
    ),
  );

  function choose(which: number | undefined): void {
    pause();
    const trace = store.state.mesh?.result.trace;
    playback = trace && new Playback(trace, which);
    slider.max = String(Math.max(0, (playback?.length ?? 1) - 1));
    if (playback) {
      go(0);
    } else {
      draw(undefined);
    }
  }

  function go(position: number): void {
    if (!playback) {
      return;
    }
    playback.seek(position);
    const { current, face: present, length, elementCount } = playback;
    slider.value = String(playback.position);
    slider.style.setProperty('--at', String(playback.position / Math.max(1, length - 1)));
    place.textContent = `${format.count(playback.position + 1)} / ${format.count(length)}`;
    slider.setAttribute('aria-valuetext', current.last ? stepNames[current.last.kind] : '');
    what.replaceChildren(...describe(current.last, present && faceLabel(store, present.face)));
    element.dataset['kind'] = current.last?.kind ?? '';
    count.textContent = format.counted(elementCount, 'element');
    draw(playback);
  }

  function start(): void {
    if (!playback) {
      return;
    }
    if (playback.position === playback.length - 1) {
      go(0);
    }
    play.replaceChildren(icons.pause());
    play.setAttribute('aria-label', 'Pause');
    [before, due] = [performance.now(), 0];
    timer = requestAnimationFrame(tick);
  }

  function pause(): void {
    if (timer !== undefined) {
      cancelAnimationFrame(timer);
      timer = undefined;
      play.replaceChildren(icons.play());
      play.setAttribute('aria-label', 'Play');
    }
  }

  function tick(now: number): void {
    timer = requestAnimationFrame(tick);
    // A page that was in the background does not make up for it.
    due += (Math.min(250, now - before) / 1000) * Number(speed.value);
    before = now;
    const steps = Math.floor(due);
    if (playback && steps > 0) {
      due -= steps;
      go(playback.position + steps);
      if (playback.position === playback.length - 1) {
        pause();
      }
    }
  }

  let shown: MeshTrace | undefined;
  store.subscribe(({ mesh, view }) => {
    const trace = mesh?.result.trace;
    if (trace !== shown) {
      shown = trace;
      const faces = trace?.faces.filter(({ steps }) => steps.length > 0) ?? [];
      const options = faces.map(({ face: id, method }) =>
        el('option', { value: id }, `${faceLabel(store, id)}${method === 'qmcf' || method === 'qmorph' ? '' : ` (${methodNames[method]})`}`),
      );
      face.replaceChildren(el('option', { value: '' }, 'All, one after the other'), ...options);
      choose(undefined);
    }
    show(element, view === 'front' && trace !== undefined);
    if (view !== 'front') {
      pause();
    }
  });
  return element;
}

function faceLabel(store: Store, face: number): string {
  return store.state.mesh?.result.faceNames[face] ?? `face ${face}`;
}

function describe(step: TraceStep | undefined, face: string | undefined): Node[] {
  if (!step) {
    return [];
  }
  const notes = [
    ...(face ? [face] : []),
    ...(step.undone ? [`${format.counted(step.undone, 'attempt')} rolled back`] : []),
    ...(step.failed ? [`${format.counted(step.failed.length / 2, 'edge')} put off`] : []),
    ...(step.pass ? [`desperate: ${step.pass}`] : []),
  ];
  return [el('strong', {}, stepNames[step.kind]), el('span', {}, notes.join(' · '))];
}
