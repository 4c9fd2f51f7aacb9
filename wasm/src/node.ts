import { readFile } from 'node:fs/promises';
import { Worker } from 'node:worker_threads';
import type { Platform } from './line.js';
import { compile, type MesherSettings } from './load.js';
import { Mesher } from './mesher.js';
import type { FromWorker } from './protocol.js';

export * from './index.js';

const platform: Platform = {
  sharedMemory: true,
  spawn(events) {
    const worker = new Worker(new URL('./worker_node.js', import.meta.url));
    worker.on('message', (message: FromWorker) => events.onMessage(message));
    worker.on('error', (error) => events.onFailure(error.message));
    return {
      post: (message, transfer) => worker.postMessage(message, transfer),
      terminate: () => {
        worker.removeAllListeners();
        void worker.terminate();
      },
      hold: (alive) => (alive ? worker.ref() : worker.unref()),
    };
  },
};

function getBytes(address: string | URL): Promise<Response | BufferSource> {
  return /^(https?|data):/i.test(String(address)) ? fetch(address) : readFile(fileOf(address));
}

function fileOf(address: string | URL): string | URL {
  return typeof address === 'string' && /^file:/i.test(address) ? new URL(address) : address;
}

/**
 * Compiles the core and starts its worker thread.
 *
 * @param settings - Where the WebAssembly is (a path or an address), if not beside this file.
 * @throws QmcfError with code `internal` when it can't be loaded.
 */
export async function createMesher(settings: MesherSettings = {}): Promise<Mesher> {
  return new Mesher(platform, await compile(settings.wasm ?? new URL('./qmcf.wasm', import.meta.url), getBytes));
}
