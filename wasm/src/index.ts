// What browsers and Node have in common.

export { QmcfError } from './errors.js';
export type { MesherSettings, WasmSource } from './load.js';
export type { Mesher } from './mesher.js';
export { errorMeanings, stages, type ErrorCode, type Stage } from './tables.js';
export { meshOptionNames, outputFormats } from './types.js';
export type * from './types.js';
