// Builds the package into dist/: the core with Emscripten, then TypeScript. Needs cmake and emcc on the PATH.
import { spawnSync } from 'node:child_process';
import { copyFileSync, mkdirSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const packageDir = fileURLToPath(new URL('..', import.meta.url));
const root = join(packageDir, '..');
const binaries = join(root, 'build/wasm/bin');
const dist = join(packageDir, 'dist');

function run(command, ...args) {
  const { status, error } = spawnSync(command, args, { cwd: root, stdio: 'inherit' });
  if (error || status !== 0) {
    console.error(`${command} ${args.join(' ')}: ${error?.message ?? `exit status ${status}`}`);
    process.exit(1);
  }
}

run('cmake', '--preset', 'wasm');
run('cmake', '--build', '--preset', 'wasm', '--target', 'qmcf_wasm', '--parallel');
run(process.execPath, join(packageDir, 'scripts/make_tables.mjs'));
rmSync(dist, { recursive: true, force: true });
run('npx', '--no-install', 'tsc', '-p', packageDir);
mkdirSync(dist, { recursive: true });
for (const file of ['qmcf.js', 'qmcf.wasm']) {
  copyFileSync(join(binaries, file), join(dist, file));
}
copyFileSync(join(root, 'LICENSE'), join(packageDir, 'LICENSE'));
