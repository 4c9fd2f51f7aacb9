// The messages between a mesher and its worker.

import type { ErrorCode, Stage } from './tables.js';
import type { MeshArrays, MeshOptions, TriangleBuffers } from './types.js';

export type Input = TriangleBuffers | { readonly bytes: Uint8Array };

/** What the worker can do; the names are those of the core's functions. */
export type Task =
  | { readonly name: 'inspect' | 'field' | 'mesh'; readonly input: Input; readonly options: MeshOptions }
  | { readonly name: 'write'; readonly input: MeshArrays; readonly format: string };

export interface StartMessage {
  readonly kind: 'start';
  readonly module: WebAssembly.Module;
  /** One Int32: the id of the run that shall stop. Absent where memory can't be shared. */
  readonly cancelFlag?: SharedArrayBuffer;
}

export interface RunMessage {
  readonly kind: 'run';
  readonly id: number;
  readonly task: Task;
}

export type ToWorker = StartMessage | RunMessage;

export interface Failure {
  readonly code: ErrorCode;
  readonly message: string;
  readonly elements: readonly number[];
}

export type FromWorker =
  | { readonly kind: 'progress'; readonly id: number; readonly stage: Stage; readonly fraction: number }
  | { readonly kind: 'done'; readonly id: number; readonly value: unknown }
  | { readonly kind: 'failed'; readonly id: number; readonly error: Failure }
  /** The WebAssembly instance can't be used any more. */
  | { readonly kind: 'crashed'; readonly id: number; readonly outOfMemory: boolean; readonly message: string };
