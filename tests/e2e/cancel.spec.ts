// A run can be stopped at any time, and everything goes on as before.
import { expect, test } from '@playwright/test';
import { isolatedPage, plainPage } from '../../playwright.config.js';
import { App } from './page.js';

for (const [name, url, isolated] of [
  ['through shared memory', isolatedPage, true],
  ['without shared memory', plainPage, false],
] as const) {
  test(`a run is cancelled in the middle ${name}, and the next one works`, async ({ page }) => {
    await page.goto(url);
    expect(await page.evaluate(() => crossOriginIsolated)).toBe(isolated);
    const app = new App(page);
    await app.openSample('stepped_shaft.stl');
    await app.mesh(400);
    const headline = page.getByRole('region', { name: 'Result' }).locator('dl');
    const before = await headline.innerText();

    await app.count.fill('300000');
    await app.generate.click();
    await expect(page.getByRole('progressbar')).toBeVisible();
    await expect(app.status).toHaveText('Triangulating the faces…');
    await page.getByLabel('Face colours').uncheck();
    await expect(app.generate).toBeHidden();
    await app.cancel.click();
    await expect(app.status).toHaveText('Cancelled.');
    await expect(app.cancel).toBeHidden();
    // The last good result is still there, and can still be saved.
    expect(await headline.innerText()).toBe(before);
    const saved = page.waitForEvent('download');
    await app.download.click();
    await saved;

    await app.mesh(600);
    expect(await headline.innerText()).not.toBe(before);
  });
}

test('another part can be opened while one is meshed', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('stepped_shaft.stl');
  await app.count.fill('300000');
  await app.generate.click();
  await expect(page.getByRole('progressbar')).toBeVisible();
  await app.openSample('cylinder.obj');
  await app.mesh(300);
});

test('a sample that does not arrive can be given up', async ({ page }) => {
  await page.route('**/*cylinder*.obj', () => {});
  await page.goto('./');
  const app = new App(page);
  await page.getByRole('button', { name: 'Cylinder' }).first().click();
  await app.cancel.click();
  await expect(app.cancel).toBeHidden({ timeout: 10_000 });
  await expect(app.alert).toBeEmpty();
  await app.openSample('torus.obj');
});

test('a field that is cancelled is no longer asked for', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('stepped_shaft.stl');
  await app.count.fill('300000');
  await app.crosses.check();
  await app.cancel.click();
  await expect(app.status).toHaveText('Cancelled.');
  await expect(app.crosses).not.toBeChecked();
  await app.count.fill('500');
  await app.crosses.check();
  await expect(app.status).toHaveText(/Cross field with/);
});
