import { DirectionalLight, HemisphereLight, MathUtils, PerspectiveCamera, Scene, Vector2, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { FieldResult, InspectResult, MeshResult } from 'qmcf';
import type { Playback } from '../replay.js';
import type { Target } from '../state.js';
import { FieldLayer, type FieldLook } from './field_layer.js';
import { Frame } from './frame.js';
import { FrontLayer } from './front_layer.js';
import { HighlightLayer, placeOf } from './highlight_layer.js';
import { Inspector } from './inspector.js';
import { MeshLayer, type MeshLook } from './mesh_layer.js';
import { darkPalette, lightPalette, type Palette } from './palette.js';
import { PartLayer, type PartLook } from './part_layer.js';

/** The part of the canvas that nothing covers, in CSS pixels. */
export interface FreeArea {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
}

/** What is drawn, and how. */
export interface Look {
  readonly part: PartLook | undefined;
  readonly field: FieldLook | undefined;
  readonly mesh: MeshLook | undefined;
  readonly front: boolean;
}

const fieldOfView = 26;
const tangent = Math.tan(MathUtils.degToRad(fieldOfView / 2));
const viewDirection = new Vector3(0.62, -0.9, 0.55).normalize();

/** The three-dimensional view. Draws only when something changed. */
export class Viewer {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(fieldOfView);
  private readonly controls: OrbitControls;
  private readonly partLayer = new PartLayer();
  private readonly fieldLayer = new FieldLayer();
  private readonly meshLayer = new MeshLayer();
  private readonly frontLayer = new FrontLayer();
  private readonly highlight = new HighlightLayer();
  private readonly inspector = new Inspector();
  private target: Target | undefined;
  private readonly sky = new HemisphereLight();
  private frame: Frame | undefined;
  /** Of the part's vertices, in the scene. */
  private positions = new Float32Array();
  private palette: Palette = lightPalette;
  private free: FreeArea = { left: 0, top: 0, width: 1, height: 1 };
  private shown: { part?: InspectResult; field?: FieldResult; mesh?: MeshResult; playback?: Playback } = {};
  private scheduled = false;

  constructor(private readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    // Asking for the log of a shader waits until it is compiled and everything before it is drawn.
    this.renderer.debug.checkShaderErrors = false;
    this.scene.add(this.partLayer, this.fieldLayer, this.meshLayer, this.frontLayer, this.highlight, this.camera, this.sky);
    this.addCameraLights();
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = !window.matchMedia('(prefers-reduced-motion: reduce)').matches;
    this.controls.dampingFactor = 0.12;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => this.invalidate());
    canvas.addEventListener('webglcontextrestored', () => this.invalidate());
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.watchPixelRatio();
    const dark = window.matchMedia('(prefers-color-scheme: dark)');
    dark.addEventListener('change', () => this.setPalette(dark.matches));
    this.setPalette(dark.matches);
  }

  /** Shows a part; the camera moves only when it is another one. */
  setPart(part: InspectResult, isNew: boolean): void {
    this.shown.part = part;
    if (isNew || !this.frame) {
      this.frame = Frame.around(part.positions);
      this.positions = this.frame.place(part.positions);
      delete this.shown.field;
      delete this.shown.mesh;
      this.fieldLayer.hide();
      this.meshLayer.clear();
      this.inspector.setMesh(undefined, this.positions);
      this.fit();
    }
    this.inspector.setPart(part, this.positions);
    this.partLayer.show(part, this.frame, this.palette);
    this.invalidate();
  }

  setField(field: FieldResult | undefined): void {
    this.fieldLayer.hide();
    delete this.shown.field;
    if (field && this.frame) {
      this.shown.field = field;
      this.fieldLayer.show(field, this.frame, this.palette);
    }
    this.invalidate();
  }

  setMesh(mesh: MeshResult | undefined): void {
    this.meshLayer.clear();
    delete this.shown.mesh;
    if (mesh && this.frame) {
      this.shown.mesh = mesh;
      this.meshLayer.show(mesh, this.frame, this.palette);
      this.inspector.setMesh(mesh, this.frame.place(mesh.positions));
    }
    this.invalidate();
  }

  /** Shows where the history of the mesh is played, or nothing of it. */
  setFront(playback: Playback | undefined): void {
    if (playback !== this.shown.playback) {
      this.frontLayer.hide();
    }
    delete this.shown.playback;
    if (playback && this.frame) {
      this.shown.playback = playback;
      this.frontLayer.show(playback, this.frame, this.palette);
    }
    this.invalidate();
  }

  setLook(look: Look): void {
    this.frontLayer.visible = look.front;
    this.partLayer.visible = look.part !== undefined;
    this.fieldLayer.visible = look.field !== undefined;
    this.meshLayer.visible = look.mesh !== undefined;
    if (look.part) {
      this.partLayer.setLook(look.part);
    }
    if (look.field) {
      this.fieldLayer.setLook(look.field);
    }
    if (look.mesh) {
      this.meshLayer.setLook(look.mesh);
    }
    this.invalidate();
  }

  /** What is drawn at a place of the window, in CSS pixels. */
  pick(clientX: number, clientY: number): Target | undefined {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    return this.inspector.pick(this.camera, this.meshLayer.visible, clientX - left, clientY - top, width, height);
  }

  /** Marks a face, edge or element of what is seen; nothing when there is no such thing. */
  mark(target: Target | undefined): void {
    this.target = target;
    this.highlight.show(target && this.inspector.outlineOf(target, this.meshLayer.visible), this.palette);
    this.invalidate();
  }

  /** Moves the camera so that the target is seen from its front, with some of what is around it. */
  zoomTo(target: Target): void {
    const outline = this.inspector.outlineOf(target, this.meshLayer.visible);
    if (!outline) {
      return;
    }
    const { sphere, normal } = placeOf(outline);
    const before = this.camera.position.clone().sub(this.controls.target).normalize();
    const around = target.kind === 'element' ? 7 : 1.6;
    const room = Math.min(this.free.width, this.free.height) / (2 * around * Math.max(sphere.radius, 1e-4));
    const wanted = (this.canvas.clientHeight || 1) / (2 * tangent * room);
    const { direction, distance } =
      target.kind === 'element'
        ? this.inspector.lookout(sphere, normal, before, wanted)
        : { direction: normal.addScaledVector(before, 0.6).normalize(), distance: wanted };
    this.controls.target.copy(sphere.center);
    this.camera.position.copy(sphere.center).addScaledVector(direction, distance);
    this.controls.update();
    this.invalidate();
  }

  /** Keeps the model in the middle of what the page leaves free. */
  setFreeArea(free: FreeArea): void {
    this.free = free;
    this.resize();
  }

  /** Turns and moves the camera so that the whole part is seen. */
  fit(): void {
    if (this.positions.length === 0) {
      return;
    }
    const height = this.canvas.clientHeight || 1;
    const right = new Vector3().crossVectors(viewDirection, this.camera.up).normalize();
    const up = new Vector3().crossVectors(right, viewDirection);
    // What counts is the part as it is seen: a sphere around it would waste space on flat and long parts.
    const [across, upwards, depth] = [right, up, viewDirection].map((axis) => extent(this.positions, axis));
    const room = 0.9 * Math.min(this.free.width / across!.length, this.free.height / upwards!.length);
    const distance = height / (2 * tangent * room) + 0.4 * depth!.length;
    this.controls.target
      .copy(right)
      .multiplyScalar(across!.middle)
      .addScaledVector(up, upwards!.middle)
      .addScaledVector(viewDirection, depth!.middle);
    this.camera.position.copy(this.controls.target).addScaledVector(viewDirection, distance);
    this.controls.minDistance = 0.002;
    this.controls.maxDistance = 6 * distance;
    this.controls.update();
    this.invalidate();
  }

  /** Draws before the next repaint. */
  invalidate(): void {
    if (!this.scheduled) {
      this.scheduled = true;
      requestAnimationFrame(() => this.draw());
    }
  }

  private draw(): void {
    this.scheduled = false;
    // Damping goes on after the pointer was released; update() then asks for the next frame by its change event.
    this.controls.update();
    const distance = this.camera.position.length();
    this.camera.near = Math.max(distance - 1.5, 0.005 * distance);
    this.camera.far = distance + 1.5;
    this.camera.updateProjectionMatrix();
    const toTarget = this.camera.position.distanceTo(this.controls.target);
    this.fieldLayer.setZoom(this.canvas.clientHeight / (2 * tangent * toTarget));
    this.renderer.render(this.scene, this.camera);
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) {
      return;
    }
    const isResized = this.setBufferSize(width, height);
    this.camera.aspect = width / height;
    const { left, top } = this.free;
    const offsetX = Math.round(width / 2 - (left + this.free.width / 2));
    const offsetY = Math.round(height / 2 - (top + this.free.height / 2));
    this.camera.setViewOffset(width, height, offsetX, offsetY, width, height);
    if (isResized) {
      // Another size empties the canvas, and this frame's turn to draw may be over.
      this.draw();
    } else {
      this.invalidate();
    }
  }

  /** Whether that changed it. */
  private setBufferSize(width: number, height: number): boolean {
    const ratio = Math.min(2, window.devicePixelRatio);
    const isSame = this.renderer.getSize(new Vector2()).equals(new Vector2(width, height));
    if (isSame && this.renderer.getPixelRatio() === ratio) {
      return false;
    }
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    return true;
  }

  /** The ratio changes when the page is zoomed or moved to another screen. */
  private watchPixelRatio(): void {
    const current = window.matchMedia(`(resolution: ${window.devicePixelRatio}dppx)`);
    const changed = () => {
      this.resize();
      this.watchPixelRatio();
    };
    current.addEventListener('change', changed, { once: true });
  }

  private setPalette(dark: boolean): void {
    this.palette = dark ? darkPalette : lightPalette;
    this.sky.color = this.palette.skyLight;
    this.sky.groundColor = this.palette.groundLight;
    this.sky.intensity = 1.9;
    const { part, field, mesh, playback } = this.shown;
    if (part) {
      this.setPart(part, false);
      this.setField(field);
      this.setMesh(mesh);
      this.frontLayer.hide();
      this.setFront(playback);
      this.mark(this.target);
    }
    this.invalidate();
  }

  /** The light comes over the viewer's left shoulder, wherever the camera is. */
  private addCameraLights(): void {
    const key = new DirectionalLight('#fffaf2', 1.9);
    key.position.set(-1.2, 1.6, 2.2);
    const rim = new DirectionalLight('#e8f1ff', 0.7);
    rim.position.set(2, -0.5, 1);
    for (const light of [key, rim]) {
      this.camera.add(light, light.target);
    }
  }
}

/** The span of the positions along an axis. */
function extent(positions: Float32Array, axis: Vector3): { length: number; middle: number } {
  let [low, high] = [Infinity, -Infinity];
  for (let i = 0; i < positions.length; i += 3) {
    const along = axis.x * positions[i]! + axis.y * positions[i + 1]! + axis.z * positions[i + 2]!;
    low = Math.min(low, along);
    high = Math.max(high, along);
  }
  return { length: Math.max(high - low, 1e-3), middle: (low + high) / 2 };
}
