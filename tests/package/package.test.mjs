// The tarball: what is in it, and that its types and its README are right.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { installed, packedFiles, project, qmcf, root } from './packed.mjs';

const header = (path) => readFileSync(join(root, 'core', path), 'utf8');

/** The fields of a C++ struct that has no functions, in order. */
function structFields(source, name) {
  const body = new RegExp(`struct ${name} \\{([^}]*(?:\\{[^}]*\\}[^}]*)*?)\\n\\};`).exec(source)[1];
  const code = body.replace(/\/\/.*$/gm, '');
  return [...code.matchAll(/(\w+)(?:\s*=[^;]*|\s*\{[^;]*\})?;/g)].map(([, field]) => field);
}

/** The members of a TypeScript interface of plain properties, in order. */
function interfaceMembers(name) {
  const types = readFileSync(join(installed, 'dist/types.d.ts'), 'utf8').replace(/\/\*[\s\S]*?\*\//g, '');
  const body = new RegExp(`interface ${name} \\{([^}]*)\\}`).exec(types)[1];
  return [...body.matchAll(/(?:readonly )?(\w+)\??:/g)].map(([, member]) => member);
}

/** The core's own functions, without the worker around them. */
async function loadCore() {
  const { default: createCore } = await import(join(installed, 'dist/qmcf.js'));
  const module = await WebAssembly.compile(readFileSync(join(installed, 'dist/qmcf.wasm')));
  return createCore({
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(module, imports).then((instance) => done(instance, module));
      return {};
    },
    onReport: () => true,
  });
}

test('the tarball holds the code, the WebAssembly, the readme and the licence, and nothing else', () => {
  const others = packedFiles.filter((path) => !/^dist\/\w+(\.d)?\.(ts|js)$/.test(path));
  assert.deepEqual(others.sort(), ['LICENSE', 'README.md', 'dist/qmcf.wasm', 'package.json']);
});

test('names of errors, stages and options are those of the core', async () => {
  const { errors, stages, options } = (await loadCore()).tables();
  assert.deepEqual(Object.keys(qmcf.errorMeanings), errors);
  assert.deepEqual([...qmcf.stages], stages);
  assert.deepEqual([...qmcf.meshOptionNames], options);
  assert.deepEqual(options, structFields(header('pipeline/include/qmcf/pipeline/mesh_surface.hpp'), 'MeshOptions'));
});

test('members of the types are the fields of the C++ structs', () => {
  const quality = header('quality/include/qmcf/quality/quality.hpp');
  for (const name of ['QualityReport', 'Distribution', 'ValidityCheck']) {
    assert.deepEqual(interfaceMembers(name), structFields(quality, name));
  }
  const pipeline = header('pipeline/include/qmcf/pipeline/mesh_surface.hpp');
  assert.deepEqual(interfaceMembers('FaceReport'), structFields(pipeline, 'FaceReport'));
  assert.deepEqual(
    interfaceMembers('RepairItem'),
    structFields(header('topology/include/qmcf/topology/repair.hpp'), 'RepairItem'),
  );
});

test('the example of the readme compiles with strict types', () => {
  const code = /```ts\n([\s\S]*?)```/.exec(readFileSync(join(installed, 'README.md'), 'utf8'))[1];
  mkdirSync(join(project, 'example'), { recursive: true });
  writeFileSync(join(project, 'example/main.ts'), `declare const file: File;\n${code}`);
  const options = ['--strict', '--noEmit', '--target', 'es2022', '--module', 'nodenext', '--lib', 'es2023,dom,esnext.disposable'];
  const tsc = join(root, 'node_modules/.bin/tsc');
  const run = spawnSync(tsc, [...options, '--types', '', 'main.ts'], { cwd: join(project, 'example'), encoding: 'utf8' });
  assert.equal(run.status, 0, run.stdout);
});
