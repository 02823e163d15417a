// Starts `groundstate lsp` for models, scenarios and charts, and what is built on the program: debugger, tests, views, tasks.
//
// All that is known of the languages is in the program. What needs no VS Code is in pure/, and tested in Node.

import * as path from "node:path";
import { commands, env, type ExtensionContext, Uri, window, workspace } from "vscode";
import { LanguageClient, type LanguageClientOptions, type ServerOptions } from "vscode-languageclient/node";

import { registerCharts } from "./chart";
import { registerDebugger } from "./debugging";
import { registerMutants } from "./mutants";
import { installedIn, program } from "./program";
import { registerReports } from "./report";
import { registerRunning } from "./running";
import { registerState } from "./state";
import { registerTasks } from "./tasks";
import { registerTests } from "./testing";
import { registerVerification } from "./verification";

let client: LanguageClient | undefined;

async function start(): Promise<void> {
  const server: ServerOptions = { command: program(), args: ["lsp"] };
  const options: LanguageClientOptions = {
    documentSelector: [
      { scheme: "file", language: "asmetal" },
      { scheme: "file", language: "avalla" },
      { scheme: "file", language: "groundstate-chart" },
      { scheme: "file", language: "groundstate-coupling" },
      { scheme: "file", pattern: "**/*.{report,verify}.yaml" },
    ],
    initializationOptions: { commands: true },
  };
  client = new LanguageClient("groundstate", "Groundstate", server, options);
  try {
    await client.start();
  } catch (error) {
    client = undefined;
    const install = "How to set it up";
    const message = `${program()} could not be started: ${error instanceof Error ? error.message : String(error)}`;
    if ((await window.showErrorMessage(message, install)) === install) {
      await env.openExternal(Uri.parse("https://github.com/groundstate/groundstate/blob/main/docs/editors.md"));
    }
  }
}

async function stop(): Promise<void> {
  const running = client;
  client = undefined;
  await running?.stop();
}

// A terminal whose process is the program itself: no shell reads the names of files.
async function run(words: string[], given: unknown): Promise<void> {
  const uri = typeof given === "string" ? Uri.parse(given) : window.activeTextEditor?.document.uri;
  if (uri?.scheme !== "file") {
    await window.showErrorMessage("Open a file of a model, a scenario or a chart first.");
    return;
  }
  await workspace.textDocuments.find((document) => document.uri.fsPath === uri.fsPath)?.save();
  const terminal = window.createTerminal({
    name: `groundstate ${words[0]}`,
    cwd: path.dirname(uri.fsPath),
    shellPath: program(),
    shellArgs: [...words, uri.fsPath],
  });
  terminal.show();
}

export async function activate(context: ExtensionContext): Promise<void> {
  installedIn(context.extensionPath);
  const send = (method: string, params: object): Promise<unknown> =>
    client ? client.sendRequest(method, params) : Promise.reject(new Error("the language server does not run"));
  const register = (name: string, words: string[]) =>
    context.subscriptions.push(commands.registerCommand(`groundstate.${name}`, (uri) => run(words, uri)));
  register("run", ["run"]);
  register("test", ["test"]);
  context.subscriptions.push(
    // The line above a chart names its file as a text.
    commands.registerCommand("groundstate.draw", (uri) =>
      commands.executeCommand("groundstate.preview", typeof uri === "string" ? Uri.parse(uri) : uri),
    ),
    commands.registerCommand("groundstate.restart", async () => {
      await stop();
      await start();
    }),
    workspace.onDidChangeConfiguration(async (change) => {
      if (change.affectsConfiguration("groundstate.path")) {
        await stop();
        await start();
      }
    }),
  );
  registerDebugger(context);
  registerTests(context);
  registerRunning(context);
  registerCharts(context, send);
  registerReports(context);
  registerVerification(context);
  registerMutants(context);
  registerTasks(context);
  registerState(context, send);
  await start();
}

export function deactivate(): Promise<void> {
  return stop();
}
