// A stand-in for VS Code's interface: as much of it as the extension uses, with what it was told kept to be looked at.
//
// It shows nothing. Whoever tests answers questions by `answers`.

import fs from "node:fs";
import path from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const disposable = { dispose() {} };
const never = () => disposable;

export const seen = { commands: new Map(), configuration: {}, trees: new Map(), errors: [], debugged: [], notes: [], panels: [], runs: [], told: [], hints: new Map() };
export const answers = [];
export const active = { file: undefined };
export const folder = { path: "." };

export class Uri {
  constructor(scheme, fsPath) {
    Object.assign(this, { scheme, fsPath, path: fsPath });
  }
  static file(file) {
    return new Uri("file", file);
  }
  static joinPath(base, ...parts) {
    return Uri.file(path.join(base.fsPath, ...parts));
  }
  static parse(text) {
    return text.startsWith("file:") ? new Uri("file", fileURLToPath(text)) : new Uri(text.split(":")[0], text);
  }
  toString() {
    return pathToFileURL(this.fsPath).href;
  }
}
export class Range {
  constructor(line, column, endLine, endColumn) {
    const places = typeof line === "object" ? [line, column] : [{ line, character: column }, { line: endLine, character: endColumn }];
    [this.start, this.end] = places;
  }
}
export class Selection extends Range {
  get active() {
    return this.end;
  }
}
export class Location {
  constructor(uri, range) {
    Object.assign(this, { uri, range });
  }
}
export class EventEmitter {
  heard = [];
  event = (work) => (this.heard.push(work), disposable);
  fire() {
    this.heard.forEach((work) => work());
  }
}
export class TreeItem {
  constructor(label, state) {
    Object.assign(this, { label, state });
  }
}
export class ThemeIcon {
  constructor(id) {
    this.id = id;
  }
}
export class ThemeColor extends ThemeIcon {}
export class TestMessage {
  constructor(message) {
    this.message = message;
  }
}
export class TestCoverageCount {
  constructor(covered, total) {
    Object.assign(this, { covered, total });
  }
}
export class FileCoverage {
  constructor(uri, statements, branches, declarations) {
    Object.assign(this, { uri, statements, branches, declarations });
  }
}
export class StatementCoverage {
  constructor(executed, location) {
    Object.assign(this, { executed, location });
  }
}
export class Diagnostic {
  constructor(range, message, severity) {
    Object.assign(this, { range, message, severity });
  }
}
export class DebugAdapterExecutable {
  constructor(command, args) {
    Object.assign(this, { command, args });
  }
}
export class ProcessExecution extends DebugAdapterExecutable {}
export class Task {
  constructor(definition, scope, name, source, execution, matchers) {
    Object.assign(this, { definition, scope, name, source, execution, matchers });
  }
}
export const DiagnosticSeverity = { Error: 0, Warning: 1, Information: 2, Hint: 3 };
export const TreeItemCollapsibleState = { Expanded: 2 };
export const TestRunProfileKind = { Run: 1, Debug: 2, Coverage: 3 };
export const TaskScope = { Workspace: 2 };
export const ProgressLocation = { Notification: 15 };
export const ColorThemeKind = { Light: 1, Dark: 2, HighContrast: 3 };
export const ViewColumn = { Beside: -2, Active: -1, One: 1 };
export const TextEditorRevealType = { InCenterIfOutsideViewport: 2 };

const editor = () => {
  if (!active.file) return undefined;
  const lines = fs.readFileSync(active.file, "utf8").split("\n");
  const lineAt = (line) => ({ range: new Range(line, 0, line, lines[line].length) });
  return {
    document: { uri: Uri.file(active.file), lineCount: lines.length, lineAt },
    viewColumn: 1,
    get selection() {
      return active.selection ?? { active: { line: 0, character: 0 } };
    },
    set selection(chosen) {
      active.selection = chosen;
    },
    setDecorations: (style, options) => options.forEach((one) => seen.notes.push([one.range.end.line, one.renderOptions.after.contentText])),
    revealRange() {},
  };
};

export const commands = {
  registerCommand: (name, work) => (seen.commands.set(name, work), disposable),
  executeCommand: async (name, ...words) => seen.commands.get(name)?.(...words),
};
export const window = {
  get activeTextEditor() {
    return editor();
  },
  get visibleTextEditors() {
    seen.notes = [];
    return [editor()].filter(Boolean);
  },
  activeColorTheme: { kind: ColorThemeKind.Dark },
  createOutputChannel: () => ({ appendLine() {} }),
  createTextEditorDecorationType: () => ({}),
  createTreeView: (id, { treeDataProvider }) => {
    const tree = { provider: treeDataProvider, message: undefined, dispose() {} };
    seen.trees.set(id, tree);
    return tree;
  },
  createWebviewPanel: (kind, title, where, options) => {
    const panel = { title, options, told: [], onDidDispose: never, reveal() {} };
    panel.webview = {
      html: "",
      asWebviewUri: (uri) => uri,
      postMessage: async (message) => panel.told.push(message),
      onDidReceiveMessage: (work) => ((panel.say = work), disposable),
    };
    seen.panels.push(panel);
    return panel;
  },
  showErrorMessage: async (text) => void seen.errors.push(text),
  showInformationMessage: async (text) => void seen.told.push(text),
  showInputBox: async () => answers.shift(),
  showTextDocument: async (uri) => ((active.file = uri.fsPath), editor()),
  withProgress: (options, work) => work({ report() {} }, { onCancellationRequested: never }),
  onDidChangeVisibleTextEditors: never,
  onDidChangeTextEditorSelection: (work) => ((seen.moved = work), disposable),
  onDidChangeActiveTextEditor: never,
  onDidChangeActiveColorTheme: never,
};
export const workspace = {
  get workspaceFolders() {
    return [{ uri: Uri.file(folder.path) }];
  },
  textDocuments: [],
  getConfiguration: () => ({ get: (key) => (key === "path" ? process.env.GROUNDSTATE : seen.configuration[key]) }),
  getWorkspaceFolder: () => undefined,
  asRelativePath: (uri) => path.relative(folder.path, uri.fsPath),
  findFiles: async () => fs.readdirSync(folder.path).filter((name) => name.endsWith(".avalla")).map((name) => Uri.file(path.join(folder.path, name))),
  fs: { readFile: async (uri) => fs.readFileSync(uri.fsPath) },
  createFileSystemWatcher: () => ({ onDidCreate: never, onDidChange: never, onDidDelete: never, dispose() {} }),
  onDidChangeTextDocument: (work) => {
    const others = seen.typed;
    seen.typed = (change) => (others?.(change), work(change));
    return disposable;
  },
  onDidSaveTextDocument: (work) => ((seen.saved = work), disposable),
  onDidChangeConfiguration: never,
};
export const debug = {
  registerDebugAdapterDescriptorFactory: (type, factory) => ((seen.adapter = factory), disposable),
  registerDebugConfigurationProvider: (type, provider) => ((seen.configurations = provider), disposable),
  registerDebugAdapterTrackerFactory: (type, factory) => ((seen.tracker = factory), disposable),
  onDidTerminateDebugSession: (work) => ((seen.terminated = work), disposable),
  startDebugging: async (where, configuration) => (seen.debugged.push(configuration), true),
};
export const tasks = { registerTaskProvider: (type, provider) => ((seen.tasks = provider), disposable) };
export const tests = {
  createTestController: () => {
    const items = new Map();
    const add = (item) => items.set(item.id, item);
    const all = { add, delete: (id) => items.delete(id), forEach: (work) => items.forEach(work), get: (id) => items.get(id) };
    seen.controller = {
      items: all,
      profiles: [],
      createTestItem: (id, label, uri) => ({ id, label, uri }),
      createRunProfile: (name, kind, work) => {
        const profile = { name, kind, work };
        seen.controller.profiles.push(profile);
        return profile;
      },
      createTestRun: () => {
        const told = [];
        const tell = (word) => (item, messages) => told.push([word, item.label ?? item, [messages].flat().filter(Boolean)]);
        const run = { told, coverage: [], ended: false };
        for (const word of ["started", "passed", "failed", "errored", "skipped"]) run[word] = tell(word);
        run.addCoverage = (found) => run.coverage.push(found);
        run.end = () => (run.ended = true);
        seen.runs.push(run);
        return run;
      },
      dispose() {},
    };
    return seen.controller;
  },
};
export const languages = {
  createDiagnosticCollection: () => ({
    set: (uri, all) => seen.hints.set(uri.fsPath, all),
    delete: (uri) => seen.hints.delete(uri.fsPath),
    clear: () => seen.hints.clear(),
    dispose() {},
  }),
};
export const env = { openExternal: async () => true };
