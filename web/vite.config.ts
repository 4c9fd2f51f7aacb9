import { defineConfig } from 'vite';

// With these two headers a run is cancelled through shared memory; without them everything works all the same, which is
// what the tests set QMCF_NO_ISOLATION for.
const isolation: Record<string, string> = process.env['QMCF_NO_ISOLATION']
  ? {}
  : {
      'Cross-Origin-Opener-Policy': 'same-origin',
      'Cross-Origin-Embedder-Policy': 'require-corp',
    };

export default defineConfig({
  base: './',
  build: { target: 'es2022', assetsInlineLimit: 0, chunkSizeWarningLimit: 900 },
  worker: { format: 'es' },
  optimizeDeps: { exclude: ['qmcf'] },
  server: { headers: isolation },
  preview: { headers: isolation },
});
