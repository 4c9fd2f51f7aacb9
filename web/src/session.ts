import { createMesher, type Mesher, type OutputFormat, type ProgressReport } from 'qmcf';
import * as format from './format.js';
import { parseSizes } from './sizes_file.js';
import type { Sample } from './samples.js';
import { stageLabel, TaskProgress } from './stages.js';
import {
  fieldSettings,
  initialState,
  linkSizes,
  optionsKey,
  optionsOf,
  seenPart,
  type Model,
  type Running,
  type Settings,
  type State,
  type Store,
  type View,
} from './state.js';

/** How a run of the core is watched and stopped. */
interface Control {
  readonly signal: AbortSignal;
  readonly onProgress: (progress: ProgressReport) => void;
}

/** Everything that is done with the core: opens parts, computes fields and meshes, one at a time. */
export class Session {
  private readonly mesher: Promise<Mesher> = createMesher();
  private abort: AbortController | undefined;
  private upkeep: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly store: Store) {
    this.mesher.catch((error: unknown) => this.fail('The mesher could not be started', error));
    store.subscribe((state, before) => {
      if (state !== before && needsUpkeep(state)) {
        this.scheduleUpkeep();
      }
    });
  }

  async openFile(file: File): Promise<void> {
    await this.open(file.name, () => file.arrayBuffer());
  }

  async openSample(sample: Sample): Promise<void> {
    await this.open(sample.file, async (signal) => {
      const response = await fetch(sample.url, { signal });
      if (!response.ok) {
        throw new Error(`The sample could not be loaded (status ${response.status}).`);
      }
      return response.arrayBuffer();
    });
  }

  /** Changes what the controls say; size and count stay linked. */
  changeSettings(change: Partial<Settings>): void {
    const { settings, model } = this.store.state;
    const changed = { ...settings, ...change };
    this.store.update({ settings: model ? linkSizes(changed, model.area) : changed });
  }

  /** Takes the sizes at the part's vertices from a file, in place of size and count. */
  async openSizes(file: File): Promise<void> {
    try {
      const sizes = parseSizes(file.name, await file.text());
      this.changeSettings({ sizedBy: 'sizes', sizes });
      const count = format.counted(sizes.values.length, 'size');
      this.store.update({ message: undefined, status: `${file.name} holds ${count}.` });
    } catch (error) {
      this.fail(`${file.name} can't be used`, error);
    }
  }

  clearSizes(): void {
    const { sizedBy } = this.store.state.settings;
    this.changeSettings({ sizes: undefined, sizedBy: sizedBy === 'sizes' ? 'quads' : sizedBy });
  }

  async generate(): Promise<void> {
    const { model, settings, record } = this.store.state;
    if (!model) {
      return;
    }
    await this.run('mesh', 'Generating the mesh', async (mesher, control) => {
      const start = performance.now();
      const found = await withFeatures(model, settings.featureAngle, mesher, control);
      const result = await mesher.mesh(model.bytes, { ...optionsOf(settings), trace: record }, control);
      const seconds = (performance.now() - start) / 1000;
      const { quads, triangles } = result.report.quality;
      const parts = [format.counted(quads, 'quad'), ...(triangles > 0 ? [format.counted(triangles, 'triangle')] : [])];
      this.store.update({
        model: found,
        mesh: { result, optionsKey: optionsKey(settings), seconds, part: found.part },
        view: record ? 'front' : 'mesh',
        hover: undefined,
        chosen: undefined,
        status: `${parts.join(' and ')} in ${format.duration(seconds)}.`,
      });
    });
  }

  cancel(): void {
    this.abort?.abort();
  }

  async download(type: OutputFormat): Promise<void> {
    const { mesh, model } = this.store.state;
    if (!mesh || !model) {
      return;
    }
    try {
      const content = await mesh.result.file(type);
      save(new Blob([content]), `${model.name.replace(/\.[^.]*$/, '')}-quads.${type}`);
      this.store.update({ status: `Saved as ${type.toUpperCase()}, ${format.count(content.length / 1024)} KB.` });
    } catch (error) {
      this.fail('The file could not be written', error);
    }
  }

  private async open(name: string, load: (signal: AbortSignal) => Promise<ArrayBuffer>): Promise<void> {
    await this.run('open', `${name} can't be used`, async (mesher, control) => {
      const { quads: quadsBefore } = this.store.state.settings;
      const bytes = new Uint8Array(await load(control.signal));
      const { featureAngle } = this.store.state.settings;
      const part = await mesher.inspect(bytes, { featureAngle }, control);
      const area = part.report.faces.reduce((sum, face) => sum + face.area, 0);
      const { settings } = this.store.state;
      // Lengths in units of another part mean nothing here; a count that was typed in the meantime is meant for this one.
      const isMeant = settings.sizedBy === 'quads' && settings.quads !== quadsBefore;
      const quads = isMeant ? settings.quads : initialState.settings.quads;
      const fresh = { sizedBy: 'quads', quads, sizes: undefined, curvature: undefined } as const;
      this.store.update({
        model: { name, bytes, part, area, featureAngle },
        settings: linkSizes({ ...settings, ...fresh }, area),
        field: undefined,
        mesh: undefined,
        hover: undefined,
        chosen: undefined,
        view: 'part',
        display: { ...this.store.state.display, crosses: false },
        galleryOpen: false,
        status: `${name} is open.`,
      });
    });
  }

  /** Shows the part, its field, its mesh or how that was made. */
  setView(view: View): void {
    const { state } = this.store;
    const { display, chosen } = state;
    // Elements are seen in the mesh only; faces and edges everywhere, by the same number where it is the same part.
    const stays = chosen?.kind === 'element' ? view === 'mesh' : seenPart(state) === seenPart({ ...state, view });
    this.store.update({
      view,
      display: { ...display, crosses: view === 'field' },
      hover: undefined,
      chosen: stays ? chosen : undefined,
    });
  }

  /** Lays the crosses over what is seen. */
  setCrosses(crosses: boolean): void {
    const { display, view } = this.store.state;
    const seen = crosses && view === 'part' ? 'field' : !crosses && view === 'field' ? 'part' : view;
    this.store.update({ view: seen, display: { ...display, crosses } });
  }

  /** Does what the state asks for but does not have: features at another angle, the field that shall be seen. */
  private scheduleUpkeep(): void {
    clearTimeout(this.upkeep);
    this.upkeep = setTimeout(() => void this.keepUp(), 250);
  }

  private async keepUp(): Promise<void> {
    const { state } = this.store;
    const { model, settings, running } = state;
    if (!model || running || !needsUpkeep(state)) {
      return;
    }
    if (model.featureAngle !== settings.featureAngle) {
      await this.run('open', 'The edges could not be found', async (mesher, control) => {
        const found = await withFeatures(model, settings.featureAngle, mesher, control);
        const { view, hover, chosen } = this.store.state;
        // The mesh that is seen keeps the part that it was made of.
        const stays = view === 'mesh';
        this.store.update({
          model: found,
          hover: stays ? hover : undefined,
          chosen: stays ? chosen : undefined,
          status: 'Edges found again.',
        });
      });
      return;
    }
    // A field that only follows the size of the mesh just made says nothing: the mesh is what was asked for.
    const said = state.view === 'mesh' && state.field ? state.status : undefined;
    await this.run('field', 'The cross field could not be computed', async (mesher, control) => {
      const start = performance.now();
      const result = await mesher.field(model.bytes, optionsOf(fieldSettings(settings)), control);
      const seconds = (performance.now() - start) / 1000;
      const singular = format.counted(result.singularities.indices.length, 'singularity', 'singularities');
      this.store.update({
        field: { result, optionsKey: optionsKey(fieldSettings(settings)), seconds },
        status: said ?? `Cross field with ${singular} in ${format.duration(seconds)}.`,
      });
    });
  }

  /** Runs one task; what ran before is cancelled. The last good results stay when it fails. */
  private async run(
    task: Running['task'],
    failure: string,
    work: (mesher: Mesher, control: Control) => Promise<void>,
  ): Promise<void> {
    this.abort?.abort();
    const abort = new AbortController();
    this.abort = abort;
    const since = performance.now();
    const overall = new TaskProgress(task);
    const show = (stage: string, fraction: number) =>
      this.store.update({ running: { task, stage, fraction, since }, status: `${stage}…` });
    show(task === 'open' ? 'Opening' : 'Starting', 0);
    this.store.update({ message: undefined });
    try {
      await work(await this.mesher, {
        signal: abort.signal,
        onProgress: (progress) => {
          if (this.abort === abort && !abort.signal.aborted) {
            show(stageLabel(progress.stage), overall.follow(progress));
          }
        },
      });
    } catch (error) {
      this.settle(task, failure, abort.signal.aborted ? undefined : error, this.abort === abort);
    } finally {
      if (this.abort === abort) {
        this.abort = undefined;
        this.store.update({ running: undefined });
      }
    }
  }

  /** What follows from a run that came to nothing: it failed with an error, or was cancelled if there is none. */
  private settle(task: Running['task'], failure: string, error: unknown, isLatest: boolean): void {
    if (!isLatest) {
      return;
    }
    // What can't be had is no longer asked for, or it would be tried again at once.
    const { state } = this.store;
    if (task === 'field') {
      this.store.update(withoutField(state));
    } else if (task === 'open' && state.model) {
      this.changeSettings({ featureAngle: state.model.featureAngle });
    }
    if (error === undefined) {
      this.store.update({ status: 'Cancelled.' });
    } else {
      this.fail(failure, error);
    }
  }

  private fail(title: string, error: unknown): void {
    const text = error instanceof Error ? error.message : String(error);
    this.store.update({ message: { title, text }, status: `${title}.` });
  }
}

function needsUpkeep({ model, settings, field, display, running }: State): boolean {
  if (!model || running) {
    return false;
  }
  const featuresOld = model.featureAngle !== settings.featureAngle;
  const fieldOld = display.crosses && field?.optionsKey !== optionsKey(fieldSettings(settings));
  return featuresOld || fieldOld;
}

/** The model with its faces and edges at this angle. */
async function withFeatures(model: Model, featureAngle: number, mesher: Mesher, control: Control): Promise<Model> {
  return model.featureAngle === featureAngle
    ? model
    : { ...model, part: await mesher.inspect(model.bytes, { featureAngle }, control), featureAngle };
}

function withoutField(state: State): Partial<State> {
  return {
    display: { ...state.display, crosses: false },
    view: state.view === 'field' ? 'part' : state.view,
  };
}

function save(content: Blob, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
