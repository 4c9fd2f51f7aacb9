// The module that Node's worker thread runs.

import { parentPort } from 'node:worker_threads';
import type { ToWorker } from './protocol.js';
import { serve } from './serve.js';

if (!parentPort) {
  throw new Error('This module runs in a worker thread that a mesher has started.');
}
const port = parentPort;

serve({
  post: (message, transfer) => port.postMessage(message, transfer),
  onMessage: (handler) => void port.on('message', (message: ToWorker) => handler(message)),
});
