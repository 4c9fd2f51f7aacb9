import { detachedError, isDetached } from './detached.js';
import { cancelledError, QmcfError } from './errors.js';
import { messageOf } from './load.js';
import type { FromWorker, Task, ToWorker } from './protocol.js';
import type { ProgressReport } from './types.js';

/** A worker of either platform. */
export interface Thread {
  post(message: ToWorker, transfer: ArrayBuffer[]): void;
  /** Stops it at once; no event comes after. */
  terminate(): void;
  /** In Node: whether the thread keeps the process alive. */
  hold(alive: boolean): void;
}

/** What a thread tells. */
export interface ThreadEvents {
  onMessage(message: FromWorker): void;
  /** The worker could not be loaded, or ended. */
  onFailure(message: string): void;
}

/** What differs between browsers and Node. */
export interface Platform {
  spawn(events: ThreadEvents): Thread;
  readonly sharedMemory: boolean;
}

export interface Run {
  readonly task: Task;
  readonly transfer: ArrayBuffer[];
  readonly onProgress: ((progress: ProgressReport) => void) | undefined;
  resolve(value: unknown): void;
  reject(error: QmcfError): void;
}

/** After a request to stop, the worker has this long to answer, in ms, before it is discarded. */
const patience = 1000;

/**
 * A queue of runs, one at a time, through a worker that is replaced when it crashed or had to be stopped by force.
 */
export class Line {
  private thread: Thread | undefined;
  private readonly waiting: Run[] = [];
  private current: { id: number; run: Run; impatience?: ReturnType<typeof setTimeout> } | undefined;
  private lastId = 0;
  private closed = false;
  private readonly cancelFlag: SharedArrayBuffer | undefined;

  constructor(
    private readonly platform: Platform,
    private readonly module: WebAssembly.Module,
  ) {
    this.cancelFlag = platform.sharedMemory ? new SharedArrayBuffer(4) : undefined;
    this.thread = this.spawn();
  }

  add(run: Run): void {
    if (this.closed) {
      run.reject(new QmcfError('cancelled', 'The mesher was disposed of.'));
      return;
    }
    this.waiting.push(run);
    this.next();
  }

  /** Rejects the run with `cancelled` now; the worker is free as soon as it noticed, or is replaced. */
  cancel(run: Run): void {
    const place = this.waiting.indexOf(run);
    if (place >= 0) {
      this.waiting.splice(place, 1);
    } else if (this.current?.run === run) {
      this.stopCurrent(this.current);
    }
    run.reject(cancelledError());
  }

  close(): void {
    this.closed = true;
    const runs = [...(this.current ? [this.current.run] : []), ...this.waiting.splice(0)];
    this.discard();
    for (const run of runs) {
      run.reject(cancelledError());
    }
  }

  private stopCurrent(current: NonNullable<typeof this.current>): void {
    if (this.cancelFlag) {
      Atomics.store(new Int32Array(this.cancelFlag), 0, current.id);
      current.impatience ??= setTimeout(() => this.replace(), patience);
    } else {
      this.replace();
    }
  }

  private spawn(): Thread {
    const thread = this.platform.spawn({
      onMessage: (message) => this.receive(message),
      onFailure: (message) => this.fail(new QmcfError('internal', `The worker stopped: ${message}`)),
    });
    thread.post(
      { kind: 'start', module: this.module, ...(this.cancelFlag && { cancelFlag: this.cancelFlag }) },
      [],
    );
    thread.hold(false);
    return thread;
  }

  private next(): void {
    while (!this.current && this.waiting.length > 0) {
      this.begin(this.waiting.shift()!);
    }
  }

  private begin(run: Run): void {
    // Node passes a detached buffer on as if it were whole, and nothing arrives.
    if (run.transfer.some(isDetached)) {
      run.reject(detachedError());
      return;
    }
    this.thread ??= this.spawn();
    const id = ++this.lastId;
    try {
      this.thread.post({ kind: 'run', id, task: run.task }, run.transfer);
    } catch (error) {
      run.reject(notSent(run, error));
      return;
    }
    this.current = { id, run };
    this.thread.hold(true);
  }

  private receive(message: FromWorker): void {
    const current = this.current;
    if (current?.id !== message.id) {
      return;
    }
    switch (message.kind) {
      case 'progress':
        if (current.impatience === undefined) {
          current.run.onProgress?.({ stage: message.stage, fraction: message.fraction });
        }
        return;
      case 'done':
        current.run.resolve(message.value);
        this.finish();
        return;
      case 'failed':
        current.run.reject(new QmcfError(message.error.code, message.error.message, message.error.elements));
        this.finish();
        return;
      case 'crashed':
        this.fail(
          message.outOfMemory
            ? new QmcfError('tooLarge', 'There is not enough memory for this model at this element size.')
            : new QmcfError('internal', `The mesher stopped unexpectedly (${message.message}).`),
        );
    }
  }

  private finish(): void {
    clearTimeout(this.current?.impatience);
    this.current = undefined;
    this.thread?.hold(false);
    this.next();
  }

  /** The worker can't be used any more: its run fails, the others go to a new one. */
  private fail(error: QmcfError): void {
    this.current?.run.reject(error);
    this.replace();
  }

  private replace(): void {
    this.discard();
    this.next();
  }

  private discard(): void {
    clearTimeout(this.current?.impatience);
    this.current = undefined;
    this.thread?.terminate();
    this.thread = undefined;
  }
}

/** Why a run can't be passed to a worker, which takes plain data only. */
function notSent({ task }: Run, error: unknown): QmcfError {
  const options = 'options' in task ? Object.entries(task.options) : [];
  const [name] = options.find(([, value]) => !isCloneable(value)) ?? [];
  return name === undefined
    ? new QmcfError('malformedInput', `What was given can't be passed to the worker: ${messageOf(error)}`)
    : new QmcfError('invalidOption', `The option ${name} must be plain data, no proxy or function: ${messageOf(error)}`);
}

function isCloneable(value: unknown): boolean {
  try {
    structuredClone(value);
    return true;
  } catch {
    return false;
  }
}
