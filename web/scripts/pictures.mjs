// Takes pictures of the built page: a part as it was opened, its cross field, its mesh, its quality, its front.
//
//   node web/scripts/pictures.mjs MODEL FOLDER [WIDTHxHEIGHT...]     (default 1440x900 390x844)
//
// Build the page first. Files are called NAME-VIEW-WIDTH.png. CHROMIUM is the browser, /usr/bin/chromium if unset.
import { mkdirSync } from 'node:fs';
import { basename, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium, expect } from '@playwright/test';
import { preview } from 'vite';
import { chromiumOptions } from './chromium.mjs';

/** Drawing in software on a busy machine is slow. */
const patience = { timeout: 150_000 };

/** What is done before each picture, in this order. */
const views = {
  part: async (page, model) => {
    await page.getByLabel('Open model').setInputFiles(model);
    await expect(page.getByRole('status')).toContainText('is open', patience);
  },
  field: async (page) => {
    await page.getByRole('button', { name: 'Field', exact: true }).click(patience);
    await expect(page.getByRole('status')).toContainText(/Cross field with/, patience);
  },
  streamlines: async (page) => {
    await page.getByLabel('Streamlines').check(patience);
    await page.getByLabel('Constraints').check(patience);
  },
  mesh: async (page) => {
    await page.getByRole('button', { name: 'Generate mesh' }).click(patience);
    await expect(page.getByRole('status')).toContainText(/\d quads?.* in /, patience);
    await page.getByLabel('Show cross field').uncheck(patience);
  },
  quality: async (page) => {
    await page.getByLabel('Colour by quality').check(patience);
  },
  worst: async (page) => {
    const worst = page.getByRole('button', { name: 'Worst element' });
    if (!(await worst.isVisible())) {
      await page.getByRole('button', { name: 'Show all settings' }).click(patience);
    }
    await worst.click(patience);
  },
  front: async (page) => {
    const record = page.getByLabel('Record the front');
    if (!(await record.isVisible())) {
      const all = page.getByRole('button', { name: 'Show all settings' });
      if ((await all.isVisible()) && (await all.getAttribute('aria-expanded')) === 'false') {
        await all.click(patience);
      }
      await page.getByText('Features and directions').click(patience);
    }
    await record.check(patience);
    await page.getByRole('button', { name: 'Generate mesh' }).click(patience);
    const step = page.getByRole('slider', { name: 'Step' });
    await expect(step).toBeVisible(patience);
    await step.evaluate((input) => {
      input.value = String(Math.round(0.45 * Number(input.max)));
      input.dispatchEvent(new Event('input'));
    });
    await page.getByRole('button', { name: 'Fit the view' }).click(patience);
  },
};

/** Two pictures that are the same: everything that was asked for is drawn. */
async function settled(page) {
  let last = await page.screenshot({ animations: 'disabled', ...patience });
  for (let i = 0; i < 20; ++i) {
    const next = await page.screenshot({ animations: 'disabled', ...patience });
    if (next.equals(last)) {
      return;
    }
    last = next;
  }
}

async function takePictures(browser, url, model, folder, [width, height]) {
  const page = await browser.newPage({ viewport: { width, height }, hasTouch: width < 720 });
  page.on('pageerror', (error) => console.error(error.message));
  await page.goto(url, patience);
  const name = basename(model).replace(/\.[^.]*$/, '');
  for (const [view, prepare] of Object.entries(views)) {
    await prepare(page, model);
    await settled(page);
    const path = join(folder, `${name}-${view}-${width}.png`);
    await page.screenshot({ path, animations: 'disabled', ...patience });
    console.log(path);
  }
  await page.close();
}

const [model, folder, ...sizes] = process.argv.slice(2);
if (!model || !folder || sizes.some((size) => !/^\d+x\d+$/.test(size))) {
  console.error('usage: node web/scripts/pictures.mjs MODEL FOLDER [WIDTHxHEIGHT...]');
  process.exit(2);
}
mkdirSync(folder, { recursive: true });
const server = await preview({ root: fileURLToPath(new URL('..', import.meta.url)), logLevel: 'warn' });
const browser = await chromium.launch(chromiumOptions);
try {
  for (const size of sizes.length > 0 ? sizes : ['1440x900', '390x844']) {
    await takePictures(browser, server.resolvedUrls.local[0], model, folder, size.split('x').map(Number));
  }
} finally {
  await browser.close();
  await server.close();
}
