// Files that can't be used are told in one sentence, the command line's, and cost nothing.
import { readFileSync, writeFileSync } from 'node:fs';
import { expect, test } from '@playwright/test';
import { App, native, sample } from './page.js';

const files: Record<string, string | Buffer> = {
  'empty.obj': '',
  'truncated.stl': readFileSync(sample('plate_with_holes.stl')).subarray(0, 4000),
  'index.obj': 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n',
  'nan.obj': 'v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n',
  'page.obj': '<html>no mesh</html>',
  'point.obj': 'v 0 0 0\nf 1 1 1\n',
};

for (const [name, content] of Object.entries(files)) {
  test(`${name} shows its message`, async ({ page }, info) => {
    const path = info.outputPath(name);
    writeFileSync(path, content);
    const run = native('mesh', path, '-o', info.outputPath('never.obj'), '--quiet');
    expect(run.status).toBe(3);
    const sentence = run.stderr.trim().replace(`qmcf: ${path}: `, '');
    await page.goto('./');
    const app = new App(page);
    await app.open(path);
    await expect(app.alert).toContainText(`${name} can't be used`);
    await expect(app.alert).toContainText(sentence);
  });
}

test('a long file name stays within the panel', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('cylinder.obj');
  const name = `${'no_blank_to_break_at_'.repeat(4)}.obj`;
  await app.open({ name, mimeType: 'text/plain', buffer: Buffer.from('f 1 2 3\n') });
  await expect(app.status).toContainText(name);
  for (const text of [app.status, app.alert]) {
    const [needed, room] = await text.evaluate((element) => [element.scrollWidth, element.clientWidth]);
    expect(needed).toBeLessThanOrEqual(room!);
  }
});

test('the part that was open stays open', async ({ page }, info) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('cylinder.obj');
  await app.mesh(300);
  const path = info.outputPath('broken.obj');
  writeFileSync(path, files['nan.obj']!);
  await app.open(path);
  await expect(app.alert).toContainText("broken.obj can't be used");
  await expect(page.getByRole('heading', { name: 'cylinder.obj' })).toBeVisible();
  await expect(page.getByRole('region', { name: 'Result' })).toContainText('Valid:');
  await page.getByRole('button', { name: 'Close message' }).click();
  await expect(app.alert).toBeEmpty();
  await app.mesh(500);
});
