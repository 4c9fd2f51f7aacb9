// The page on a phone, and by keyboard.
import { expect, test } from '@playwright/test';
import { App, sample } from './page.js';

test.describe('on a phone', () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true });

  test('the whole way works with nothing cut off', async ({ page }) => {
    await page.goto('./');
    const app = new App(page);
    await page.getByRole('button', { name: 'Cylinder', exact: false }).first().tap();
    await expect(app.status).toHaveText('cylinder.obj is open.');
    await app.crosses.check();
    await expect(app.status).toHaveText(/Cross field with/);
    await page.getByRole('button', { name: 'Show all settings' }).tap();
    await app.count.fill('400');
    await page.getByRole('button', { name: 'Show all settings' }).tap();
    await app.generate.tap();
    await expect(app.download).toBeVisible();
    for (const control of [app.generate, app.download, app.crosses]) {
      await expect(control).toBeInViewport({ ratio: 1 });
    }
    const [scrolled, width] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    expect(scrolled).toBeLessThanOrEqual(width);
    // The part is seen above the sheet.
    const sheet = await page.getByRole('complementary').boundingBox();
    expect(sheet!.y).toBeGreaterThan(450);

    // A tap on it tells what is there, above the sheet; the worst element is found from the sheet.
    const card = page.getByRole('region', { name: 'Selection' });
    await page.touchscreen.tap(195, (66 + sheet!.y) / 2);
    await expect(card).toContainText(/Element \d+/);
    await expect(card).toBeInViewport({ ratio: 1 });
    const below = (await card.boundingBox())!;
    expect(below.y + below.height).toBeLessThanOrEqual(sheet!.y);
    await page.getByRole('button', { name: 'Show all settings' }).tap();
    await page.getByRole('button', { name: 'Worst element' }).tap();
    await expect(page.getByRole('button', { name: 'Show all settings' })).toHaveAttribute('aria-expanded', 'false');
    await expect(card).toBeInViewport({ ratio: 1 });
  });
});

test('everything can be reached by keyboard', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.open(sample('cylinder.obj'));
  await expect(app.status).toHaveText('cylinder.obj is open.');
  const reached: string[] = [];
  for (let i = 0; i < 40; ++i) {
    await page.keyboard.press('Tab');
    reached.push(
      await page.evaluate(() => {
        const control = document.activeElement as HTMLInputElement | null;
        return control?.getAttribute('aria-label') ?? control?.labels?.[0]?.innerText ?? control?.innerText ?? '';
      }),
    );
  }
  for (const name of ['Open model', 'Element size', 'Number of quads', 'Generate mesh', 'Show cross field', 'Look up', 'Its number']) {
    expect(reached, reached.join(' | ')).toContainEqual(expect.stringContaining(name));
  }
});
