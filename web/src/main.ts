import { button, el } from './dom.js';
import { Session } from './session.js';
import { Store, type State } from './state.js';
import { displayCard } from './ui/display_card.js';
import { dropZone } from './ui/drop.js';
import { footer } from './ui/footer.js';
import { gallery } from './ui/gallery.js';
import { icons, mark } from './ui/icons.js';
import { modelSection } from './ui/model_section.js';
import { optionsSection } from './ui/options_section.js';
import { resultSection } from './ui/result_section.js';
import { makeSheet } from './ui/sheet.js';
import { sizeSection } from './ui/size_section.js';
import { viewBar } from './ui/view_bar.js';
import { Viewer } from './viewer/viewer.js';

const store = new Store();
const session = new Session(store);

const canvas = el('canvas', { class: 'viewport', 'aria-label': 'Three-dimensional view', tabindex: -1 });
const panel = el(
  'aside',
  { class: 'panel', 'aria-label': 'Mesher' },
  el('header', { class: 'brand' }, mark(), el('strong', {}, 'QMCF'), el('span', {}, 'quads that follow the part')),
  el(
    'div',
    { class: 'body' },
    modelSection(store, session),
    sizeSection(store, session),
    optionsSection(store, session),
    resultSection(store),
  ),
  footer(store, session),
);
makeSheet(panel);
const fit = button(icons.fit(), { class: 'fit', 'aria-label': 'Fit the view', title: 'Fit the view' }, () => viewer.fit());
const views = viewBar(store, session);
const pickFile = () => panel.querySelector<HTMLInputElement>('input[type=file]')!.click();
const app = document.querySelector('#app')!;
const display = displayCard(store, session);
app.append(canvas, panel, views, display, fit, gallery(store, session, pickFile), dropZone(session));

const viewer = new Viewer(canvas);

/** The viewport without the panel, which covers its left side or, on a small screen, its lower part. */
function trackFreeArea(): void {
  const measure = () => {
    const { clientWidth: width, clientHeight: height } = canvas;
    const covered = panel.getBoundingClientRect();
    const isSheet = covered.width > 0.9 * width;
    // On a small screen the switches are below the view bar, else in a corner.
    const bar = (isSheet ? display.firstElementChild! : views).getBoundingClientRect().bottom;
    const left = isSheet ? 0 : covered.right;
    const bottom = isSheet ? covered.top : height;
    viewer.setFreeArea({ left, top: bar, width: Math.max(80, width - left), height: Math.max(80, bottom - bar) });
  };
  const observer = new ResizeObserver(measure);
  observer.observe(panel);
  observer.observe(canvas);
  observer.observe(display);
}

function draw(state: State, before: State): void {
  const { model, field, mesh, view, display } = state;
  if (model && model !== before.model) {
    viewer.setPart(model.part, model.bytes !== before.model?.bytes);
  }
  if (field !== before.field || model?.bytes !== before.model?.bytes) {
    viewer.setField(field?.result);
  }
  if (mesh !== before.mesh || model?.bytes !== before.model?.bytes) {
    viewer.setMesh(mesh?.result);
  }
  viewer.setLook({
    part: view === 'mesh' ? undefined : { faceColors: display.faceColors, ground: display.crosses },
    field: display.crosses,
    mesh: view === 'mesh' ? display : undefined,
  });
}

trackFreeArea();
store.subscribe(draw);
