import { QmcfError } from './errors.js';

/** Where the WebAssembly comes from: an address, its bytes, or the module that is already compiled. */
export type WasmSource = string | URL | BufferSource | WebAssembly.Module;

/** Settings of a mesher. */
export interface MesherSettings {
  /** Default: the file beside this package's code, which bundlers find and copy. */
  wasm?: WasmSource | undefined;
}

/** Compiles the source; `fetchBytes` knows how the platform gets at an address. */
export async function compile(
  source: WasmSource,
  fetchBytes: (address: string | URL) => Promise<Response | BufferSource>,
): Promise<WebAssembly.Module> {
  if (source instanceof WebAssembly.Module) {
    return source;
  }
  const address = typeof source === 'string' || source instanceof URL ? source : undefined;
  try {
    const got = address === undefined ? (source as BufferSource) : await fetchBytes(address);
    if (!(got instanceof Response)) {
      return await WebAssembly.compile(got);
    }
    if (!got.ok) {
      throw new Error(`status ${got.status}`);
    }
    // Servers that don't know the type of .wasm files keep streaming from working, nothing else.
    return got.headers.get('content-type')?.startsWith('application/wasm')
      ? await WebAssembly.compileStreaming(got)
      : await WebAssembly.compile(await got.arrayBuffer());
  } catch (error) {
    const from = address === undefined ? 'the bytes given' : String(address);
    throw new QmcfError('internal', `The WebAssembly module could not be loaded from ${from}: ${messageOf(error)}`);
  }
}

/** The message of anything that was thrown. */
export function messageOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
