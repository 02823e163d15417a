// How the front end is built: hashed files that the server embeds, no inline scripts, nothing from elsewhere.

import { defineConfig } from 'vite'

import { reportScripts } from './report-scripts'

export default defineConfig({
  plugins: [reportScripts()],
  esbuild: { jsx: 'automatic' },
  // An exported project may lie anywhere.
  base: './',
  build: {
    target: 'es2022',
    outDir: 'dist',
    emptyOutDir: true,
    // The page's security policy lets in no scripts or styles within HTML.
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 900,
  },
  server: {
    fs: { allow: ['..'] },
    proxy: { '/ws': { target: process.env['STUDIO'] ?? 'http://127.0.0.1:7171', ws: true } },
  },
})
