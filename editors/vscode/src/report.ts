// Pages of reports inside the editor: of a run of the open model, and of a counterexample.

import { randomBytes } from "node:crypto";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import * as os from "node:os";
import * as path from "node:path";
import { commands, type ExtensionContext, ProgressLocation, Uri, ViewColumn, type WebviewPanel, window, workspace } from "vscode";

import { theme } from "./chart";
import { log, program } from "./program";
import { failedPage, reportPage } from "./pure/page";
import { run } from "./pure/process";

interface Shown {
  panel: WebviewPanel;
  html: string;
}

export function registerReports(context: ExtensionContext): void {
  const panels = new Map<string, Shown>();
  const show = (key: string, title: string, html: string) => {
    let shown = panels.get(key);
    if (!shown) {
      const options = { enableScripts: true, localResourceRoots: [], enableFindWidget: true, retainContextWhenHidden: true };
      const panel = window.createWebviewPanel("groundstate.report", title, ViewColumn.Active, options);
      shown = { panel, html };
      panels.set(key, shown);
      panel.onDidDispose(() => panels.delete(key));
    }
    shown.html = html;
    paint(shown);
    shown.panel.reveal();
  };
  const paint = ({ panel, html }: Shown) => {
    panel.webview.html = reportPage(html, randomBytes(16).toString("hex"), theme());
  };

  async function report(file: string): Promise<void> {
    const folder = await mkdtemp(path.join(os.tmpdir(), "groundstate-"));
    const name = path.basename(file);
    try {
      const page = path.join(folder, "report.html");
      const given = workspace.getConfiguration("groundstate").get<string[]>("report.arguments");
      const words = ["report", ...(Array.isArray(given) ? given.map(String) : []), "-o", page, file];
      const said: string[] = [];
      const stop = new AbortController();
      const options = { location: ProgressLocation.Notification, title: `Running ${name}`, cancellable: true };
      const ended = await window.withProgress(options, (_progress, token) => {
        token.onCancellationRequested(() => stop.abort());
        return run(program(), words, path.dirname(file), (line) => said.push(line), stop.signal);
      });
      log(ended.errors);
      const html = await readFile(page, "utf8").catch(() => undefined);
      if (html !== undefined) show(file, `${name}: report`, html);
      else if (!stop.signal.aborted) {
        const reason = ended.errors.trim() || said.join("\n") || "groundstate wrote no page";
        const shown = panels.get(file);
        if (shown) shown.panel.webview.html = failedPage(reason, randomBytes(16).toString("hex"));
        await window.showErrorMessage(reason.split("\n")[0] ?? reason);
      }
    } finally {
      await rm(folder, { recursive: true, force: true });
    }
  }

  context.subscriptions.push(
    commands.registerCommand("groundstate.report", async (given?: unknown) => {
      const uri = typeof given === "string" ? Uri.parse(given) : given instanceof Uri ? given : window.activeTextEditor?.document.uri;
      if (uri?.scheme !== "file" || !uri.fsPath.endsWith(".asm")) {
        await window.showErrorMessage("Open a model (.asm) first.");
        return;
      }
      await workspace.textDocuments.find((document) => document.uri.fsPath === uri.fsPath)?.save();
      await report(uri.fsPath);
    }),
    commands.registerCommand("groundstate.page", async (file: string, title: string) => {
      show(file, title, await readFile(file, "utf8"));
    }),
    window.onDidChangeActiveColorTheme(() => [...panels.values()].forEach(paint)),
  );
}
