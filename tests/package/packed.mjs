// Packs the npm package, installs the tarball in an empty folder, and loads it from there as a user would.
import { execFileSync, spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

export const root = fileURLToPath(new URL('../..', import.meta.url));
export const nativeProgram = join(root, 'build/native/bin/qmcf');

const folder = mkdtempSync(join(tmpdir(), 'qmcf-package-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

const npm = (cwd, ...args) => execFileSync('npm', args, { cwd, encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] });
const [packed] = JSON.parse(npm(join(root, 'wasm'), 'pack', '--json', '--pack-destination', folder));
writeFileSync(join(folder, 'package.json'), '{ "private": true, "type": "module" }');
npm(folder, 'install', '--offline', '--no-audit', '--no-fund', `./${packed.filename}`);

/** The folder that a user's project would be. */
export const project = folder;
/** Paths in the tarball. */
export const packedFiles = packed.files.map(({ path }) => path);
/** Path of the installed package. */
export const installed = join(folder, 'node_modules/qmcf');
/** What `import ... from 'qmcf'` gives in that project. */
export const qmcf = await import(pathToFileURL(createRequire(join(folder, 'index.js')).resolve('qmcf')).href);

/** The content of a sample. */
export const sample = (name) => readFileSync(join(root, 'samples', name));

/** Runs the native command line; {status, stderr}. */
export function native(...args) {
  if (!existsSync(nativeProgram)) {
    throw new Error('Build the native program first: cmake --preset native && cmake --build --preset native');
  }
  return spawnSync(nativeProgram, args, { encoding: 'utf8' });
}

/** A path in the user's project. */
export const inProject = (name) => join(folder, name);
