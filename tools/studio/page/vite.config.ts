import {defineConfig} from 'vite';

/** One script, one style sheet, nothing inline: what the server's content policy lets in. */
export default defineConfig({
  base: './',
  build: {
    target: 'es2022',
    emptyOutDir: true,
    modulePreload: {polyfill: false},
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 1200,
    rollupOptions: {output: {entryFileNames: 'studio.js', assetFileNames: 'studio[extname]', inlineDynamicImports: true}},
  },
});
