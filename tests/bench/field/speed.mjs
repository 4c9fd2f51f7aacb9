// Time of the cross field of 100,000 vertices, natively and in WebAssembly under Node, in turns so that both see the
// same machine:
//
//   cmake --build --preset native --target field_speed && cmake --build --preset wasm --target field_speed
//   node tests/bench/field/speed.mjs [ROUNDS]
//
// Exit status: 0 within the limits and the same field bit for bit, else 1.

import { execFileSync } from 'node:child_process';
import { join, resolve } from 'node:path';

const LIMITS = { nativeSeconds: 2.5, ratio: 2.2 };
const ROOT = resolve(import.meta.dirname, '../../..');
const rounds = Number(process.argv[2] ?? 3);

const programs = {
  native: [join(ROOT, 'build/native/bin/field_speed')],
  wasm: [process.execPath, join(ROOT, 'build/wasm/bin/field_speed.cjs')],
};
const best = {};
for (let round = 0; round < rounds; round++) {
  for (const [name, [program, ...args]] of Object.entries(programs)) {
    const result = JSON.parse(execFileSync(program, args, { encoding: 'utf8' }));
    if (!best[name] || result.seconds < best[name].seconds) best[name] = result;
  }
}
const { native, wasm } = best;
const ratio = wasm.seconds / native.seconds;
const same = native.digest === wasm.digest;
console.log(`${native.vertices} vertices, ${native.singularities} singularities, best of ${rounds} (CPU seconds):`);
console.log(`native ${native.seconds.toFixed(2)} (at most ${LIMITS.nativeSeconds}), wasm ${wasm.seconds.toFixed(2)}, ratio ${ratio.toFixed(2)} (at most ${LIMITS.ratio}), ${same ? 'same bits' : 'DIFFERENT FIELDS'}`);
process.exitCode = native.seconds <= LIMITS.nativeSeconds && ratio <= LIMITS.ratio && same ? 0 : 1;
