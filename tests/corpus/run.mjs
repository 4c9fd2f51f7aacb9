// Meshes every model of a folder with the native program and has each result judged.

import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { runMeasured } from './child.mjs';
import { ledgerFault, readElements } from '../tools/lib/ledger.mjs';
import { compareResults, resultTable, summaryLine } from './table.mjs';
import { judgeMesh, judgeSizes } from './verdict.mjs';

const ROOT = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
const USAGE = `usage: tests/corpus/run [FOLDER or FILE ...] [options] [-- options of qmcf mesh]
  FOLDER, FILE     models (.obj, .stl, .ply); default: ../shared/models if it exists, else samples
  --quads N        elements to aim at (3000)
  --jobs N         models at a time (2)
  --timeout S      seconds of CPU time per model (120), and ten times that by the clock
  --only REGEX     models whose name matches
  --qmcf PATH      the program (build/native/bin/qmcf)
  --judge PATH     the judge; default: QMCF_JUDGE or ../shared/judge/judge.mjs if it exists; none: qmcf check
  --samples N      the judge's surface samples in each direction (30000)
  --sizes          judge sizes by the field that the mesh was made with, not by one length
  --out DIR        where the meshes go (a new temporary folder)
  --pictures       draw each mesh beside it, with its part's features
  --json FILE      write the results
  --base FILE      compare with the results of an earlier --json
  --demands FILE   only the parts named there, each of which has to reach the figures given for it (demands.json)
exit status: 0 each mesh valid or its part refused with a reason (exit 3); 1 otherwise, or worse than the base, or below
what is demanded; 2 wrong usage`;

const VERDICT_OF_EXIT = { 3: 'REFUSED' };

function parseCommandLine(args) {
  const text = { type: 'string' };
  const separator = args.indexOf('--');
  const own = separator < 0 ? args : args.slice(0, separator);
  const { values, positionals } = parseArgs({
    args: own,
    allowPositionals: true,
    options: {
      quads: text, jobs: text, timeout: text, only: text, qmcf: text, judge: text, samples: text, out: text, json: text, base: text,
      demands: text, pictures: { type: 'boolean' }, sizes: { type: 'boolean' }, help: { type: 'boolean' },
    },
  });
  const number = (name, fallback) => {
    const value = Number(values[name] ?? fallback);
    if (!(value > 0)) throw new Error(`--${name} needs a positive number`);
    return value;
  };
  return {
    ...values,
    inputs: positionals.length ? positionals : [firstExisting([join(ROOT, '../shared/models')]) ?? join(ROOT, 'samples')],
    quads: number('quads', 3000),
    jobs: number('jobs', 2),
    timeout: number('timeout', 120),
    samples: number('samples', 30000),
    qmcf: resolve(values.qmcf ?? join(ROOT, 'build/native/bin/qmcf')),
    judge: findJudge(values.judge),
    demands: values.demands && JSON.parse(readFileSync(values.demands, 'utf8')),
    out: resolve(values.out ?? mkdtempSync(join(tmpdir(), 'qmcf-corpus-'))),
    extra: separator < 0 ? [] : args.slice(separator + 1),
  };
}

const firstExisting = (paths) => paths.find((path) => path && existsSync(path));

function findJudge(given) {
  if (given === 'none') return null;
  if (given && !existsSync(given)) throw new Error(`${given}: no such judge`);
  return firstExisting([given, process.env.QMCF_JUDGE, join(ROOT, '../shared/judge/judge.mjs')]) ?? null;
}

function findModels({ inputs, only, demands }) {
  const wanted = only === undefined ? /^/ : new RegExp(only);
  const isModel = (name) => /\.(obj|stl|ply)$/i.test(name) && wanted.test(name) && (!demands || name in demands);
  return inputs.flatMap((input) => {
    if (!statSync(input).isDirectory()) return [input];
    return readdirSync(input).filter(isModel).sort().map((name) => join(input, name));
  });
}

async function measureModel(part, options) {
  const model = basename(part);
  const mesh = join(options.out, `${model}.quads.obj`);
  const report = join(options.out, `${model}.report.json`);
  const args = ['mesh', part, '-o', mesh, '--report', report, '--quads', String(options.quads), '--quiet', ...options.extra];
  const sizing = { mesh: join(options.out, `${model}.sizing.obj`), sizes: join(options.out, `${model}.sizes`) };
  if (options.sizes) args.push('--sizing-mesh', sizing.mesh, '--sizing-out', sizing.sizes);
  const run = await runMeasured(options.qmcf, args, options.timeout);
  const { seconds, cpuSeconds, peakMegabytes } = run;
  const result = { model, seconds, cpuSeconds, peakMegabytes, exit: run.exit };
  if (run.timedOut) return { ...result, verdict: 'TIMEOUT', message: `after ${(cpuSeconds ?? seconds).toFixed(0)} s` };
  if (run.signal) return { ...result, verdict: 'CRASH', message: `signal ${run.signal}` };
  if (run.exit !== 0) {
    return { ...result, verdict: VERDICT_OF_EXIT[run.exit] ?? 'FAILED', message: `exit ${run.exit}: ${run.stderr.trim().split('\n').pop()}` };
  }
  const { valid, ...figures } = await judgeMesh(options, part, mesh);
  if (options.sizes) figures.sizeError = await judgeSizes(options, mesh, sizing);
  const fault = options.sizes && figures.sizeError === null
    ? 'sizes could not be judged'
    : ledgerFault(JSON.parse(readFileSync(report, 'utf8')).quality, readElements(mesh));
  if (fault) figures.failing.push(fault);
  if (options.pictures) await drawMesh(part, mesh);
  return demand({ ...result, verdict: valid && !fault ? 'VALID' : 'INVALID', ...figures }, options.demands?.[model]);
}

/**
 * A valid mesh that misses a figure demanded of it is not good enough. Seconds are a limit, the others least values; a
 * figure that the part does not have (no corners, say) can't be missed.
 */
function demand(result, figures = {}) {
  const missed = Object.entries(figures)
    .filter(([name, value]) => result[name] !== null && !(name === 'seconds' ? result.seconds <= value : result[name] >= value))
    .map(([name, value]) => `${name} ${Number(result[name]?.toPrecision(4) ?? NaN)}, not ${value}`);
  if (missed.length === 0) return result;
  return { ...result, verdict: result.verdict === 'VALID' ? 'BELOW' : result.verdict, failing: [...result.failing, ...missed] };
}

async function drawMesh(part, mesh) {
  const args = [join(ROOT, 'tests/tools/render.mjs'), mesh, mesh.replace(/\.obj$/, '.png')];
  if (!/\.ply$/i.test(part)) args.push('--ref', part);
  const run = await runMeasured(process.execPath, args, 120);
  if (run.exit !== 0) console.error(run.stderr.trim());
}

/** Works on the models with as many runs at a time as there are jobs; results are in the order of the models. */
async function measureAll(models, options) {
  const results = new Array(models.length);
  let next = 0;
  const work = async () => {
    while (next < models.length) {
      const i = next++;
      results[i] = await measureModel(models[i], options);
      const { model, verdict, cpuSeconds, message } = results[i];
      console.error(`${i + 1}/${models.length} ${model} ${verdict} ${cpuSeconds?.toFixed(2) ?? '-'} s ${message ?? ''}`);
    }
  };
  await Promise.all(Array.from({ length: options.jobs }, work));
  return results;
}

async function main(args) {
  const options = parseCommandLine(args);
  if (options.help) {
    console.log(USAGE);
    return 0;
  }
  if (!existsSync(options.qmcf)) throw new Error(`${options.qmcf}: not built; cmake --preset native && cmake --build --preset native`);
  if (options.sizes && !options.judge) throw new Error('--sizes needs the judge');
  const models = findModels(options);
  if (models.length === 0) throw new Error('no models');
  mkdirSync(options.out, { recursive: true });
  const results = await measureAll(models, options);
  console.log(resultTable(results));
  console.log(`\n${summaryLine(results)}\nmeshes in ${options.out}${options.judge ? '' : '; judged by qmcf check, not by an independent judge'}`);
  if (options.json) writeFileSync(options.json, JSON.stringify({ quads: options.quads, extra: options.extra, results }, null, 1));
  let failed = results.some(({ verdict }) => verdict !== 'VALID' && verdict !== 'REFUSED');
  if (options.base) {
    const { text, worse } = compareResults(JSON.parse(readFileSync(options.base, 'utf8')).results, results);
    console.log(`\ncompared with ${options.base} (+ better, - worse):\n${text}`);
    failed ||= worse;
  }
  return failed ? 1 : 0;
}

try {
  process.exitCode = await main(process.argv.slice(2));
} catch (error) {
  console.error(`${error.message}\n${USAGE}`);
  process.exitCode = 2;
}
