import { detachedError, isDetached } from './detached.js';
import { cancelledError, QmcfError } from './errors.js';
import { Line, type Platform, type Run } from './line.js';
import type { Input, Task } from './protocol.js';
import type {
  FieldResult,
  InspectResult,
  MeshArrays,
  MeshOptions,
  MeshResult,
  ModelInput,
  OutputFormat,
  RunControl,
} from './types.js';

type NumberArray = Uint8Array | Uint32Array | Float64Array | Float32Array;

/**
 * The array itself when it may be given away, else a copy. A view of a part of a buffer would take the whole buffer
 * along, so it is always copied; not by slice(), which for a Buffer of Node makes another view.
 */
function own<T extends NumberArray>(array: T, Type: new (source: T) => T, transfer: boolean): T {
  if (isDetached(array.buffer)) {
    throw detachedError();
  }
  const whole = array.byteLength === array.buffer.byteLength && array.buffer instanceof ArrayBuffer;
  return transfer && whole ? array : new Type(array);
}

function toInput(model: ModelInput, transfer: boolean): { input: Input; buffers: ArrayBuffer[] } {
  if (model instanceof ArrayBuffer && isDetached(model)) {
    throw detachedError();
  }
  if (model instanceof ArrayBuffer || model instanceof Uint8Array) {
    const bytes = own(model instanceof Uint8Array ? model : new Uint8Array(model), Uint8Array, transfer);
    return { input: { bytes }, buffers: [bytes.buffer as ArrayBuffer] };
  }
  const { positions, triangles } = model ?? {};
  if (
    !(positions instanceof Float64Array || positions instanceof Float32Array) ||
    !(triangles instanceof Uint32Array)
  ) {
    throw new QmcfError(
      'malformedInput',
      'The model must be an ArrayBuffer or Uint8Array with a file, or positions in a Float64Array or Float32Array ' +
        'and triangles in a Uint32Array.',
    );
  }
  const input = {
    positions:
      positions instanceof Float64Array
        ? own(positions, Float64Array, transfer)
        : own(positions, Float32Array, transfer),
    triangles: own(triangles, Uint32Array, transfer),
  };
  return { input, buffers: [input.positions.buffer as ArrayBuffer, input.triangles.buffer as ArrayBuffer] };
}

/** A result's own methods live in the prototype, so that its data can be cloned and passed on to other workers. */
class Mesh implements MeshResult {
  declare readonly positions: Float64Array;
  declare readonly elements: Int32Array;
  declare readonly elementFace: Int32Array;
  declare readonly featureSegments: Int32Array;
  declare readonly faceNames: readonly string[];
  declare readonly size: number;
  declare readonly elementScaledJacobian: Float64Array;
  declare readonly report: MeshResult['report'];
  declare readonly trace?: NonNullable<MeshResult['trace']>;
  readonly #mesher: Mesher;

  constructor(mesher: Mesher, data: Omit<MeshResult, 'file'>) {
    Object.assign(this, data);
    this.#mesher = mesher;
  }

  file(format: OutputFormat): Promise<Uint8Array<ArrayBuffer>> {
    return this.#mesher.write(this, format);
  }
}

/**
 * Meshes parts in a worker of its own. Calls are worked off one after the other. Errors of all methods are
 * {@link QmcfError}s.
 */
export class Mesher {
  readonly #line: Line;

  /** Use `createMesher()`. */
  constructor(platform: Platform, module: WebAssembly.Module) {
    this.#line = new Line(platform, module);
  }

  /**
   * Reads and repairs a model and recovers its faces, edges and vertices.
   *
   * @param input - A file's content or buffers; copied unless `control.transferInput`.
   * @param options - Only `featureAngle` and `repair` matter here.
   * @param control - Progress and cancel.
   */
  inspect(input: ModelInput, options: MeshOptions = {}, control: RunControl = {}): Promise<InspectResult> {
    return this.#start('inspect', input, options, control) as Promise<InspectResult>;
  }

  /** Computes the cross field that the quads of {@link Mesher.mesh} would follow. Parameters as there. */
  field(input: ModelInput, options: MeshOptions = {}, control: RunControl = {}): Promise<FieldResult> {
    return this.#start('field', input, options, control) as Promise<FieldResult>;
  }

  /**
   * Makes a valid quad-dominant mesh of a model.
   *
   * @param input - A file's content or buffers; copied unless `control.transferInput`.
   * @param options - Size and the rest, all optional.
   * @param control - Progress and cancel.
   */
  async mesh(input: ModelInput, options: MeshOptions = {}, control: RunControl = {}): Promise<MeshResult> {
    const data = await this.#start('mesh', input, options, control);
    return new Mesh(this, data as Omit<MeshResult, 'file'>);
  }

  /** The content of a file of this mesh, as the command line would write it. */
  write(mesh: MeshArrays, format: OutputFormat): Promise<Uint8Array<ArrayBuffer>> {
    const { positions, elements, elementFace, featureSegments, faceNames } = mesh;
    const input = { positions, elements, elementFace, featureSegments, faceNames };
    return this.#run({ name: 'write', input, format }, [], {}) as Promise<Uint8Array<ArrayBuffer>>;
  }

  /** Stops the worker. Runs that are under way are rejected with code `cancelled`. */
  dispose(): void {
    this.#line.close();
  }

  /** For `using mesher = await createMesher()`. */
  [Symbol.dispose](): void {
    this.dispose();
  }

  async #start(
    name: 'inspect' | 'field' | 'mesh',
    model: ModelInput,
    options: MeshOptions,
    control: RunControl,
  ): Promise<unknown> {
    const { input, buffers } = toInput(model, control.transferInput ?? false);
    return this.#run({ name, input, options: { ...options } }, buffers, control);
  }

  #run(task: Task, transfer: ArrayBuffer[], { signal, onProgress }: RunControl): Promise<unknown> {
    return new Promise((resolve, reject) => {
      if (signal?.aborted) {
        reject(cancelledError());
        return;
      }
      const onAbort = () => this.#line.cancel(run);
      const settle = () => signal?.removeEventListener('abort', onAbort);
      const run: Run = {
        task,
        transfer,
        onProgress,
        resolve: (value) => (settle(), resolve(value)),
        reject: (error) => (settle(), reject(error)),
      };
      signal?.addEventListener('abort', onAbort, { once: true });
      this.#line.add(run);
    });
  }
}
