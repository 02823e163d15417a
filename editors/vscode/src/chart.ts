// The pictures of a chart beside its text, drawn again when the text is saved and when the colours change.

import { randomBytes } from "node:crypto";
import { mkdtemp, readdir, readFile, rm } from "node:fs/promises";
import * as os from "node:os";
import * as path from "node:path";
import {
  ColorThemeKind,
  commands,
  type ExtensionContext,
  Uri,
  ViewColumn,
  type WebviewPanel,
  window,
  workspace,
} from "vscode";

import { program } from "./program";
import { failed, page, type Picture } from "./pure/page";
import { run } from "./pure/process";

async function draw(file: string): Promise<string> {
  const nonce = randomBytes(16).toString("hex");
  const kind = window.activeColorTheme.kind;
  const theme = kind === ColorThemeKind.Dark || kind === ColorThemeKind.HighContrast ? "dark" : "light";
  const folder = await mkdtemp(path.join(os.tmpdir(), "groundstate-"));
  try {
    const said: string[] = [];
    const words = ["chart", "draw", "--theme", theme, "-o", folder, file];
    const ended = await run(program(), words, path.dirname(file), (line) => said.push(line));
    if (ended.code !== 0) return failed(ended.errors || said.join("\n"), nonce);
    const pictures: Picture[] = [];
    for (const name of (await readdir(folder)).filter((name) => name.endsWith(".svg")).sort()) {
      pictures.push({ name, svg: await readFile(path.join(folder, name), "utf8") });
    }
    return page(pictures, nonce);
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
}

export function registerCharts(context: ExtensionContext): void {
  const panels = new Map<string, WebviewPanel>();
  const show = async (file: string) => {
    const html = await draw(file);
    const panel = panels.get(file);
    if (panel) panel.webview.html = html;
  };
  context.subscriptions.push(
    commands.registerCommand("groundstate.preview", async (given?: unknown) => {
      const uri = given instanceof Uri ? given : window.activeTextEditor?.document.uri;
      if (uri?.scheme !== "file" || !uri.fsPath.endsWith(".chart")) {
        await window.showErrorMessage("Open a chart (.chart) first.");
        return;
      }
      const file = uri.fsPath;
      let panel = panels.get(file);
      if (!panel) {
        const where = { viewColumn: ViewColumn.Beside, preserveFocus: true };
        panel = window.createWebviewPanel("groundstate.chart", path.basename(file), where, {
          enableScripts: false,
          localResourceRoots: [],
        });
        panels.set(file, panel);
        panel.onDidDispose(() => panels.delete(file));
      }
      panel.reveal(undefined, true);
      await show(file);
    }),
    workspace.onDidSaveTextDocument(async ({ uri }) => {
      // A chart shows what its model says, too.
      for (const file of [...panels.keys()]) {
        if (path.dirname(file) === path.dirname(uri.fsPath)) await show(file);
      }
    }),
    window.onDidChangeActiveColorTheme(() => [...panels.keys()].forEach((file) => void show(file))),
  );
}
