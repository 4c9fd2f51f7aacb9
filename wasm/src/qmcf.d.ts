// The glue that Emscripten makes of wasm/bindings.cpp; only the worker sees it.

import type { Failure, Input } from './protocol.js';
import type { MeshArrays, MeshOptions } from './types.js';

export type Outcome = { readonly value: unknown } | { readonly error: Failure };

export interface Core {
  inspect(input: Input, options: MeshOptions): Outcome;
  field(input: Input, options: MeshOptions): Outcome;
  mesh(input: Input, options: MeshOptions): Outcome;
  write(input: MeshArrays, format: string): Outcome;
  tables(): { errors: string[]; stages: string[]; options: string[] };
}

export interface CoreSettings {
  instantiateWasm(
    imports: WebAssembly.Imports,
    done: (instance: WebAssembly.Instance, module: WebAssembly.Module) => void,
  ): WebAssembly.Exports | Record<string, never>;
  onAbort(what: unknown): void;
  onReport(stage: number, fraction: number): boolean;
  print(line: string): void;
  printErr(line: string): void;
}

export default function createCore(settings: CoreSettings): Promise<Core>;
