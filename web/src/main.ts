import { button, el } from './dom.js';
import { Session } from './session.js';
import { Store, type State, type Target } from './state.js';
import { displayCard } from './ui/display_card.js';
import { dropZone } from './ui/drop.js';
import { footer } from './ui/footer.js';
import { frontPlayer } from './ui/front_player.js';
import { gallery } from './ui/gallery.js';
import { icons, mark } from './ui/icons.js';
import { modelSection, openControl } from './ui/model_section.js';
import { optionsSection } from './ui/options_section.js';
import { resultSection } from './ui/result_section.js';
import { hoverTip, selectionCard } from './ui/selection.js';
import { makeSheet } from './ui/sheet.js';
import { sizeSection } from './ui/size_section.js';
import { viewBar } from './ui/view_bar.js';
import { isSame, watchPointer } from './viewer/pointing.js';
import { Viewer } from './viewer/viewer.js';

const store = new Store();
const session = new Session(store);

const canvas = el('canvas', { class: 'viewport', 'aria-label': 'Three-dimensional view', tabindex: -1 });
const open = openControl(session);
const panel = el(
  'aside',
  { class: 'panel', 'aria-label': 'Mesher' },
  el('header', { class: 'brand' }, mark(), el('strong', {}, 'QMCF'), el('span', {}, 'quads that follow the part')),
  el(
    'div',
    { class: 'body' },
    modelSection(store, open),
    sizeSection(store, session),
    optionsSection(store, session),
    resultSection(store, goToMade),
  ),
  footer(store, session),
);
const closeSheet = makeSheet(panel);
const fit = button(icons.fit(), { class: 'fit', 'aria-label': 'Fit the view', title: 'Fit the view' }, () => viewer?.fit());
const views = viewBar(store, session);
const app = document.querySelector('#app')!;
const display = displayCard(store, session);
const selection = selectionCard(store, goTo);
const player = frontPlayer(store, (playback) => viewer?.setFront(playback));
app.append(canvas, panel, views, display, selection, player, fit, gallery(store, session, open), hoverTip(store), dropZone(session));

const viewer = createViewer();

/** The page is of use without a picture, too: a mesh can still be made and saved. */
function createViewer(): Viewer | undefined {
  try {
    return new Viewer(canvas);
  } catch (error) {
    const text = error instanceof Error ? error.message : String(error);
    store.update({ message: { title: 'This browser can not draw in three dimensions', text } });
    return undefined;
  }
}

/** The viewport without the panel, which covers its left side or, on a small screen, its lower part. */
function measureFreeArea(): void {
  const { clientWidth: width, clientHeight: height } = canvas;
  const covered = panel.getBoundingClientRect();
  const isSheet = covered.width > 0.9 * width;
  // On a small screen the switches are below the view bar, else in a corner.
  const bar = (isSheet ? display.firstElementChild! : views).getBoundingClientRect().bottom;
  const left = isSheet ? 0 : covered.right;
  const bottom = isSheet ? covered.top : height;
  for (const card of [selection, player]) {
    card.style.setProperty('--left', `${left}px`);
    card.style.setProperty('--bottom', `${height - bottom}px`);
  }
  const end = player.hidden ? bottom : player.getBoundingClientRect().top;
  viewer?.setFreeArea({ left, top: bar, width: Math.max(80, width - left), height: Math.max(80, end - bar) });
}

/** Measures it again whenever something that covers the viewport changes. */
function trackFreeArea(): void {
  const observer = new ResizeObserver(measureFreeArea);
  observer.observe(panel);
  observer.observe(canvas);
  observer.observe(display);
  observer.observe(player);
}

function draw(state: State, before: State): void {
  const { model, field, mesh, view, display } = state;
  const isNew = model?.bytes !== before.model?.bytes;
  if (model && model !== before.model) {
    viewer?.setPart(model.part, isNew);
  }
  if (field !== before.field || isNew) {
    viewer?.setField(field?.result);
  }
  if (mesh !== before.mesh || isNew) {
    viewer?.setMesh(mesh?.result);
  }
  if (view !== before.view || display !== before.display) {
    viewer?.setLook({
      part: view === 'mesh' ? undefined : { faceColors: display.faceColors, ground: display.crosses || view === 'front' },
      field: display.crosses ? display : undefined,
      mesh: view === 'mesh' ? display : undefined,
      front: view === 'front',
    });
  }
  markTarget(state, before);
}

/** Marks what the pointer is on, else what was chosen. A face that is the whole part is marked only when it was chosen. */
function markTarget(state: State, before: State): void {
  const wanted = ({ hover, chosen, model }: State) => {
    const isWhole = hover?.target.kind === 'face' && model?.part.faceNames.length === 1;
    return isWhole ? chosen : (hover?.target ?? chosen);
  };
  const target = wanted(state);
  const isOld = (['model', 'mesh', 'view'] as const).every((key) => state[key] === before[key]);
  if (!isOld || !isSame(target, wanted(before))) {
    viewer?.mark(target);
  }
}

/** Chooses something and moves the camera there. */
function goTo(target: Target): void {
  closeSheet();
  store.update({ chosen: target });
  // Once it is drawn: the listeners are called in a microtask that is queued already.
  queueMicrotask(() => {
    measureFreeArea();
    viewer?.zoomTo(target);
  });
}

/** The same for something of the mesh, in a view that knows it by this number. */
function goToMade(target: Target): void {
  const { mesh, model } = store.state;
  if (target.kind === 'element' || mesh?.part !== model?.part) {
    session.setView('mesh');
  }
  goTo(target);
}

trackFreeArea();
store.subscribe(draw);
if (viewer) {
  watchPointer(canvas, viewer, store, goTo);
}
