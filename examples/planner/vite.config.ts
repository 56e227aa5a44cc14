// Builds the planner into one HTML file: script, style, worker and library stand inside the page,
// because a page from disk may fetch nothing.
import { defineConfig } from 'vite';
import { resolve } from 'node:path';
import { onePage } from './build/one_page';
import { library } from './build/library';
import { shipped } from './build/shipped';

export default defineConfig({
  root: resolve(__dirname, 'src'),
  esbuild: { legalComments: 'none' },
  worker: { format: 'iife', plugins: () => [library()] },
  plugins: [shipped(), onePage()],
  build: {
    target: 'es2022',
    outDir: resolve(__dirname, 'dist'),
    emptyOutDir: true,
    assetsInlineLimit: 1 << 30,
    cssCodeSplit: false,
    modulePreload: false,
    chunkSizeWarningLimit: 4096,
    rollupOptions: { output: { inlineDynamicImports: true } },
  },
});
