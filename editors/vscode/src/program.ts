// Where the program is, and what went wrong with it.

import { existsSync } from "node:fs";
import { window, workspace } from "vscode";

import { where } from "./pure/where";

let extension = "";

// The folder of the extension, which may have a program of its own.
export function installedIn(folder: string): void {
  extension = folder;
}

export function program(): string {
  const setting = workspace.getConfiguration("groundstate").get<string>("path");
  return where(setting, extension, process.platform, existsSync);
}

const channel = window.createOutputChannel("Groundstate commands");

export function log(text: string): void {
  if (text.trim()) channel.appendLine(text.trimEnd());
}
