// Writes src/tables.ts: the names that TypeScript shares with the core, read from the core's own headers.
import { readFileSync, writeFileSync } from 'node:fs';

const core = new URL('../../core/', import.meta.url);
const read = (path) => readFileSync(new URL(path, core), 'utf8');

const errors = [...read('base/include/qmcf/base/errors.def').matchAll(/^QMCF_ERROR\((\w+), (\d), "(.*)"\)$/gm)];
const stages = /enum class Stage[^{]*\{([^}]*)\}/.exec(read('base/include/qmcf/base/progress.hpp'))?.[1]?.match(/\w+/g);
if (errors.length === 0 || !stages?.length) {
  throw new Error('The tables of errors and stages were not found in the headers of core/base.');
}

const rows = errors.map(([, code, , meaning]) => `  ${code}: ${JSON.stringify(meaning)},`);
writeFileSync(
  new URL('../src/tables.ts', import.meta.url),
  `// Made by scripts/make_tables.mjs from core/base; not edited by hand.

/** What each error code means in general; a {@link QmcfError}'s message says what happened. */
export const errorMeanings = {
${rows.join('\n')}
} as const;

/** Why an operation could not be done. */
export type ErrorCode = keyof typeof errorMeanings;

/** The stages of a run, in order. */
export const stages = ${JSON.stringify(stages)} as const;

/** A stage of a run. */
export type Stage = (typeof stages)[number];
`,
);
