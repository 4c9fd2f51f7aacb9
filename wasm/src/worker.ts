// The module that the browser's worker runs.

import type { FromWorker, ToWorker } from './protocol.js';
import { serve } from './serve.js';

// TypeScript's DOM and worker libraries exclude each other; this is what is used of the worker's global scope.
interface WorkerScope {
  postMessage(message: FromWorker, transfer: ArrayBuffer[]): void;
  onmessage: ((event: { data: ToWorker }) => void) | null;
}
const scope = globalThis as unknown as WorkerScope;

serve({
  post: (message, transfer) => scope.postMessage(message, transfer),
  onMessage: (handler) => (scope.onmessage = ({ data }) => handler(data)),
});
