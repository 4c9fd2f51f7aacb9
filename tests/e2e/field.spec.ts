// The cross field on the page: crosses or lines, singularities by index, and what pins the field.
import { expect, test } from '@playwright/test';
import { App } from './page.js';

async function openField(app: App, file: string): Promise<void> {
  await app.page.goto('./');
  await app.openSample(file);
  await app.crosses.check();
  await expect(app.status).toHaveText(/Cross field with \d+ singularit/);
}

test('the singularities of a sphere-like part have the index sum 8', async ({ page }) => {
  const app = new App(page);
  await openField(app, 'capsule.obj');
  const rows = page.getByRole('list', { name: 'Legend' }).getByRole('listitem').filter({ hasText: 'Singularity' });
  let sum = 0;
  for (const text of await rows.allInnerTexts()) {
    const [, sign, index, quads, amount] = /([+−])(\d) \((\d) quads\)\s*([\d,]+)/.exec(text)!;
    const turns = Number(index) * (sign === '+' ? 1 : -1);
    expect(Number(quads)).toBe(4 - turns);
    sum += turns * Number(amount!.replaceAll(',', ''));
  }
  expect(sum).toBe(8);
});

test('pins are told apart by what pins them', async ({ page }) => {
  const app = new App(page);
  await openField(app, 'cylinder.obj');
  const [pinned, free] = [await app.legend('Pinned crosses'), await app.legend('Free crosses')];
  const before = await app.picture();
  await page.getByLabel('Constraints').check();
  await app.expectChange(before);
  const byKind = [await app.legend('Pinned to sharp edges'), await app.legend('Pinned to curvature')];
  // Both circles, each as the border of two faces.
  expect(byKind[0]).toBeGreaterThan(4 * 8);
  expect(byKind[0]! + byKind[1]!).toBe(pinned);
  expect(await app.legend('Free crosses')).toBe(free);
  expect(await app.legend('Pins taken back')).toBeLessThanOrEqual(free);

  await page.getByText('Features and directions').click();
  await page.getByLabel('Sharp edges').uncheck();
  await expect(page.getByRole('list', { name: 'Legend' })).not.toContainText('Pinned to sharp edges');
  expect(await app.legend('Free crosses')).toBe(pinned + free - (await app.legend('Pinned to curvature')));
});

test('streamlines take the place of crosses', async ({ page }) => {
  const app = new App(page);
  await openField(app, 'torus.obj');
  const crosses = await app.picture();
  await page.getByLabel('Streamlines').check();
  await app.expectChange(crosses);
  expect(await app.legend('Streamlines')).toBeGreaterThan(20);
  const lines = await app.picture();
  await page.getByLabel('Streamlines').uncheck();
  await app.expectChange(lines);
  await app.crosses.uncheck();
  await expect(page.getByLabel('Streamlines')).toBeHidden();
});
