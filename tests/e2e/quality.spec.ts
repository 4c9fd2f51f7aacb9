// The quality of a mesh on the page: colours, histogram, the worst element, and how each face was meshed.
import { readFileSync } from 'node:fs';
import { expect, test } from '@playwright/test';
import { App, native, sample } from './page.js';

test('the worst element is found, told and looked at', async ({ page }, info) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('plate_with_holes.stl');
  await app.mesh(600);
  const saved = page.waitForEvent('download');
  await app.download.click();
  const path = info.outputPath('mesh.obj');
  await (await saved).saveAs(path);
  const quality = JSON.parse(native('check', path, '--json').stdout) as Record<string, { worst: number | null }>;
  const worst = Math.min(quality['scaledJacobian']!.worst!, quality['triangleScaledJacobian']!.worst ?? 1);

  const before = await app.picture();
  await page.getByRole('button', { name: 'Worst element' }).click();
  await app.expectChange(before);
  const card = page.getByRole('group', { name: 'Chosen' });
  await expect(card).toContainText(/Element \d+/);
  expect(Number(await card.locator('dt:text-is("Scaled Jacobian") + dd').innerText())).toBeCloseTo(worst, 3);
  // It is in the middle of what is free, so that is what a click there chooses.
  const title = await card.locator('strong').innerText();
  await page.getByRole('button', { name: 'Choose nothing' }).click();
  await expect(card).toBeHidden();
  const { width, height } = page.viewportSize()!;
  const left = (await page.getByRole('complementary').boundingBox())!;
  const top = (await page.getByRole('group', { name: 'View' }).boundingBox())!;
  await page.mouse.click((left.x + left.width + width) / 2, (top.y + top.height + height) / 2);
  await expect(card.locator('strong')).toHaveText(title);
});

test('the histogram counts every element, and triangles are marked', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('varying.stl');
  await app.mesh(700);
  const result = page.getByRole('region', { name: 'Result' });
  const [quads, triangles] = (await result.locator('.headline dd').allInnerTexts()).map((text) => Number(text.replaceAll(',', '')));
  const bars = result.getByRole('img', { name: 'Distribution of the scaled Jacobian' }).locator('i');
  const counts = await bars.evaluateAll((all) => all.map((bar) => Number(/: ([\d,]+) element/.exec((bar as HTMLElement).title)![1]!.replaceAll(',', ''))));
  expect(counts.reduce((sum, amount) => sum + amount, 0)).toBe(quads! + triangles!);
  const before = await app.picture();
  await page.getByLabel('Colour by quality').check();
  await app.expectChange(before);
  const rows = page.getByRole('list', { name: 'Legend' }).getByRole('listitem').filter({ hasText: 'Triangles' });
  if (triangles! > 0) {
    expect(await app.legend('Triangles')).toBe(triangles);
  } else {
    await expect(rows).toHaveCount(0);
  }
});

test('what was not measured is a dash, not a number', async () => {
  const format = await import('../../web/src/format.js');
  expect([format.percent(null), format.figure(null), format.percent(undefined)]).toEqual(['–', '–', '–']);
  expect([format.percent(0), format.figure(0)]).toEqual(['0.0 %', '0.000']);
});

test('the original Q-Morph can be compared with', async ({ page }, info) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('cylinder.obj');
  await page.getByText('Features and directions').click();
  await page.getByLabel('Advancing front').selectOption('qmorph');
  await app.mesh(400);
  await expect(page.getByRole('region', { name: 'Result' })).toContainText('All 3 faces were meshed by the original Q-Morph.');
  const saved = page.waitForEvent('download');
  await app.download.click();
  const path = info.outputPath('page.obj');
  await (await saved).saveAs(path);
  const reference = info.outputPath('native.obj');
  native('mesh', sample('cylinder.obj'), '-o', reference, '--quads', '400', '--mode', 'qmorph', '--quiet');
  expect(readFileSync(path).equals(readFileSync(reference))).toBe(true);
  await page.getByLabel('Advancing front').selectOption('qmcf');
  await expect(page.getByText('The settings have changed since this mesh was made.')).toBeVisible();
});

test('triangles become quads where there shall be no others', async ({ page }, info) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('plate_with_holes.stl');
  await app.mesh(800);
  const result = page.getByRole('region', { name: 'Result' });
  await expect(result).toContainText(/quads[1-9]\d*triangles/);
  await page.getByText('Features and directions').click();
  await page.getByLabel('Quadrilaterals only').check();
  await expect(page.getByText('The settings have changed since this mesh was made.')).toBeVisible();
  await app.mesh(800);
  await expect(result).toContainText('quads0triangles');
  const saved = page.waitForEvent('download');
  await app.download.click();
  const path = info.outputPath('page.obj');
  await (await saved).saveAs(path);
  const reference = info.outputPath('native.obj');
  native('mesh', sample('plate_with_holes.stl'), '-o', reference, '--quads', '800', '--all-quad', '--quiet');
  expect(readFileSync(path).equals(readFileSync(reference))).toBe(true);
});

test('the report says how the faces were meshed, and an element says on which face it lies', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('stepped_shaft.stl');
  const facts = await page.getByRole('region', { name: 'Model' }).locator('.facts').innerText();
  const faces = Number(/([\d,]+) faces/.exec(facts)![1]);
  await app.mesh(500);
  const result = page.getByRole('region', { name: 'Result' });
  await expect(result).toContainText(new RegExp(`All ${faces} faces were meshed along the cross field|of ${faces} faces meshed by a fallback`));
  const element = await app.pointAt(/^Element \d/);
  expect(element).toMatch(/Type\s+(quad|triangle)\s+Scaled Jacobian\s+\d\.\d{3}\s+On\s+Face \d/);
});
