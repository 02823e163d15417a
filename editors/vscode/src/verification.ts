// The verification view: the verdicts of `groundstate verify` on a model, as they come; a counterexample is a debug session.

import { mkdtemp, readdir, rm } from "node:fs/promises";
import * as os from "node:os";
import * as path from "node:path";
import {
  commands,
  debug,
  EventEmitter,
  type ExtensionContext,
  ProgressLocation,
  ThemeColor,
  ThemeIcon,
  type TreeDataProvider,
  TreeItem,
  Uri,
  window,
  workspace,
} from "vscode";

import { log, program } from "./program";
import { runJson } from "./pure/process";
import { counterexample, explored, shownCheck, verdict, type Verdict } from "./pure/results";
import { reveal } from "./state";

interface Shown extends Verdict {
  // The scenario of the counterexample, and the page that shows its run.
  scenario?: string;
  page?: string;
}

const ICONS = {
  holds: new ThemeIcon("pass", new ThemeColor("testing.iconPassed")),
  violated: new ThemeIcon("error", new ThemeColor("testing.iconFailed")),
  unknown: new ThemeIcon("question", new ThemeColor("testing.iconQueued")),
};

class VerificationView implements TreeDataProvider<Shown> {
  private readonly changed = new EventEmitter<void>();
  readonly onDidChangeTreeData = this.changed.event;
  verdicts: Shown[] = [];

  refresh(): void {
    this.changed.fire();
  }

  getTreeItem(shown: Shown): TreeItem {
    const item = new TreeItem(shownCheck(shown));
    item.description = [shown.verdict, shown.detail].filter(Boolean).join(", ");
    item.iconPath = ICONS[shown.verdict];
    item.contextValue = shown.scenario ? "counterexample" : "verdict";
    item.command = { command: "groundstate.verification.reveal", title: "Show", arguments: [shown] };
    return item;
  }

  getChildren(shown?: Shown): Shown[] {
    return shown ? [] : this.verdicts;
  }
}

export function registerVerification(context: ExtensionContext): void {
  const view = new VerificationView();
  const tree = window.createTreeView("groundstate.verification", { treeDataProvider: view });
  let running: AbortController | undefined;
  let kept: string | undefined;
  const forget = async () => {
    if (kept) await rm(kept, { recursive: true, force: true });
    kept = undefined;
  };

  async function verify(file: string): Promise<void> {
    running?.abort();
    const stop = new AbortController();
    running = stop;
    await forget();
    const folder = await mkdtemp(path.join(os.tmpdir(), "groundstate-"));
    kept = folder;
    view.verdicts = [];
    view.refresh();
    const name = path.basename(file);
    tree.message = `${name}: states are being explored`;
    const here = path.dirname(file);
    const options = { location: ProgressLocation.Notification, title: `Verifying ${name}`, cancellable: true };
    await window.withProgress(options, async (progress, token) => {
      token.onCancellationRequested(() => stop.abort());
      const words = ["verify", "--format", "json", "--counterexample", folder, file];
      const began = Date.now();
      const clock = setInterval(() => progress.report({ message: `${Math.round((Date.now() - began) / 1000)} s` }), 1000);
      let extent = "";
      const ended = await runJson(program(), words, here, (object) => {
        const found = verdict(object, here);
        if (found && !stop.signal.aborted) {
          view.verdicts.push(found);
          view.refresh();
        }
        extent = explored(object) ?? extent;
      }, stop.signal);
      clearInterval(clock);
      log(ended.errors);
      if (running !== stop) return;
      const files: string[] = await readdir(folder).catch(() => []);
      const taken = new Set<string>();
      for (const shown of view.verdicts.filter((one) => one.verdict === "violated")) {
        const scenario = counterexample(shown.check, files, taken);
        if (scenario) shown.scenario = path.join(folder, scenario);
        const page = scenario?.replace(/\.avalla$/, ".html");
        if (page && files.includes(page)) shown.page = path.join(folder, page);
      }
      const none = ended.errors.trim().split("\n")[0] ?? "";
      tree.message = stop.signal.aborted ? `${name}: stopped` : `${name}: ${extent || none || "there is no verdict"}`;
      view.refresh();
    });
  }

  context.subscriptions.push(
    tree,
    commands.registerCommand("groundstate.verify", async (given?: unknown) => {
      const uri = typeof given === "string" ? Uri.parse(given) : window.activeTextEditor?.document.uri;
      if (uri?.scheme !== "file" || !uri.fsPath.endsWith(".asm")) {
        await window.showErrorMessage("Open a model (.asm) first.");
        return;
      }
      await workspace.textDocuments.find((document) => document.uri.fsPath === uri.fsPath)?.save();
      await commands.executeCommand("groundstate.verification.focus");
      await verify(uri.fsPath);
    }),
    commands.registerCommand("groundstate.verification.stop", () => running?.abort()),
    commands.registerCommand("groundstate.verification.reveal", async (shown: Shown) => {
      if (!shown.at) return;
      const { file, line, column, endLine, endColumn } = shown.at;
      const range = { start: { line, character: column }, end: { line: endLine, character: endColumn } };
      await reveal({ uri: Uri.file(file).toString(), range });
    }),
    commands.registerCommand("groundstate.verification.debug", async (shown: Shown) => {
      if (!shown.scenario) return;
      await debug.startDebugging(undefined, {
        type: "groundstate",
        request: "launch",
        name: `${shown.check}: counterexample`,
        program: shown.scenario,
      });
    }),
    commands.registerCommand("groundstate.verification.page", async (shown: Shown) => {
      if (shown.page) await commands.executeCommand("groundstate.page", shown.page, `${shown.check}: counterexample`);
    }),
    { dispose: () => { running?.abort(); void forget(); } },
  );
}
