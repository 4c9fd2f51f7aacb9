import type { FieldResult, InspectResult, MeshOptions, MeshResult, Mode } from 'qmcf';
import type { SizesFile } from './sizes_file.js';

/** What the viewport shows. */
export type View = 'part' | 'field' | 'mesh' | 'front';

/** A part that was opened and could be read. */
export interface Model {
  readonly name: string;
  readonly bytes: Uint8Array;
  /** Repaired, with the faces and edges at `featureAngle`. */
  readonly part: InspectResult;
  readonly featureAngle: number;
  /** Of all faces, in squared units of the model. */
  readonly area: number;
}

/** What the controls say. */
export interface Settings {
  /** Which of `size` and `quads` the user chose; the other one follows. Or neither, but the sizes of a file. */
  readonly sizedBy: 'size' | 'quads' | 'sizes';
  readonly size: number;
  readonly quads: number;
  /** The largest sizes at the vertices; never with a number of quads. */
  readonly sizes: SizesFile | undefined;
  /** Chord error in units of the model; undefined: whatever the size makes of it. */
  readonly curvature: number | undefined;
  /** Let sizes vary to fit the field, where they can; undefined: if a number of quads is all that is asked for. */
  readonly fitSizes: boolean | undefined;
  readonly featureAngle: number;
  readonly mode: Mode;
  /** No triangles. */
  readonly allQuad: boolean;
  readonly gradation: number;
  readonly alignBoundary: boolean;
  readonly alignSharp: boolean;
  readonly alignNonManifold: boolean;
  readonly alignCurvature: boolean;
}

/** A face or edge of the part, or an element of the mesh. */
export interface Target {
  readonly kind: 'face' | 'edge' | 'element';
  readonly id: number;
}

/** What the pointer is on, and where that is in the window, in CSS pixels. */
export interface Hover {
  readonly target: Target;
  readonly x: number;
  readonly y: number;
}

/** What is drawn besides the view itself. */
export interface Display {
  readonly crosses: boolean;
  /** Lines along the field instead of crosses. */
  readonly streamlines: boolean;
  /** What pins the field, by kind, and the pins that were taken back. */
  readonly constraints: boolean;
  readonly faceColors: boolean;
  readonly irregular: boolean;
  readonly quality: boolean;
}

/** A result and the options that made it. */
export interface Made<T> {
  readonly result: T;
  readonly optionsKey: string;
  readonly seconds: number;
}

/** A mesh, and the part with the faces and edges that it was made of: the feature angle may be another one by now. */
export interface MadeMesh extends Made<MeshResult> {
  readonly part: InspectResult;
}

/** Work that is under way. */
export interface Running {
  readonly task: 'open' | 'field' | 'mesh';
  readonly stage: string;
  /** Of the whole task, 0 to 1. */
  readonly fraction: number;
  /** performance.now() at the start. */
  readonly since: number;
}

/** Something to tell the user. */
export interface Message {
  readonly title: string;
  readonly text: string;
}

export interface State {
  readonly model: Model | undefined;
  readonly settings: Settings;
  /** Keep how the next mesh is made. */
  readonly record: boolean;
  readonly view: View;
  readonly display: Display;
  readonly field: Made<FieldResult> | undefined;
  readonly mesh: MadeMesh | undefined;
  readonly hover: Hover | undefined;
  /** What was clicked on or looked up. */
  readonly chosen: Target | undefined;
  readonly running: Running | undefined;
  readonly message: Message | undefined;
  /** One line on what happened last. */
  readonly status: string;
  readonly galleryOpen: boolean;
}

export const initialState: State = {
  model: undefined,
  settings: {
    sizedBy: 'quads',
    size: 0,
    quads: 3000,
    sizes: undefined,
    curvature: undefined,
    fitSizes: undefined,
    featureAngle: 30,
    mode: 'qmcf',
    allQuad: false,
    gradation: 0.25,
    alignBoundary: true,
    alignSharp: true,
    alignNonManifold: true,
    alignCurvature: true,
  },
  record: false,
  view: 'part',
  display: { crosses: false, streamlines: false, constraints: false, faceColors: true, irregular: false, quality: false },
  field: undefined,
  mesh: undefined,
  hover: undefined,
  chosen: undefined,
  running: undefined,
  message: undefined,
  status: 'Open a part to begin.',
  galleryOpen: true,
};

/** The part whose faces and edges are seen, looked up and told by their numbers. */
export function seenPart({ view, model, mesh }: Pick<State, 'view' | 'model' | 'mesh'>): InspectResult | undefined {
  return view === 'mesh' && mesh ? mesh.part : model?.part;
}

/** Whether sizes can fit the field: one mode has none, and the sizes of a file are what they are. */
export function canFit({ mode, sizedBy }: Settings): boolean {
  return mode === 'qmcf' && sizedBy !== 'sizes';
}

/** Whether sizes are to fit the field. */
export function fitsSizes(settings: Settings): boolean {
  return canFit(settings) && (settings.fitSizes ?? settings.sizedBy === 'quads');
}

/** The options for the core that follow from the controls. */
export function optionsOf(settings: Settings): MeshOptions {
  const { sizedBy, size, quads, sizes, ...others } = settings;
  const rest = { ...others, fitSizes: fitsSizes(settings) };
  if (sizedBy === 'quads') {
    return { ...rest, quads };
  }
  return { ...rest, ...(sizes && { sizes: sizes.values }), ...(sizedBy === 'size' && { size }) };
}

/** The same for the field, which is there in one mode only, and there before sizes can fit it and quads are made. */
export function fieldSettings(settings: Settings): Settings {
  return { ...settings, mode: 'qmcf', allQuad: false, fitSizes: false };
}

/** Equal for settings that give equal results. */
export function optionsKey(settings: Settings): string {
  return JSON.stringify({ ...optionsOf(settings), sizes: settings.sizes?.id });
}

/** The other of size and count follows from the area: a quad of size h covers h². */
export function linkSizes(settings: Settings, area: number): Settings {
  if (settings.sizedBy === 'sizes') {
    return settings;
  }
  return settings.sizedBy === 'size'
    ? { ...settings, quads: Math.max(1, Math.round(area / settings.size ** 2)) }
    : { ...settings, size: Math.sqrt(area / settings.quads) };
}

type Listener = (state: State, before: State) => void;

/** Holds the state; listeners hear of all changes of one turn of the event loop at once. */
export class Store {
  private current: State = initialState;
  private announced: State = initialState;
  private readonly listeners: Listener[] = [];
  private pending = false;

  get state(): State {
    return this.current;
  }

  update(change: Partial<State>): void {
    this.current = { ...this.current, ...change };
    if (!this.pending) {
      this.pending = true;
      queueMicrotask(() => this.announce());
    }
  }

  /** Calls the listener now and after every change. */
  subscribe(listener: Listener): void {
    this.listeners.push(listener);
    listener(this.current, this.current);
  }

  private announce(): void {
    this.pending = false;
    const before = this.announced;
    this.announced = this.current;
    for (const listener of this.listeners) {
      listener(this.announced, before);
    }
  }
}
