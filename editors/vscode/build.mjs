// Bundles the extension, and the script of the chart's page, which runs in a browser.

import * as esbuild from "esbuild";

await esbuild.build({
  entryPoints: ["src/extension.ts"],
  outfile: "out/extension.js",
  bundle: true,
  platform: "node",
  format: "cjs",
  external: ["vscode"],
  logLevel: "warning",
});
await esbuild.build({
  entryPoints: ["src/webview/chart.ts"],
  outfile: "out/webview/chart.js",
  bundle: true,
  platform: "browser",
  format: "iife",
  logLevel: "warning",
});
