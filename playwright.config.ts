import { defineConfig } from '@playwright/test';
import { chromiumOptions } from './web/scripts/chromium.mjs';

const serve = (port: number) => `npx --no-install vite preview web --port ${port} --strictPort --logLevel warn`;

/** The same page with and without the headers that let memory be shared: a run is cancelled in two different ways. */
export const isolatedPage = 'http://localhost:4273/';
export const plainPage = 'http://localhost:4274/';

export default defineConfig({
  testDir: 'tests/e2e',
  outputDir: 'build/e2e',
  timeout: 300_000,
  expect: { timeout: 90_000 },
  workers: 1,
  reporter: [['list']],
  use: {
    baseURL: isolatedPage,
    viewport: { width: 1440, height: 900 },
    acceptDownloads: true,
    launchOptions: chromiumOptions,
  },
  webServer: [
    { command: serve(4273), url: isolatedPage },
    { command: serve(4274), url: plainPage, env: { QMCF_NO_ISOLATION: '1' } },
  ],
});
