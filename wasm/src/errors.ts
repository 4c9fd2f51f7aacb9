import type { ErrorCode } from './tables.js';

/** The one error class of this package: every rejected promise and every thrown error is one. */
export class QmcfError extends Error {
  override readonly name = 'QmcfError';
  /** Why, for a program. */
  readonly code: ErrorCode;
  /** Lines or element ids at fault, 0-based, at most 100. */
  readonly elements: readonly number[];

  /**
   * @param code - Why, for a program.
   * @param message - One sentence for a person.
   * @param elements - Lines or element ids at fault.
   */
  constructor(code: ErrorCode, message: string, elements: readonly number[] = []) {
    super(message);
    this.code = code;
    this.elements = elements;
  }
}

/** The error of a run that was cancelled, or whose mesher was disposed of. */
export function cancelledError(): QmcfError {
  return new QmcfError('cancelled', 'The run was cancelled.');
}
