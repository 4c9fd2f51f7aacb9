// The history of a mesh on the page: recorded, stepped through, played.
import { expect, test } from '@playwright/test';
import { App } from './page.js';

const numberIn = (text: string) => Number(text.replaceAll(/[^\d]/g, ''));

test('the front is recorded when asked for, and can be stepped through and played to its end', async ({ page }) => {
  const app = new App(page);
  await page.goto('./');
  await app.openSample('bracket_with_fillets.stl');
  await app.mesh(250);
  const front = page.getByRole('button', { name: 'Front', exact: true });
  await expect(front).toBeHidden();

  await page.getByText('Features and directions').click();
  await page.getByLabel('Record the front').check();
  await app.generate.click();
  const player = page.getByRole('region', { name: 'Front player' });
  await expect(player).toBeVisible();
  await expect(front).toHaveAttribute('aria-pressed', 'true');
  const made = (await app.status.innerText()).replace(/ in .*/, '').split(' and ').map(numberIn);
  const total = made.reduce((sum, n) => sum + n, 0);

  const step = player.getByRole('slider', { name: 'Step' });
  const grown = player.locator('.grown');
  await expect(step).toHaveValue('0');
  await expect(grown).toHaveText('0 elements');
  const scene = () => app.canvas.screenshot({ style: '#app > :not(canvas) { visibility: hidden !important }' });
  // Where the camera looks settles when the player has its room.
  let start = await scene();
  await expect.poll(async () => start.equals((start = await scene()))).toBe(true);
  const empty = await app.picture();
  await player.getByRole('button', { name: 'One step forward' }).click();
  await expect(step).toHaveValue('1');
  await app.expectChange(empty);
  expect(numberIn(await grown.innerText())).toBeGreaterThan(0);
  await step.press('ArrowRight');
  await expect(step).toHaveValue('2');
  await player.getByRole('button', { name: 'One step back' }).click();
  await player.getByRole('button', { name: 'One step back' }).click();
  await expect(grown).toHaveText('0 elements');
  // The front before the first step is there from the beginning.
  await expect.poll(async () => (await scene()).equals(start)).toBe(true);
  await player.getByRole('button', { name: 'Next event' }).click();
  expect(Number(await step.inputValue())).toBeGreaterThan(0);

  // At the end all faces have the elements of the mesh, and going back and forth changes nothing.
  await step.press('End');
  await expect(grown).toHaveText(`${total} elements`);
  await step.press('Home');
  await expect(grown).toHaveText('0 elements');
  await step.press('End');
  await expect(grown).toHaveText(`${total} elements`);

  const faces = player.getByRole('combobox', { name: 'Face' });
  let sum = 0;
  const ids = (await faces.locator('option').evaluateAll((all) => all.map((o) => (o as HTMLOptionElement).value))).slice(1);
  expect(ids.length).toBeGreaterThan(3);
  for (const id of ids) {
    await faces.selectOption(id);
    await step.press('End');
    sum += numberIn(await grown.innerText());
  }
  expect(sum).toBe(total);

  await step.press('Home');
  await player.getByRole('combobox', { name: 'Steps' }).selectOption('300');
  await player.getByRole('button', { name: 'Play' }).press('Enter');
  await expect(step).toHaveValue((await step.getAttribute('max'))!);
  await expect(player.getByRole('button', { name: 'Play' })).toBeVisible();

  await page.getByRole('button', { name: 'Mesh', exact: true }).click();
  await expect(player).toBeHidden();
});

test.describe('on a phone', () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true });

  test('the player has room above the sheet', async ({ page }) => {
    const app = new App(page);
    await page.goto('./');
    await app.openSample('cylinder.obj');
    const sheet = page.getByRole('button', { name: 'Show all settings' });
    await sheet.tap();
    await page.getByText('Features and directions').tap();
    await page.getByLabel('Record the front').check();
    await sheet.tap();
    await app.generate.tap();
    const player = page.getByRole('region', { name: 'Front player' });
    await expect(player.getByRole('button', { name: 'Play' })).toBeInViewport({ ratio: 1 });
    await player.getByRole('button', { name: 'One step forward' }).tap();
    await expect(player.getByRole('slider', { name: 'Step' })).toHaveValue('1');
    const [card, panel] = [(await player.boundingBox())!, (await page.getByRole('complementary').boundingBox())!];
    expect(card.y + card.height).toBeLessThanOrEqual(panel.y);
    const [scrolled, width] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    expect(scrolled).toBeLessThanOrEqual(width);
  });
});
