// Makes many random cases, each in a process of its own, and prints the seeds of those that fail.

import { existsSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { runMeasured } from '../corpus/child.mjs';

const ROOT = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
const USAGE = `usage: tests/property/run [N] [SEED] [options]
  N                cases (2000)
  SEED             of the first case (1); the others have the following ones
  --small          the small cases that every build makes
  --jobs N         cases at a time (2)
  --timeout S      seconds of CPU time per case (30)
  --program PATH   the program (build/native/bin/property)
One case again, with part and mesh as OBJ: build/native/bin/property SEED [--small] --obj PREFIX
exit status: 0 nothing wrong; 1 some case fails; 2 wrong usage`;

function parseCommandLine() {
  const text = { type: 'string' };
  const { values, positionals } = parseArgs({
    allowPositionals: true,
    options: { small: { type: 'boolean' }, jobs: text, timeout: text, program: text, help: { type: 'boolean' } },
  });
  const [count, seed] = [Number(positionals[0] ?? 2000), Number(positionals[1] ?? 1)];
  const [jobs, timeout] = [Number(values.jobs ?? 2), Number(values.timeout ?? 30)];
  const program = resolve(values.program ?? join(ROOT, 'build/native/bin/property'));
  if (values.help || !(count > 0) || !(seed >= 0) || !(jobs > 0) || !(timeout > 0) || positionals.length > 2) {
    console.log(USAGE);
    process.exit(values.help ? 0 : 2);
  }
  if (!existsSync(program)) {
    console.error(`${program}: not built; cmake --build --preset native --target property`);
    process.exit(2);
  }
  return { count, seed, jobs, timeout, program, small: values.small };
}

const { count, seed, jobs, timeout, program, small } = parseCommandLine();
let next = 0;
let failed = 0;
let fallbacks = 0;
let slowest = { cpuSeconds: 0, seed };

async function work() {
  while (next < count) {
    const current = seed + next++;
    const run = await runMeasured(program, [String(current), ...(small ? ['--small'] : [])], timeout);
    if (run.cpuSeconds > slowest.cpuSeconds) slowest = { cpuSeconds: run.cpuSeconds, seed: current };
    if (/^ {2}\(face/m.test(run.stdout)) ++fallbacks;
    if (run.exit === 0 && !run.timedOut) continue;
    ++failed;
    const how = run.timedOut ? `takes more than ${timeout} s of CPU time` : run.signal ? `signal ${run.signal}` : '';
    console.log(`seed ${current}: ${how} ${run.stdout.trim()} ${run.stderr.trim()}`.trim());
  }
}

await Promise.all(Array.from({ length: jobs }, work));
console.log(`${count} cases from seed ${seed}: ${failed} failed, ${fallbacks} with a fallback, slowest ${slowest.cpuSeconds.toFixed(1)} s (seed ${slowest.seed})`);
process.exitCode = failed > 0 ? 1 : 0;
