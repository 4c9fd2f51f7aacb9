// The viewport when the window changes: as sharp as the screen, and never empty.
import { expect, test } from '@playwright/test';
import { App } from './page.js';

test('the picture has the pixels of the screen when the page is zoomed or moved to another one', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('cylinder.obj');
  const pixels = () => app.canvas.evaluate((canvas: HTMLCanvasElement) => canvas.width / canvas.clientWidth);
  const client = await page.context().newCDPSession(page);
  for (const deviceScaleFactor of [2, 1.5, 1]) {
    // As by zooming: the same window has fewer CSS pixels.
    const [width, height] = [1440, 900].map((length) => Math.round(length / deviceScaleFactor)) as [number, number];
    await client.send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor, mobile: false });
    await expect.poll(pixels, { timeout: 10_000 }).toBeCloseTo(deviceScaleFactor, 2);
  }
});

test('the picture is there in every frame while the window changes its size', async ({ page }) => {
  await page.goto('./');
  const app = new App(page);
  await app.openSample('cylinder.obj');
  // Called after the page's own observer, before the frame is shown.
  await app.canvas.evaluate((canvas: HTMLCanvasElement) => {
    const seen: boolean[] = [];
    const observer = new ResizeObserver(() => {
      const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d')!;
      copy.drawImage(canvas, 0, 0);
      seen.push(copy.getImageData(0, 0, canvas.width, canvas.height).data.some((value) => value > 0));
    });
    observer.observe(canvas);
    Object.assign(globalThis, { seen });
  });
  const frames = () => page.evaluate(() => (globalThis as unknown as { seen: boolean[] }).seen);
  await expect.poll(async () => (await frames()).length).toBe(1);
  for (const [i, width] of [1300, 1200, 1100].entries()) {
    await page.setViewportSize({ width, height: 800 });
    await expect.poll(async () => (await frames()).length).toBeGreaterThan(i + 1);
  }
  // The first call is for what was there before.
  expect((await frames()).slice(1)).not.toContain(false);
});
