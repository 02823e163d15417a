// Starts `groundstate lsp` for models, scenarios and charts, and runs the commands that it offers above them.
//
// All that is known of the languages is in the server; this file knows where the program is, and terminals.

import * as path from "node:path";
import { commands, env, type ExtensionContext, Uri, window, workspace } from "vscode";
import { LanguageClient, type LanguageClientOptions, type ServerOptions } from "vscode-languageclient/node";

let client: LanguageClient | undefined;

function program(): string {
  return workspace.getConfiguration("groundstate").get<string>("path") || "groundstate";
}

async function start(): Promise<void> {
  const server: ServerOptions = { command: program(), args: ["lsp"] };
  const options: LanguageClientOptions = {
    documentSelector: [
      { scheme: "file", language: "asmetal" },
      { scheme: "file", language: "avalla" },
      { scheme: "file", language: "groundstate-chart" },
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
  const register = (name: string, words: string[]) =>
    context.subscriptions.push(commands.registerCommand(`groundstate.${name}`, (uri) => run(words, uri)));
  register("run", ["run"]);
  register("verify", ["verify"]);
  register("test", ["test"]);
  register("draw", ["chart", "draw"]);
  context.subscriptions.push(
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
  await start();
}

export function deactivate(): Promise<void> {
  return stop();
}
