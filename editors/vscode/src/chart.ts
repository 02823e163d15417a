// The pictures of a chart beside its text: drawn anew as one types, a click leads to the text, the cursor lights what it is in, and
// so does a run.

import { randomBytes } from "node:crypto";
import * as path from "node:path";
import {
  ColorThemeKind,
  commands,
  type ExtensionContext,
  Range,
  Selection,
  TextEditorRevealType,
  Uri,
  ViewColumn,
  type WebviewPanel,
  window,
  workspace,
} from "vscode";

import { chartPage } from "./pure/page";
import { type Answer, functionsOf, lit, type Lit, type Part, partsAt, shown, textOf, VERSION } from "./pure/picture";
import type { Send } from "./pure/session";
import { onDidRun, running } from "./running";

// Typing is over for now.
const PAUSE_MS = 150;

export function theme(): "light" | "dark" {
  const kind = window.activeColorTheme.kind;
  return kind === ColorThemeKind.Dark || kind === ColorThemeKind.HighContrast ? "dark" : "light";
}

class Preview {
  private answer: Answer = { version: VERSION, problems: [], drawings: [] };
  private cursor: Part[] = [];
  private lit: Lit[] = [];
  private timer: ReturnType<typeof setTimeout> | undefined;
  // Only the last answer counts.
  private asked = 0;

  constructor(
    readonly uri: Uri,
    readonly panel: WebviewPanel,
    private readonly send: Send,
  ) {
    panel.webview.onDidReceiveMessage((message: { kind?: string; part?: Part }) => {
      if (message.kind === "ready") this.tell();
      if (message.kind === "go" && message.part) void this.go(message.part);
    });
  }

  later(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.draw(), PAUSE_MS);
  }

  async draw(): Promise<void> {
    clearTimeout(this.timer);
    const mine = ++this.asked;
    const params = { textDocument: { uri: this.uri.toString() }, theme: theme() };
    let answer: Answer;
    try {
      answer = (await this.send("groundstate/chart/picture", params)) as Answer;
      if (answer.version !== VERSION) throw new Error(`groundstate speaks version ${answer.version} of pictures, the extension version ${VERSION}`);
    } catch (error) {
      // What is drawn stays: a request is given up when the text changes.
      const reason = error instanceof Error ? error.message : String(error);
      answer = { ...this.answer, problems: [reason] };
    }
    if (mine !== this.asked) return;
    this.answer = answer;
    this.tell();
    await this.run();
  }

  // Where the cursor is, as the text has it now.
  look(follow: boolean): void {
    const here = this.uri.toString();
    const editor = window.visibleTextEditors.find(({ document }) => document.uri.toString() === here);
    this.cursor = editor ? partsAt(this.answer.drawings, editor.selection.active) : [];
    this.mark(follow);
  }

  // What runs.
  async run(): Promise<void> {
    const { drawings } = this.answer;
    const state = await running(functionsOf(drawings));
    this.lit = lit(drawings, state);
    this.mark(false);
  }

  dispose(): void {
    clearTimeout(this.timer);
    this.asked += 1;
  }

  private tell(): void {
    const { drawings, problems } = this.answer;
    void this.panel.webview.postMessage({ kind: "drawings", drawings: drawings.map(shown), problems });
    this.look(false);
  }

  private mark(follow: boolean): void {
    void this.panel.webview.postMessage({ kind: "marks", cursor: this.cursor, lit: this.lit, follow });
  }

  private async go(part: Part): Promise<void> {
    const at = textOf(this.answer.drawings, part);
    if (!at) return;
    const here = this.uri.toString();
    const shownIn = window.visibleTextEditors.find(({ document }) => document.uri.toString() === here)?.viewColumn;
    const editor = await window.showTextDocument(this.uri, { viewColumn: shownIn ?? ViewColumn.One, preserveFocus: false });
    const range = new Range(at.start.line, at.start.character, at.end.line, at.end.character);
    editor.selection = new Selection(range.start, range.end);
    editor.revealRange(range, TextEditorRevealType.InCenterIfOutsideViewport);
  }
}

export function registerCharts(context: ExtensionContext, send: Send): void {
  const previews = new Map<string, Preview>();
  const script = Uri.joinPath(context.extensionUri, "out", "webview", "chart.js");
  const all = () => [...previews.values()];
  context.subscriptions.push(
    commands.registerCommand("groundstate.preview", async (given?: unknown) => {
      const uri = given instanceof Uri ? given : window.activeTextEditor?.document.uri;
      if (uri?.scheme !== "file" || !uri.fsPath.endsWith(".chart")) {
        await window.showErrorMessage("Open a chart (.chart) first.");
        return;
      }
      const key = uri.toString();
      let preview = previews.get(key);
      if (!preview) {
        const where = { viewColumn: ViewColumn.Beside, preserveFocus: true };
        const panel = window.createWebviewPanel("groundstate.chart", path.basename(uri.fsPath), where, {
          enableScripts: true,
          localResourceRoots: [Uri.joinPath(context.extensionUri, "out", "webview")],
        });
        preview = new Preview(uri, panel, send);
        previews.set(key, preview);
        panel.onDidDispose(() => {
          previews.get(key)?.dispose();
          previews.delete(key);
        });
        panel.webview.html = chartPage(panel.webview.asWebviewUri(script).toString(), randomBytes(16).toString("hex"));
      }
      preview.panel.reveal(undefined, true);
      await preview.draw();
    }),
    workspace.onDidChangeTextDocument(({ document }) => previews.get(document.uri.toString())?.later()),
    workspace.onDidSaveTextDocument(({ uri }) => {
      // A chart shows what its model and the charts that it imports say, too.
      for (const preview of all()) {
        if (path.dirname(preview.uri.fsPath) === path.dirname(uri.fsPath)) preview.later();
      }
    }),
    window.onDidChangeTextEditorSelection(({ textEditor }) => previews.get(textEditor.document.uri.toString())?.look(true)),
    window.onDidChangeActiveColorTheme(() => all().forEach((preview) => preview.later())),
    onDidRun(() => all().forEach((preview) => void preview.run())),
  );
}
