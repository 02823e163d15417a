// Pages of reports inside the editor: of a run of the open model, of a counterexample, and of a refinement check.

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

  // Runs the program, which writes a page into a file whose name follows its last word.
  async function written(file: string, title: string, doing: string, words: readonly string[]): Promise<void> {
    const folder = await mkdtemp(path.join(os.tmpdir(), "groundstate-"));
    try {
      const page = path.join(folder, "report.html");
      const said: string[] = [];
      const stop = new AbortController();
      const options = { location: ProgressLocation.Notification, title: doing, cancellable: true };
      const ended = await window.withProgress(options, (_progress, token) => {
        token.onCancellationRequested(() => stop.abort());
        return run(program(), [...words, page, file], path.dirname(file), (line) => said.push(line), stop.signal);
      });
      log(ended.errors);
      const html = await readFile(page, "utf8").catch(() => undefined);
      if (html !== undefined) show(file, title, html);
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

  // The file that a command is about, saved; none if it is no such file.
  async function chosen(given: unknown, ending: string, what: string): Promise<string | undefined> {
    const uri = typeof given === "string" ? Uri.parse(given) : given instanceof Uri ? given : window.activeTextEditor?.document.uri;
    if (uri?.scheme !== "file" || !uri.fsPath.endsWith(ending)) {
      await window.showErrorMessage(`Open a ${what} (${ending}) first.`);
      return undefined;
    }
    await workspace.textDocuments.find((document) => document.uri.fsPath === uri.fsPath)?.save();
    return uri.fsPath;
  }

  context.subscriptions.push(
    commands.registerCommand("groundstate.report", async (uri?: unknown) => {
      const file = await chosen(uri, ".asm", "model");
      if (file === undefined) return;
      const given = workspace.getConfiguration("groundstate").get<string[]>("report.arguments");
      const name = path.basename(file);
      await written(file, `${name}: report`, `Running ${name}`, ["report", ...(Array.isArray(given) ? given.map(String) : []), "-o"]);
    }),
    commands.registerCommand("groundstate.refine", async (uri?: unknown) => {
      const file = await chosen(uri, ".refine", "coupling");
      if (file === undefined) return;
      const name = path.basename(file);
      await written(file, `${name}: refinement`, `Comparing the machines of ${name}`, ["refine", "--page"]);
    }),
    commands.registerCommand("groundstate.page", async (file: string, title: string) => {
      show(file, title, await readFile(file, "utf8"));
    }),
    window.onDidChangeActiveColorTheme(() => [...panels.values()].forEach(paint)),
  );
}
