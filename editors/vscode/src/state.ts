// The state view: a model or a scenario that runs beside its text, by the sessions of the language server.

import {
  commands,
  type DecorationOptions,
  EventEmitter,
  type ExtensionContext,
  Range,
  Selection,
  TextEditorRevealType,
  ThemeColor,
  ThemeIcon,
  type TreeDataProvider,
  TreeItem,
  TreeItemCollapsibleState,
  Uri,
  window,
} from "vscode";

import { headline, notes, type Note, type Place, type Row, type Section, sections, Session, type Send } from "./pure/session";
import { sessionRuns } from "./running";

type Node = { section: Section } | { row: Row };

const ICONS: Record<Row["kind"], string> = {
  location: "symbol-field",
  update: "edit",
  rule: "symbol-method",
  fault: "error",
  offer: "circle-large-outline",
  text: "info",
};

const COLOURS: Record<Note["kind"], string> = {
  update: "editorCodeLens.foreground",
  unchanged: "disabledForeground",
  fault: "editorError.foreground",
  next: "editorInfo.foreground",
};

export async function reveal(at: Place): Promise<void> {
  const editor = await window.showTextDocument(Uri.parse(at.uri), { preserveFocus: false });
  const { start, end } = at.range;
  const range = new Range(start.line, start.character, end.line, end.character);
  editor.selection = new Selection(range.start, range.end);
  editor.revealRange(range, TextEditorRevealType.InCenterIfOutsideViewport);
}

class StateView implements TreeDataProvider<Node> {
  private readonly changed = new EventEmitter<void>();
  readonly onDidChangeTreeData = this.changed.event;
  private readonly styles = Object.entries(COLOURS).map(([kind, colour]) => ({
    kind,
    style: window.createTextEditorDecorationType({ after: { margin: "0 0 0 2em", color: new ThemeColor(colour) } }),
  }));
  session: Session | undefined;

  getTreeItem(node: Node): TreeItem {
    if ("section" in node) {
      const item = new TreeItem(node.section.title, TreeItemCollapsibleState.Expanded);
      item.id = node.section.title;
      return item;
    }
    const { row } = node;
    const item = new TreeItem(row.label);
    item.description = row.detail;
    item.tooltip = row.detail ? `${row.label}: ${row.detail}` : row.label;
    item.iconPath = new ThemeIcon(ICONS[row.kind]);
    item.contextValue = row.kind;
    if (row.kind === "offer") {
      item.command = { command: "groundstate.session.take", title: "Take", arguments: [row] };
    } else if (row.at) {
      item.command = { command: "groundstate.session.reveal", title: "Show", arguments: [row.at] };
    }
    return item;
  }

  getChildren(node?: Node): Node[] {
    const state = this.session?.state;
    if (!state) return [];
    if (!node) return sections(state).map((section) => ({ section }));
    return "section" in node ? node.section.rows.map((row) => ({ row })) : [];
  }

  message(): string | undefined {
    const state = this.session?.state;
    if (!state) return undefined;
    const stale = state.stale ? " · the text has changed since" : "";
    return `${headline(state)}${stale}${state.refused ? `\n${state.refused}` : ""}`;
  }

  refresh(): void {
    this.changed.fire();
    const state = this.session?.state;
    const all = state && !state.stale ? notes(state) : [];
    for (const editor of window.visibleTextEditors) {
      const uri = editor.document.uri.toString();
      const here = all.filter((note) => Uri.parse(note.uri).toString() === uri && note.line < editor.document.lineCount);
      for (const { kind, style } of this.styles) {
        const options = here
          .filter((note) => note.kind === kind)
          .map((note): DecorationOptions => {
            const end = editor.document.lineAt(note.line).range.end;
            return { range: new Range(end, end), renderOptions: { after: { contentText: note.text } } };
          });
        editor.setDecorations(style, options);
      }
    }
  }
}

export function registerState(context: ExtensionContext, send: Send): void {
  const view = new StateView();
  const tree = window.createTreeView("groundstate.state", { treeDataProvider: view });
  const told = () => {
    view.refresh();
    tree.message = view.message();
    const state = view.session?.state;
    sessionRuns(state?.state);
    void commands.executeCommand("setContext", "groundstate.session", state !== undefined);
    if (state?.waiting === "input" && !state.offered.length) void give(state.word ?? "");
  };
  const attempt = async (work: () => Promise<unknown>) => {
    try {
      await work();
    } catch (error) {
      await window.showErrorMessage(error instanceof Error ? error.message : String(error));
    }
    told();
  };
  const request = (method: string, params: object = {}) =>
    attempt(async () => {
      if (view.session?.state) await view.session.request(method, params);
    });
  async function give(location: string): Promise<void> {
    const value = await window.showInputBox({ prompt: `The value of ${location}, as AsmetaL writes it` });
    if (value !== undefined) await request("answer", { value });
  }
  const register = (name: string, work: (...words: never[]) => unknown) =>
    context.subscriptions.push(commands.registerCommand(`groundstate.session.${name}`, work));
  const open = async (seed?: number) => {
    await attempt(async () => {
      const uri = window.activeTextEditor?.document.uri;
      if (!uri || !/\.(asm|avalla)$/.test(uri.path)) throw new Error("Open a model or a scenario first.");
      await view.session?.close();
      view.session = new Session(send);
      await view.session.open(uri.toString(), seed);
    });
    // The view comes last: one that is told of changes while it is first filled leaves rows out.
    if (view.session?.state) await commands.executeCommand("groundstate.state.focus");
  };
  register("open", () => open());
  register("random", () => open(Math.floor(Math.random() * 2 ** 31)));
  register("step", () => request("step"));
  register("run", () => request("step", { steps: 1000 }));
  register("back", () => request("back"));
  register("close", () => attempt(async () => view.session?.close()));
  register("reveal", (at: Place) => reveal(at));
  register("take", (row: Row) => {
    const asks = view.session?.state?.waiting;
    return asks === "choice" ? request("choose", { candidate: row.index }) : request("answer", { value: row.label });
  });
  register("set", async (node?: Node) => {
    const row = node && "row" in node ? node.row : undefined;
    const location = row?.label ?? (await window.showInputBox({ prompt: "The input, such as pressed or passed(ROOM1)" }));
    if (!location) return;
    const value = await window.showInputBox({
      prompt: `${location} from now on; empty: it is asked for`,
      ...(row ? { value: row.detail } : {}),
    });
    if (value !== undefined) await request("set", { location, value: value === "" ? null : value });
  });
  context.subscriptions.push(
    tree,
    window.onDidChangeVisibleTextEditors(() => view.refresh()),
    window.onDidChangeActiveTextEditor(() => view.refresh()),
  );
}
