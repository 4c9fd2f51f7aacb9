// What the specs do with the page, and what they know of the outside of it.
import { spawnSync } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { expect, type Locator, type Page } from '@playwright/test';

const root = fileURLToPath(new URL('../..', import.meta.url));

/** Path of a sample. */
export const sample = (name: string) => `${root}/samples/${name}`;

/** Runs the native command line. */
export function native(...args: string[]): { status: number | null; stdout: string; stderr: string } {
  return spawnSync(`${root}/build/native/bin/qmcf`, args, { encoding: 'utf8' });
}

/** Keeps what the page sends to its worker back, from hold() to release(). To be called before the page is loaded. */
export async function holdWorker(page: Page): Promise<{ hold(): Promise<void>; release(): Promise<void> }> {
  await page.addInitScript(() => {
    const scope = globalThis as typeof globalThis & { held?: (() => void)[] | undefined };
    const post = Worker.prototype.postMessage as (...args: unknown[]) => void;
    Worker.prototype.postMessage = function (this: Worker, ...args: unknown[]) {
      const send = () => post.apply(this, args);
      return scope.held ? void scope.held.push(send) : send();
    };
  });
  type Scope = typeof globalThis & { held?: (() => void)[] | undefined };
  return {
    hold: () => page.evaluate(() => void ((globalThis as Scope).held = [])),
    release: () =>
      page.evaluate(() => {
        const { held = [] } = globalThis as Scope;
        (globalThis as Scope).held = undefined;
        held.forEach((send) => send());
      }),
  };
}

/** The page, by what its controls are called. */
export class App {
  readonly status: Locator;
  readonly alert: Locator;
  readonly generate: Locator;
  readonly cancel: Locator;
  readonly download: Locator;
  readonly crosses: Locator;
  readonly size: Locator;
  readonly count: Locator;
  readonly canvas: Locator;

  constructor(readonly page: Page) {
    this.status = page.getByRole('status');
    this.alert = page.getByRole('alert');
    this.generate = page.getByRole('button', { name: 'Generate mesh' });
    this.cancel = page.getByRole('button', { name: 'Cancel' });
    this.download = page.getByRole('button', { name: 'Download' });
    this.crosses = page.getByLabel('Show cross field');
    this.size = page.getByLabel('Element size');
    this.count = page.getByLabel('Number of quads');
    this.canvas = page.locator('canvas');
  }

  /** Opens a file by the picker that can be seen. */
  async open(file: string | { name: string; mimeType: string; buffer: Buffer }): Promise<void> {
    await this.page.getByLabel('Open model').setInputFiles(file);
  }

  async openSample(file: string): Promise<void> {
    await this.open(sample(file));
    await expect(this.status).toHaveText(`${file} is open.`);
  }

  async mesh(quads: number): Promise<void> {
    await this.count.fill(String(quads));
    await this.generate.click();
    await expect(this.status).toHaveText(/ quads? .*in .* s\.$/);
  }

  /** A number of the legend. */
  async legend(entry: string): Promise<number> {
    const row = this.page.getByRole('list', { name: 'Legend' }).getByRole('listitem').filter({ hasText: entry });
    return Number((await row.locator('b').innerText()).replaceAll(',', ''));
  }

  /** What the canvas shows. */
  async picture(): Promise<Buffer> {
    return this.canvas.screenshot();
  }

  /** Waits until the canvas shows something else than it did. */
  async expectChange(before: Buffer): Promise<void> {
    await expect.poll(async () => (await this.picture()).equals(before), { message: 'the picture is the same' }).toBe(false);
  }

  /**
   * Looks for a place where the pointer marks what `title` says, down the middle of the view in steps that no edge slips
   * through, and leaves the pointer there.
   */
  async pointAt(title: RegExp): Promise<string> {
    const tip = this.page.locator('.tip');
    const { width, height } = this.page.viewportSize()!;
    const panel = (await this.page.getByRole('complementary').boundingBox())!;
    const across = (panel.x + panel.width + width) / 2;
    for (let down = 0.12 * height; down < 0.95 * height; down += 8) {
      await this.page.mouse.move(across, down);
      // The page looks once per frame.
      await this.page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
      const text = (await tip.isVisible()) ? await tip.innerText() : '';
      if (title.test(text)) {
        return text;
      }
    }
    throw new Error(`nothing under the pointer is called ${title}`);
  }
}
