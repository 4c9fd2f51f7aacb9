import createCore, { type Core, type Outcome } from './qmcf.js';
import { messageOf } from './load.js';
import type { FromWorker, RunMessage, StartMessage, Task, ToWorker } from './protocol.js';
import { stages } from './tables.js';

/** The worker's end of the line, the same for browsers and Node. */
export interface Port {
  post(message: FromWorker, transfer: ArrayBuffer[]): void;
  onMessage(handler: (message: ToWorker) => void): void;
}

const progressInterval = 50; // ms

/** Passes progress on, not too often, and looks whether the current run shall stop. */
class Watch {
  private id = 0;
  private stage = -1;
  private posted = 0;

  constructor(
    private readonly port: Port,
    private readonly cancelFlag: Int32Array | undefined,
  ) {}

  begin(id: number): void {
    this.id = id;
    this.stage = -1;
  }

  report(stage: number, fraction: number): boolean {
    const now = performance.now();
    if (stage !== this.stage || now - this.posted >= progressInterval) {
      this.stage = stage;
      this.posted = now;
      this.port.post({ kind: 'progress', id: this.id, stage: stages[stage]!, fraction }, []);
    }
    return this.cancelFlag === undefined || Atomics.load(this.cancelFlag, 0) !== this.id;
  }
}

function call(core: Core, task: Task): Outcome {
  return task.name === 'write' ? core.write(task.input, task.format) : core[task.name](task.input, task.options);
}

/** Parses what is JSON and lists the buffers of all typed arrays in a result. */
function unpack(value: unknown, transfer: ArrayBuffer[]): unknown {
  if (ArrayBuffer.isView(value)) {
    transfer.push(value.buffer as ArrayBuffer);
    return value;
  }
  if (value === null || typeof value !== 'object' || Array.isArray(value)) {
    return value;
  }
  const entries = Object.entries(value).map(([key, part]) => [
    key,
    key === 'report' || key === 'trace' ? (JSON.parse(part as string) as unknown) : unpack(part, transfer),
  ]);
  return Object.fromEntries(entries) as unknown;
}

/** Engines say it in words of their own; a RangeError is about memory unless it is about the stack. */
function isOutOfMemory(error: unknown, abortReason: string): boolean {
  const message = messageOf(error);
  return (
    /OOM|enlarge memory|allocation failed|out of memory/i.test(`${abortReason} ${message}`) ||
    (error instanceof RangeError && !/call stack/i.test(message))
  );
}

class Server {
  private abortReason = '';

  constructor(
    private readonly port: Port,
    private readonly core: Promise<Core>,
    private readonly watch: Watch,
  ) {}

  static start(port: Port, { module, cancelFlag }: StartMessage): Server {
    const watch = new Watch(port, cancelFlag && new Int32Array(cancelFlag));
    const core = new Promise<Core>((resolve, reject) => {
      createCore({
        instantiateWasm(imports, done) {
          // The core itself never hears of an instance that could not be made, of lack of memory for one.
          WebAssembly.instantiate(module, imports).then((instance) => done(instance, module)).catch(reject);
          return {};
        },
        onAbort: (what) => (server.abortReason = String(what)),
        onReport: (stage, fraction) => watch.report(stage, fraction),
        print: () => {},
        printErr: () => {},
      }).then(resolve, reject);
    });
    // Each run tells why there is no core. An unhandled rejection would end Node's worker before the first one.
    core.catch(() => {});
    const server = new Server(port, core, watch);
    return server;
  }

  async run({ id, task }: RunMessage): Promise<void> {
    try {
      const core = await this.core;
      this.watch.begin(id);
      const outcome = call(core, task);
      if ('error' in outcome) {
        this.port.post({ kind: 'failed', id, error: outcome.error }, []);
        return;
      }
      const transfer: ArrayBuffer[] = [];
      const value = unpack(outcome.value, transfer);
      this.port.post({ kind: 'done', id, value }, transfer);
    } catch (error) {
      const outOfMemory = isOutOfMemory(error, this.abortReason);
      this.port.post({ kind: 'crashed', id, outOfMemory, message: messageOf(error) }, []);
    }
  }
}

/** Answers the messages of one mesher for as long as the worker lives. */
export function serve(port: Port): void {
  let server: Server | undefined;
  port.onMessage((message) => {
    if (message.kind === 'start') {
      server = Server.start(port, message);
    } else {
      void server?.run(message);
    }
  });
}
