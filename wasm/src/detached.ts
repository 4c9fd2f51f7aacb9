import { QmcfError } from './errors.js';

/** Whether a buffer was transferred, which leaves an empty one behind. */
export function isDetached(buffer: ArrayBufferLike): boolean {
  try {
    new Uint8Array(buffer);
    return false;
  } catch {
    return true;
  }
}

/** The error of a model whose buffers are detached. */
export function detachedError(): QmcfError {
  return new QmcfError(
    'malformedInput',
    'The model is in a buffer that was given away before, by transferInput or to another worker, and holds nothing any ' +
      'more: leave out transferInput, or pass a copy each time.',
  );
}
