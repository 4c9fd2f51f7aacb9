// The whole way through the page: open, look, mesh, download; and the file that comes out is right.
import { readFileSync } from 'node:fs';
import { expect, test } from '@playwright/test';
import { App, holdWorker, native, sample } from './page.js';

test('a part becomes a valid mesh, the same as from the command line', async ({ page }, info) => {
  const errors: string[] = [];
  page.on('pageerror', (error) => errors.push(error.message));
  page.on('console', (message) => void (message.type() === 'error' && errors.push(message.text())));
  await page.goto('./');
  const app = new App(page);
  await app.openSample('plate_with_holes.stl');
  const ofPart = await app.picture();

  await app.crosses.check();
  await expect(app.status).toHaveText(/Cross field with \d+ singularit/);
  await app.expectChange(ofPart);
  const ofField = await app.picture();
  // The plate has six holes through it, so its Euler characteristic is 2 - 2 * 6 = -10. Every singularity of the field and
  // every corner of the part takes part in that sum; what can be told here is that free and pinned crosses are counted.
  expect(await app.legend('Pinned crosses')).toBeGreaterThan(100);
  expect(await app.legend('Free crosses')).toBeGreaterThan(100);

  await app.mesh(1500);
  await app.expectChange(ofField);
  const result = page.getByRole('region', { name: 'Result' });
  await expect(result).toContainText('Valid:');

  const saved = page.waitForEvent('download');
  await app.download.click();
  const download = await saved;
  expect(download.suggestedFilename()).toBe('plate_with_holes-quads.obj');
  const path = info.outputPath('downloaded.obj');
  await download.saveAs(path);
  const check = native('check', path, '--ref', sample('plate_with_holes.stl'));
  expect(check.status, check.stdout + check.stderr).toBe(0);

  const fromCommandLine = info.outputPath('native.obj');
  native('mesh', sample('plate_with_holes.stl'), '-o', fromCommandLine, '--quads', '1500', '--quiet');
  expect(readFileSync(path).equals(readFileSync(fromCommandLine))).toBe(true);
  expect(errors).toEqual([]);
});

test('what a mesh is said to be stays said when the field follows its size', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('torus.obj');
  await app.crosses.check();
  await expect(app.status).toHaveText(/Cross field with \d+ singularit/);
  const free = await app.legend('Free crosses');
  await app.mesh(600);
  // The field of the new size has another number of crosses.
  await expect.poll(() => app.legend('Free crosses')).not.toBe(free);
  await expect(app.status).toHaveText(/ quads? .*in .* s\.$/);
});

test('size and count follow each other, and the size asked for is the size used', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('torus.obj');
  const size = Number(await app.size.inputValue());
  await app.size.fill(String(2 * size));
  await expect(app.count).toHaveValue('750');
  await app.count.fill('12000');
  expect(Number(await app.size.inputValue())).toBeCloseTo(size / 2, 3);
  await app.size.fill(String(2 * size));
  await app.generate.click();
  await expect(app.status).toHaveText(/^\d{3} quads/);
});

test('the feature angle decides which edges there are', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('cylinder.obj');
  expect(await app.legend('Sharp edges')).toBe(2);
  await page.getByText('Features and directions').click();
  await page.getByLabel('Feature angle').fill('120');
  await expect(page.getByRole('list', { name: 'Legend' })).toBeHidden();
});

test('what is changed while another part opens stays changed', async ({ page }) => {
  const worker = await holdWorker(page);
  await page.goto('./');
  const app = new App(page);
  await app.openSample('cylinder.obj');
  await page.getByText('Features and directions').click();
  await worker.hold();
  await app.open(sample('capsule.obj'));
  await expect(app.cancel).toBeVisible();
  await page.getByLabel('Quadrilaterals only').check();
  await page.getByLabel('Gradation').fill('0.5');
  await app.count.fill('700');
  await worker.release();
  await expect(app.status).toHaveText('capsule.obj is open.');
  await expect(page.getByLabel('Quadrilaterals only')).toBeChecked();
  await expect(page.getByLabel('Gradation')).toHaveValue('0.5');
  await app.count.blur();
  await expect(app.count).toHaveValue('700');
});

test('the less the size may grow, the more elements there are', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('varying.stl');
  await page.getByText('Features and directions').click();
  const result = page.getByRole('region', { name: 'Result' });
  const counts: number[] = [];
  for (const gradation of ['0.05', '0.2', '1']) {
    await page.getByLabel('Gradation').fill(gradation);
    await app.size.fill('8');
    await app.generate.click();
    await expect(app.status).toHaveText(/ quads? .*in .* s\.$/);
    counts.push(Number((await result.locator('.headline dd').first().innerText()).replaceAll(',', '')));
  }
  expect(counts[0]).toBeGreaterThan(counts[1]!);
  expect(counts[1]).toBeGreaterThan(counts[2]!);
});

test('a chord error makes smaller elements on curved faces, until it is cleared', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('capsule.obj');
  const result = page.getByRole('region', { name: 'Result' });
  const counts: number[] = [];
  for (const chordError of ['', '0.1', '']) {
    await page.getByLabel('Chord error').fill(chordError);
    await app.size.fill('8');
    await app.generate.click();
    await expect(app.status).toHaveText(/ quads? .*in .* s\.$/);
    counts.push(Number((await result.locator('.headline dd').first().innerText()).replaceAll(',', '')));
  }
  expect(counts[1]).toBeGreaterThan(3 * counts[0]!);
  expect(counts[2]).toBe(counts[0]);
});

test('sizes fit the field for a count, and otherwise where that is asked for', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('wavy_sheet.obj');
  const result = page.getByRole('region', { name: 'Result' });
  const fit = page.getByLabel('Fit sizes to the field');
  const expectFitted = async (isOn: boolean) => {
    await app.generate.click();
    await expect(app.status).toHaveText(/ quads? .*in .* s\.$/);
    await expect(result.getByText('Sizes vary to fit the field.')).toHaveCount(isOn ? 1 : 0);
  };
  await app.count.fill('800');
  await expect(fit).toBeChecked();
  await expectFitted(true);
  await fit.uncheck();
  await expectFitted(false);
  await page.reload();
  await app.openSample('wavy_sheet.obj');
  await app.size.fill('4');
  await expect(fit).not.toBeChecked();
  await expectFitted(false);
  await fit.check();
  await expectFitted(true);
  // The original has no field that sizes could fit.
  await page.getByText('Features and directions').click();
  await page.getByLabel('Advancing front').selectOption('qmorph');
  await expect(fit).toBeDisabled();
});

test('sizes at the vertices come from a file, until they are cleared or a count is asked for', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('capsule.obj');
  const vertices = readFileSync(sample('capsule.obj'), 'utf8').match(/^v /gm)!.length;
  const pick = (name: string, text: string) =>
    page.getByLabel('Sizes file', { exact: true }).setInputFiles({ name, mimeType: 'text/plain', buffer: Buffer.from(text) });
  await pick('broken.txt', '3\n2\nno\n');
  await expect(app.alert).toContainText('Line 3');
  await pick('few.txt', '3\n2\n');
  await app.generate.click();
  await expect(app.alert).toContainText(`${vertices} vertices, not 2`);
  await pick('sizes.txt', '4\n'.repeat(vertices));
  await app.generate.click();
  await expect(app.status).toHaveText(/ quads? .*in .* s\.$/);
  // The area is 2 pi 12 * 60.
  const result = page.getByRole('region', { name: 'Result' });
  const count = Number((await result.locator('.headline dd').first().innerText()).replaceAll(',', ''));
  expect(Math.abs(count / 283 - 1)).toBeLessThan(0.25);
  await page.getByRole('button', { name: 'Clear sizes file' }).click();
  await expect(page.getByRole('button', { name: 'Clear sizes file' })).toBeHidden();
  await app.mesh(600);
});

test('non-manifold edges and open boundaries are told apart', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await page.getByRole('button', { name: 'Two sheets in a T' }).click();
  await expect(app.status).toHaveText('t_sheets.obj is open.');
  expect(await app.legend('Non-manifold edges')).toBe(1);
  expect(await app.legend('Open boundary')).toBeGreaterThan(5);
});

test('a mesh can be made and saved where nothing can be drawn', async ({ page }) => {
  await page.addInitScript(() => {
    HTMLCanvasElement.prototype.getContext = () => null;
  });
  await page.goto('./');
  const app = new App(page);
  await expect(app.alert).toContainText('This browser can not draw in three dimensions');
  await app.openSample('cylinder.obj');
  await app.mesh(300);
  await page.getByRole('button', { name: 'Worst element' }).click();
  await expect(page.getByRole('group', { name: 'Chosen' })).toContainText(/Element \d+/);
  const saved = page.waitForEvent('download');
  await app.download.click();
  expect((await saved).suggestedFilename()).toBe('cylinder-quads.obj');
});

test('a file can be dropped on the page', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  const transfer = await page.evaluateHandle((content) => {
    const data = new DataTransfer();
    data.items.add(new File([content], 'dropped.obj'));
    return data;
  }, readFileSync(sample('cylinder.obj'), 'utf8'));
  await page.dispatchEvent('body', 'dragenter', { dataTransfer: transfer });
  await expect(page.getByText('Drop to open')).toBeVisible();
  await page.dispatchEvent('body', 'drop', { dataTransfer: transfer });
  await expect(app.status).toHaveText('dropped.obj is open.');
  await expect(page.getByText('Drop to open')).toBeHidden();
});

/** How a file of each format begins or what it must hold. */
const signs: Record<string, RegExp> = {
  obj: /^f \d+ \d+ \d+ \d+$/m,
  vtu: /<VTKFile type="UnstructuredGrid"/,
  ply: /^ply\n/,
  stl: /^[^]{84}/,
  msh: /^\$MeshFormat\n4\.1 /,
  inp: /\*ELEMENT, *TYPE=S4/i,
  bdf: /^CQUAD4/m,
};

test('every format can be downloaded, and is what its name says', async ({ page }, info) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('cylinder.obj');
  await app.mesh(300);
  const formats = page.getByLabel('File format');
  const names = await formats.locator('option').evaluateAll((all) => all.map((o) => (o as HTMLOptionElement).value));
  expect(names.sort()).toEqual(Object.keys(signs).sort());
  for (const name of names) {
    await formats.selectOption(name);
    const saved = page.waitForEvent('download');
    await app.download.click();
    const download = await saved;
    expect(download.suggestedFilename()).toBe(`cylinder-quads.${name}`);
    const path = info.outputPath(`mesh.${name}`);
    await download.saveAs(path);
    expect(readFileSync(path, 'latin1')).toMatch(signs[name]!);
    if (['obj', 'ply'].includes(name)) {
      expect(native('check', path, '--ref', sample('cylinder.obj')).status).toBe(0);
    }
  }
});
