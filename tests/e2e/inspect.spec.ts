// What is known of the part: faces and edges under the pointer or by number, and what was repaired.
import { writeFileSync } from 'node:fs';
import { expect, test } from '@playwright/test';
import { App, native } from './page.js';

/** The page's figure with this label on the card of what was chosen. */
async function chosen(app: App, label: string): Promise<string> {
  const card = app.page.getByRole('group', { name: 'Chosen' });
  return card.locator(`dt:text-is("${label}") + dd`).innerText();
}

test('faces and edges are told by pointer, click and number', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('cylinder.obj');
  const before = await app.picture();
  const face = await app.pointAt(/^Face \d/);
  await app.expectChange(before);
  const edge = await app.pointAt(/^Edge \d/);
  expect(edge).toContain('sharp edge, closed');

  await page.mouse.down();
  await page.mouse.up();
  const card = page.getByRole('group', { name: 'Chosen' });
  await expect(card).toContainText(edge.split('\n')[0]!);
  await expect(page.getByLabel('Look up')).toHaveValue('edge');
  await page.keyboard.press('Escape');
  await expect(card).toBeHidden();
  expect(face).toMatch(/Type\s+(flat|curved)/);
});

test('the faces and edges of a cylinder have its sizes', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('cylinder.obj');
  const [radius, height] = [10, 40];
  const areas: Record<string, number[]> = { flat: [], curved: [] };
  for (const id of ['0', '1', '2']) {
    await page.getByLabel('Its number').fill(id);
    await expect(page.getByRole('group', { name: 'Chosen' })).toContainText(`Face ${id}`);
    areas[await chosen(app, 'Type')]!.push(Number(await chosen(app, 'Area')));
  }
  // Inscribed polygons are a little smaller than the circles.
  expect(areas['flat']).toHaveLength(2);
  for (const area of areas['flat']!) {
    expect(area / (Math.PI * radius ** 2)).toBeGreaterThan(0.97);
    expect(area).toBeLessThan(Math.PI * radius ** 2);
  }
  expect(areas['curved']).toHaveLength(1);
  expect(areas['curved']![0]! / (2 * Math.PI * radius * height)).toBeCloseTo(1, 1);

  await page.getByLabel('Look up').selectOption('edge');
  await page.getByLabel('Its number').fill('1');
  expect(Number(await chosen(app, 'Length')) / (2 * Math.PI * radius)).toBeCloseTo(1, 1);
  expect((await chosen(app, 'Faces')).split(', ')).toHaveLength(2);
  await page.getByLabel('Its number').fill('2');
  await expect(page.getByRole('group', { name: 'Chosen' })).toBeHidden();
});

test('a mesh keeps the faces and edges that it was made of', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('cylinder.obj');
  await app.mesh(300);
  const [number, card] = [page.getByLabel('Its number'), page.getByRole('group', { name: 'Chosen' })];
  const angle = page.getByLabel('Feature angle');
  await number.fill('2');
  await expect(card).toContainText('Face 2');
  await page.getByText('Features and directions').click();
  await angle.fill('120');
  await expect(app.status).toHaveText('Edges found again.');
  await expect(page.getByText('The settings have changed since this mesh was made.')).toBeVisible();
  // The mesh is still one of three faces, the part has one.
  await expect(card).toContainText('Face 2');
  expect(await chosen(app, 'Meshed')).toMatch(/quads/);
  await expect(number).toHaveAttribute('placeholder', 'number, 0 to 2');
  await page.getByRole('button', { name: 'Part', exact: true }).click();
  await expect(card).toBeHidden();
  await expect(number).toHaveAttribute('placeholder', 'number, 0 to 0');

  // A mesh that is asked for at once, before the part at the new angle is there.
  await angle.fill('30');
  await app.generate.click();
  await expect(app.status).toHaveText(/ quads? .*in .* s\.$/);
  await expect(number).toHaveAttribute('placeholder', 'number, 0 to 2');
  await page.getByRole('button', { name: 'Part', exact: true }).click();
  await expect(number).toHaveAttribute('placeholder', 'number, 0 to 2');
});

test('a number that can not be is told to be wrong, until it is right', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('cylinder.obj');
  await page.getByText('Features and directions').click();
  for (const [input, wrong, right] of [
    [page.getByLabel('Feature angle'), '200', '40'],
    [page.getByLabel('Its number'), '3', '2'],
  ] as const) {
    await input.fill(wrong);
    await expect(input).toHaveAttribute('aria-invalid', 'true');
    await input.fill(right);
    await expect(input).not.toHaveAttribute('aria-invalid');
  }
});

test('every repair is listed with its count, as by the command line', async ({ page }, info) => {
  const path = info.outputPath('dirty.obj');
  const points = '0 0 0|1 0 0|1 1 0|0 1 0|0 0 0|2 0 0|2 1 0'.split('|').map((p) => `v ${p}`);
  const faces = '1 2 3|5 3 4|1 2 3|2 2 3|2 6 7|7 2 3'.split('|').map((f) => `f ${f}`);
  writeFileSync(path, [...points, ...faces, ''].join('\n'));
  const lines = native('info', path).stdout.match(/^Repair .*$/gm)!.map((line) => /Repair +(.*): (\d+) (.*)/.exec(line)!);
  expect(lines).toHaveLength(4);
  await page.goto('./');
  const app = new App(page);
  await app.open(path);
  await expect(app.status).toHaveText('dirty.obj is open.');
  await page.getByText('What was repaired').click();
  const rows = page.getByRole('region', { name: 'Model' }).getByRole('row');
  await expect(rows).toHaveCount(lines.length);
  for (const [i, [, defect, count, action]] of lines.entries()) {
    await expect(rows.nth(i).getByRole('cell').first()).toHaveText(count!);
    await expect(rows.nth(i).getByRole('rowheader')).toContainText(defect!);
    await expect(rows.nth(i).getByRole('rowheader')).toContainText(action!);
  }
});

test('faces that touch have different colours', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('plate_with_holes.stl');
  const colored = await app.picture();
  await page.getByLabel('Face colours').uncheck();
  await app.expectChange(colored);
});

test('the colours of neighbours differ wherever there are colours enough', async () => {
  const { faceTints } = await import('../../web/src/viewer/tints.js');
  // A fan of ten faces around a point, and a strip.
  const fan = new Int32Array(Array.from({ length: 10 }, (_, i) => [0, i + 1, ((i + 1) % 10) + 1]).flat());
  expect(new Set(faceTints(fan, 3, new Int32Array(10).map((_, i) => i), 10)).size).toBe(10);
  const strip = new Int32Array(Array.from({ length: 99 }, (_, i) => [i, i + 1, i + 2]).flat());
  const tints = faceTints(strip, 3, new Int32Array(99).map((_, i) => i), 99);
  for (let i = 0; i + 2 < tints.length; ++i) {
    expect(new Set(tints.subarray(i, i + 3)).size).toBe(3);
  }
});

test('a ray finds the first triangle', async () => {
  const { SurfacePicker } = await import('../../web/src/viewer/surface_picker.js');
  const { Ray, Vector3 } = await import('three');
  // Two hundred squares in planes z = 0 to 199, each of two triangles.
  const corners: number[] = [];
  const positions: number[] = [];
  for (let z = 0; z < 200; ++z) {
    const first = positions.length / 3;
    positions.push(0, 0, z, 1, 0, z, 1, 1, z, 0, 1, z);
    corners.push(first, first + 1, first + 2, first, first + 2, first + 3);
  }
  const picker = new SurfacePicker(new Float32Array(positions), corners);
  const down = (x: number, y: number, from: number) => picker.pick(new Ray(new Vector3(x, y, from), new Vector3(0, 0, -1)));
  expect(down(0.7, 0.2, 300)).toEqual({ triangle: 398, distance: 101 });
  expect(down(0.2, 0.7, 300)).toEqual({ triangle: 399, distance: 101 });
  expect(down(0.2, 0.7, 50.5)).toEqual({ triangle: 101, distance: 0.5 });
  expect(down(1.2, 0.7, 300)).toBeUndefined();
});
