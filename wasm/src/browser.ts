import type { Platform } from './line.js';
import { compile, type MesherSettings } from './load.js';
import { Mesher } from './mesher.js';
import type { FromWorker } from './protocol.js';

export * from './index.js';

const platform: Platform = {
  sharedMemory: globalThis.crossOriginIsolated === true,
  spawn(events) {
    const worker = new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'qmcf' });
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => events.onMessage(data);
    worker.onerror = ({ message }) => events.onFailure(message ?? 'its code could not be loaded.');
    return {
      post: (message, transfer) => worker.postMessage(message, transfer),
      terminate: () => worker.terminate(),
      hold: () => {},
    };
  },
};

/**
 * Compiles the core and starts its worker.
 *
 * @param settings - Where the WebAssembly is, if not where the bundler put it.
 * @throws QmcfError with code `internal` when it can't be loaded.
 */
export async function createMesher(settings: MesherSettings = {}): Promise<Mesher> {
  const source = settings.wasm ?? new URL('./qmcf.wasm', import.meta.url);
  return new Mesher(platform, await compile(source, (address) => fetch(address)));
}
