// Mutants that nobody notices, as hints at their places: what `groundstate mutate` finds in the model or the chart that is open.
//
// Outcomes are kept in the extension's folder of the workspace, so that a mutant is judged again only if something has changed that its
// outcome rests on. INVARIANT: a hint goes when its text is changed, since its place is another one then.

import { mkdir } from "node:fs/promises";
import * as path from "node:path";
import {
  commands,
  Diagnostic,
  DiagnosticSeverity,
  type ExtensionContext,
  languages,
  ProgressLocation,
  Range,
  Uri,
  window,
  workspace,
} from "vscode";

import { log, program } from "./program";
import { runJson } from "./pure/process";
import { failed, mutant, mutation } from "./pure/results";

export function registerMutants(context: ExtensionContext): void {
  const hints = languages.createDiagnosticCollection("groundstate mutants");
  let running: AbortController | undefined;

  async function mutate(file: string): Promise<void> {
    running?.abort();
    const stop = new AbortController();
    running = stop;
    hints.clear();
    const name = path.basename(file);
    const here = path.dirname(file);
    const found = new Map<string, Diagnostic[]>();
    const words = ["mutate", "--format", "json"];
    const kept = context.storageUri?.fsPath;
    if (kept) {
      await mkdir(kept, { recursive: true });
      words.push("--results", path.join(kept, "mutants.jsonl"));
    }
    const options = { location: ProgressLocation.Notification, title: `Mutating ${name}`, cancellable: true };
    await window.withProgress(options, async (progress, token) => {
      token.onCancellationRequested(() => stop.abort());
      const began = Date.now();
      const clock = setInterval(() => progress.report({ message: `${Math.round((Date.now() - began) / 1000)} s` }), 1000);
      let told = "";
      let trouble = "";
      const ended = await runJson(program(), [...words, file], here, (object) => {
        told = mutation(object) ?? told;
        trouble ||= failed(object) ?? "";
        const one = mutant(object, here);
        if (one?.outcome !== "survived" || !one.at) return;
        const { line, column, endLine, endColumn } = one.at;
        const hint = new Diagnostic(new Range(line, column, endLine, endColumn), one.told, DiagnosticSeverity.Hint);
        hint.source = "groundstate mutate";
        hint.code = one.operator;
        found.set(one.at.file, [...(found.get(one.at.file) ?? []), hint]);
      }, stop.signal);
      clearInterval(clock);
      log(ended.errors);
      if (running !== stop) return;
      const isOpen = (path: string) => workspace.textDocuments.some((document) => document.uri.fsPath === path && document.isDirty);
      for (const [path, all] of found) if (!isOpen(path)) hints.set(Uri.file(path), all);
      if (told) void window.showInformationMessage(`${name}: ${told}`);
      else if (!stop.signal.aborted) void window.showErrorMessage(`${name}: ${trouble || ended.errors.trim().split("\n")[0] || "nothing was judged"}`);
    });
  }

  context.subscriptions.push(
    hints,
    commands.registerCommand("groundstate.mutate", async (given?: unknown) => {
      const uri = typeof given === "string" ? Uri.parse(given) : window.activeTextEditor?.document.uri;
      if (uri?.scheme !== "file" || !/\.(asm|chart)$/.test(uri.fsPath)) {
        await window.showErrorMessage("Open a model (.asm) or a chart first.");
        return;
      }
      await workspace.textDocuments.find((document) => document.uri.fsPath === uri.fsPath)?.save();
      await mutate(uri.fsPath);
    }),
    commands.registerCommand("groundstate.mutate.clear", () => {
      running?.abort();
      hints.clear();
    }),
    workspace.onDidChangeTextDocument(({ document, contentChanges }) => {
      if (contentChanges.length) hints.delete(document.uri);
    }),
    { dispose: () => running?.abort() },
  );
}
