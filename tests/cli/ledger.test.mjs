// The ledger of irregular vertices, boundary and triangles closes for every sample, and is what the elements say.
// QMCF is the program.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { after, before, test } from 'node:test';

import { countLedger, ledgerFault, readElements } from '../tools/lib/ledger.mjs';

const program = process.env.QMCF && resolve(process.env.QMCF);
const samples = join(import.meta.dirname, '../../samples');
const parts = readdirSync(samples).filter((name) => /\.(obj|stl|ply)$/.test(name));
let folder;

before(() => {
  assert.ok(program, 'set QMCF to the program');
  folder = mkdtempSync(join(tmpdir(), 'qmcf-ledger-'));
});
after(() => rmSync(folder, { recursive: true, force: true }));

for (const part of parts) {
  for (const options of [[], ['--mode', 'qmorph'], ['--all-quad']]) {
    test(`${part} ${options.join(' ')}`, () => {
      const args = ['mesh', join(samples, part), '-o', 'mesh.obj', '--report', 'mesh.json', '--quads', '400', '--quiet', ...options];
      const { status, stderr } = spawnSync(program, args, { cwd: folder, encoding: 'utf8' });
      assert.equal(status, 0, stderr);
      const { quality } = JSON.parse(readFileSync(join(folder, 'mesh.json'), 'utf8'));
      const elements = readElements(join(folder, 'mesh.obj'));
      assert.equal(ledgerFault(quality, elements), null);
      const triangle = elements[0].slice(0, 3);
      assert.notEqual(ledgerFault(quality, [...elements, triangle]), null, 'another triangle is another mesh');
    });
  }
}

test('the count knows a cube, a triangle more, and three sheets along an edge', () => {
  const cube = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
  assert.deepEqual(countLedger(cube), { interiorIndex: 8, boundaryIndex: 0, triangles: 0, sum: 8, fourEuler: 8 });
  const cut = [[0, 3, 2], [0, 2, 1], ...cube.slice(1)];
  assert.deepEqual(countLedger(cut), { interiorIndex: 6, boundaryIndex: 0, triangles: 2, sum: 8, fourEuler: 8 });
  const fan = [[0, 1, 2, 3], [0, 1, 4, 5], [0, 1, 6, 7]];
  assert.deepEqual(countLedger(fan), { interiorIndex: 0, boundaryIndex: 12, triangles: 0, sum: 12, fourEuler: 12 });
});
