// What a person does on the page, in a real browser.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, test, type Page } from '@playwright/test';

const root = fileURLToPath(new URL('../..', import.meta.url));
const sample = (name: string) => `${root}samples/${name}`;
const native = `${root}build/native/bin/qmcf`;

async function open(page: Page, file: string | { name: string; mimeType: string; buffer: Buffer }): Promise<void> {
  await page.goto('/');
  await page.getByLabel('Open model').setInputFiles(file);
}

async function generate(page: Page): Promise<void> {
  await page.getByRole('button', { name: 'Generate mesh' }).click();
  await expect(page.getByRole('status')).toContainText(/\d quads?.* in /);
}

/** Number of distinct colours in the middle of the view: a blank canvas has one. */
async function coloursSeen(page: Page): Promise<number> {
  const png = await page.locator('canvas.viewport').screenshot();
  return new Set(png.subarray(100)).size;
}

test.beforeEach(({ page }) => {
  page.on('pageerror', (error) => {
    throw error;
  });
});

test('a part is opened, its field shown, meshed, downloaded, and the file is what the native program makes', async ({ page }) => {
  await open(page, sample('stepped_shaft.stl'));
  await expect(page.getByRole('status')).toContainText('stepped_shaft.stl is open');
  await expect.poll(() => coloursSeen(page)).toBeGreaterThan(100);

  await page.getByLabel('Show cross field').check();
  await expect(page.getByRole('status')).toContainText(/Cross field with \d+ singularit/);
  await expect(page.getByLabel('Legend')).toBeVisible();

  await page.getByLabel('Element size').fill('5');
  await page.getByLabel('Element size').press('Enter');
  await generate(page);
  await expect(page.getByText(/Valid: \d+ checks passed/)).toBeVisible();

  const downloading = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Download' }).click();
  const file = test.info().outputPath('page.obj');
  await (await downloading).saveAs(file);

  const verdict = JSON.parse(execFileSync(native, ['check', file, '--ref', sample('stepped_shaft.stl'), '--json'], { encoding: 'utf8' }));
  expect(verdict.valid).toBe(true);
  expect(verdict.quads).toBeGreaterThan(200);

  const reference = test.info().outputPath('native.obj');
  execFileSync(native, ['mesh', sample('stepped_shaft.stl'), '-o', reference, '--size', '5', '--quiet']);
  expect(readFileSync(file).equals(readFileSync(reference)), 'browser and native give the same bytes').toBe(true);
});

test('a run is cancelled in the middle and the next one finishes', async ({ page }) => {
  await open(page, sample('varying.stl'));
  await expect(page.getByRole('status')).toContainText('is open');
  await page.getByLabel('Element size').fill('0.35');
  await page.getByLabel('Element size').press('Enter');
  await page.getByRole('button', { name: 'Generate mesh' }).click();
  await expect(page.getByRole('progressbar', { name: 'Progress' })).toBeVisible();
  await page.getByRole('button', { name: 'Cancel' }).click();
  await expect(page.getByRole('status')).toContainText('Cancelled');
  await page.getByLabel('Element size').fill('4');
  await page.getByLabel('Element size').press('Enter');
  await generate(page);
});

const broken: readonly [name: string, content: string | Buffer, message: RegExp][] = [
  ['empty.obj', '', /empty|no bytes/i],
  ['index.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n', /line 4/i],
  ['nan.obj', 'v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n', /line 2/i],
  ['truncated.stl', readFileSync(sample('varying.stl')).subarray(0, 1000), /ends|truncated|announce/i],
];
for (const [name, content, message] of broken) {
  test(`${name} shows what is wrong with it and leaves the last part in place`, async ({ page }) => {
    await open(page, sample('wavy_sheet.obj'));
    await expect(page.getByRole('status')).toContainText('wavy_sheet.obj is open');
    await page.getByLabel('Open model').setInputFiles({ name, mimeType: 'application/octet-stream', buffer: Buffer.from(content) });
    await expect(page.getByRole('alert')).toContainText(message);
    await expect(page.getByRole('button', { name: 'Generate mesh' })).toBeEnabled();
    await generate(page);
  });
}

test('a phone shows the part and its controls', async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await open(page, sample('bracket_with_fillets.stl'));
  await expect(page.getByRole('status')).toContainText('is open');
  await generate(page);
  const overflow = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
  expect(overflow).toBe(0);
  await expect(page.getByRole('button', { name: 'Generate mesh' })).toBeInViewport();
});
