// Where the program is, and what went wrong with it.

import { window, workspace } from "vscode";

export function program(): string {
  return workspace.getConfiguration("groundstate").get<string>("path") || "groundstate";
}

const channel = window.createOutputChannel("Groundstate commands");

export function log(text: string): void {
  if (text.trim()) channel.appendLine(text.trimEnd());
}
