// The extension against a stand-in for VS Code's interface, with the real program: what is registered works, from a command to what is
// shown. The language server is spoken with by a client of the test's own.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import * as esbuild from "esbuild";

const root = fileURLToPath(new URL("../", import.meta.url));
process.env.GROUNDSTATE ??= path.join(root, "../../target/debug/groundstate");
const program = process.env.GROUNDSTATE;
if (!fs.existsSync(program)) {
  console.log(`${program} is not built, so the extension was not tried with it`);
  process.exit(0);
}

// The library's client is replaced by one that has what the extension uses of it.
class LanguageClient {
  heard = [];
  waiting = [];
  next = 0;
  constructor(id, name, { command, args }) {
    Object.assign(this, { command, args });
  }
  async start() {
    this.child = spawn(this.command, this.args, { stdio: ["pipe", "pipe", "ignore"] });
    let rest = Buffer.alloc(0);
    this.child.stdout.on("data", (bytes) => {
      rest = Buffer.concat([rest, bytes]);
      for (let header; (header = rest.indexOf("\r\n\r\n")) >= 0; ) {
        const length = Number(/Content-Length: (\d+)/.exec(rest.toString("latin1", 0, header))[1]);
        if (rest.length < header + 4 + length) return;
        this.heard.push(JSON.parse(rest.toString("utf8", header + 4, header + 4 + length)));
        rest = rest.subarray(header + 4 + length);
        this.waiting.splice(0).forEach((go) => go());
      }
    });
    LanguageClient.last = this;
    await this.sendRequest("initialize", { processId: null, capabilities: {} });
    this.write({ method: "initialized", params: {} });
  }
  write(message) {
    const text = Buffer.from(JSON.stringify({ jsonrpc: "2.0", ...message }));
    this.child.stdin.write(Buffer.concat([Buffer.from(`Content-Length: ${text.length}\r\n\r\n`), text]));
  }
  async sendRequest(method, params) {
    const id = ++this.next;
    this.write({ id, method, params });
    for (;;) {
      const at = this.heard.findIndex((message) => message.id === id && !message.method);
      if (at >= 0) {
        const [{ result, error }] = this.heard.splice(at, 1);
        if (error) throw new Error(error.message);
        return result;
      }
      await new Promise((go) => this.waiting.push(go));
    }
  }
  async stop() {
    await this.sendRequest("shutdown", null);
    this.write({ method: "exit" });
  }
}
globalThis.StandInClient = LanguageClient;

const standIn = path.join(root, "test/stand-in.mjs");
const outfile = path.join(root, "out/test/wired.mjs");
const replaced = {
  name: "replaced",
  setup(build) {
    build.onResolve({ filter: /^vscode$/ }, () => ({ path: standIn }));
    build.onResolve({ filter: /^vscode-languageclient\/node$/ }, (found) => ({ path: found.path, namespace: "client" }));
    build.onLoad({ filter: /.*/, namespace: "client" }, () => ({ contents: "export const LanguageClient = globalThis.StandInClient;" }));
  },
};
const contents = `export * from "./src/extension"; export * as vscode from "vscode";`;
const stdin = { contents, resolveDir: root };
await esbuild.build({ stdin, bundle: true, platform: "node", format: "esm", outfile, plugins: [replaced], logLevel: "error" });
const { activate, deactivate, vscode } = await import(pathToFileURL(outfile).href);
const { seen, answers, active, folder } = vscode;

folder.path = fs.mkdtempSync(path.join(os.tmpdir(), "groundstate-wired-"));
const file = (name, text) => (fs.writeFileSync(path.join(folder.path, name), text), path.join(folder.path, name));
const model = file("Door.asm", `asm Door
import StandardLibrary
signature:
	enum domain Door = {OPEN | SHUT}
	controlled door: Door
	controlled turns: Integer
	monitored key: Boolean
definitions:
	invariant inv_turns over turns: turns < 2
	main rule r_Main =
		if key then
			par
				choose $d in Door with $d != door do door := $d
				if turns < 3 then turns := turns + 1 endif
			endpar
		endif
default init s0:
	function door = SHUT
	function turns = 0
`);
const opens = "scenario opens\nload Door.asm\nset key := true;\nstep\ncheck door = OPEN;\n";
file("Opens.avalla", opens);
file("Shuts.avalla", `${opens.replace("opens", "shuts").replace("= OPEN", "= SHUT")}`);

const storageUri = vscode.Uri.file(path.join(folder.path, "kept"));
const context = { subscriptions: [], storageUri, extensionPath: root, extensionUri: vscode.Uri.file(root) };
await activate(context);
const command = (name, ...words) => seen.commands.get(`groundstate.${name}`)(...words);
const rows = (id) => {
  const { provider } = seen.trees.get(id);
  const all = (node) => provider.getChildren(node).flatMap((child) => [provider.getTreeItem(child), ...all(child)]);
  return all(undefined);
};

// Tests: one passes, one fails at its line; what is covered is told.
const { controller } = seen;
await controller.resolveHandler(undefined);
const labels = [];
controller.items.forEach((item) => labels.push(item.label));
assert.deepEqual(labels.sort(), ["opens", "shuts"]);
const profile = (name) => controller.profiles.find((one) => one.name === name);
await profile("Run with coverage").work({}, { onCancellationRequested: () => ({ dispose() {} }), isCancellationRequested: false });
const [run] = seen.runs;
assert.ok(run.ended);
const results = run.told.filter(([word]) => word !== "started").map(([word, label]) => [label, word]);
assert.deepEqual(results.sort(), [["opens", "passed"], ["shuts", "failed"]]);
const [message] = run.told.find(([word]) => word === "failed")[2];
assert.deepEqual([message.location.uri.fsPath, message.location.range.start.line], [path.join(folder.path, "Shuts.avalla"), 4]);
assert.deepEqual([run.coverage[0].uri.fsPath, { ...run.coverage[0].statements }], [model, { covered: 2, total: 2 }]);
const details = await profile("Run with coverage").loadDetailedCoverage(run, run.coverage[0]);
assert.ok(details.length > 0 && details.every(({ executed }) => executed === false));
await profile("Debug").work({ include: [controller.items.get(vscode.Uri.file(path.join(folder.path, "Opens.avalla")).toString())] });
assert.equal(seen.debugged.pop().program, path.join(folder.path, "Opens.avalla"));

// State: a step asks for an input and a choice; what it changed stands at its lines.
active.file = model;
await command("session.open");
assert.equal(seen.trees.get("groundstate.state").message, "step 0");
await command("session.step");
assert.equal(seen.trees.get("groundstate.state").message, "step 0: key is asked for");
const offers = rows("groundstate.state").filter(({ contextValue }) => contextValue === "offer");
assert.deepEqual(offers.map(({ label }) => label), ["true", "false"]);
await command("session.take", ...offers[0].command.arguments);
const [candidate] = rows("groundstate.state").filter(({ contextValue }) => contextValue === "offer");
assert.equal(candidate.label, "OPEN");
await command("session.take", ...candidate.command.arguments);
assert.equal(seen.trees.get("groundstate.state").message, "step 1");
assert.deepEqual(seen.notes.sort(), [[12, "door: SHUT → OPEN"], [13, "turns: 0 → 1"]]);
answers.push("key", "false");
await command("session.set");
await command("session.step");
assert.equal(seen.trees.get("groundstate.state").message, "step 2");
await command("session.back");
assert.equal(seen.trees.get("groundstate.state").message, "step 1");
await command("session.close");
assert.deepEqual(rows("groundstate.state"), []);
active.file = path.join(folder.path, "Shuts.avalla");
await command("session.open");
await command("session.run");
assert.equal(seen.trees.get("groundstate.state").message, "step 1: the run has ended (failed)");
assert.deepEqual(seen.notes.map(([line]) => line), [4]);
await command("session.close");

// Verification: a counterexample opens as a debug session.
active.file = model;
await command("verify", pathToFileURL(model).href);
const shown = rows("groundstate.verification");
const violated = shown.find(({ contextValue }) => contextValue === "counterexample");
assert.deepEqual([violated.label, violated.description], ["inv_turns", "violated, after 2 steps"]);
assert.match(seen.trees.get("groundstate.verification").message, /^Door\.asm: all states explored/);
await command("verification.debug", ...violated.command.arguments);
const counterexample = seen.debugged.pop();
assert.ok(fs.existsSync(counterexample.program), counterexample.program);
await command("verification.reveal", ...violated.command.arguments);
await command("verification.page", ...violated.command.arguments);
assert.equal(seen.panels.at(-1).title, "inv_turns: counterexample");
assert.ok(seen.panels.at(-1).webview.html.includes("<script nonce="), seen.panels.at(-1).webview.html.slice(0, 500));
const broken = file("Broken.asm", "asm Broken\n");
await command("verify", pathToFileURL(broken).href);
assert.deepEqual(rows("groundstate.verification"), []);

// Mutants: a hint where nobody would notice a fault, until the text is changed; outcomes are kept.
const lamp = file("Lamp.asm", `asm Lamp
import StandardLibrary
signature:
	monitored held: Boolean
	controlled lit: Boolean
	controlled worn: Boolean
definitions:
	invariant inv_worn over lit: lit implies worn
	main rule r_Main = if held then par lit := true worn := true endpar endif
default init s0:
	function lit = false
	function worn = false
`);
await command("mutate", pathToFileURL(lamp).href);
const hints = seen.hints.get(lamp);
assert.ok(hints.some(({ range, message, severity }) => range.start.line === 8 && severity === 3 && /guard-false/.test(message)), JSON.stringify([hints, seen.errors]));
assert.match(seen.told.pop(), /^Lamp\.asm: \d+ of \d+ mutants not noticed, score [\d.]+ %$/);
assert.match(fs.readFileSync(path.join(folder.path, "kept", "mutants.jsonl"), "utf8").split("\n")[0], /mutation-results/);
seen.typed({ document: { uri: vscode.Uri.file(lamp) }, contentChanges: [{}] });
assert.equal(seen.hints.size, 0);
await command("mutate", pathToFileURL(lamp).href);
assert.equal(seen.hints.get(lamp).length, hints.length);
await command("mutate.clear");
assert.equal(seen.hints.size, 0);
// What does not pass as it is has no mutants: that is told.
await command("mutate", pathToFileURL(model).href);
assert.match(seen.errors.pop(), /^Door\.asm: .*violated/);
active.file = undefined;
await command("mutate");
assert.match(seen.errors.pop(), /Open a model/);
active.file = model;

// Debugger, tasks, charts.
assert.deepEqual({ ...seen.adapter.createDebugAdapterDescriptor() }, { command: program, args: ["dap"] });
active.file = model;
assert.equal((await seen.configurations.resolveDebugConfiguration(undefined, {})).program, model);
active.file = undefined;
assert.equal(await seen.configurations.resolveDebugConfiguration(undefined, {}), undefined);
assert.equal(seen.errors.length, 1);
assert.deepEqual(seen.tasks.provideTasks().map(({ name }) => name), ["check", "test", "verify", "review"]);
assert.equal(seen.tasks.resolveTask({ definition: { command: "dance" } }), undefined);
const chart = path.join(folder.path, "AssemblySystem.chart");
const examples = path.join(root, "../../examples/micro_assembly");
for (const name of fs.readdirSync(examples).filter((name) => /\.(asm|chart)$/.test(name))) {
  fs.copyFileSync(path.join(examples, name), path.join(folder.path, name));
}
active.file = chart;
await command("preview");
const panel = seen.panels.at(-1);
const nonce = /script-src 'nonce-(\w+)'/.exec(panel.webview.html)[1];
assert.ok(panel.webview.html.includes(`<script nonce="${nonce}" src="`) && !panel.webview.html.includes("unsafe"), panel.webview.html);
const last = (kind) => panel.told.filter((message) => message.kind === kind).at(-1);
const until = async (held, what) => {
  for (let tries = 0; !held(); tries += 1) {
    assert.ok(tries < 400, what);
    await new Promise((go) => setTimeout(go, 20));
  }
};
const drawn = last("drawings");
assert.ok(drawn.drawings.length > 0 && drawn.drawings.every(({ image }) => image.startsWith("data:image/svg+xml;base64,")));
// The cursor in a shape's text lights it; a click on it leads to its text.
const source = fs.readFileSync(chart, "utf8").split("\n");
const line = source.findIndex((text) => /^\s*component\s+\w+/.test(text));
const [, shape] = /component\s+(\w+)/.exec(source[line]);
active.selection = { active: { line, character: source[line].indexOf(shape) + 1 } };
seen.moved({ textEditor: vscode.window.activeTextEditor });
assert.deepEqual(last("marks").cursor.map((part) => part.shape), [shape]);
assert.equal(last("marks").follow, true);
active.selection = undefined;
panel.say({ kind: "go", part: { drawing: last("marks").cursor[0].drawing, shape } });
await until(() => active.selection, "the click leads nowhere");
assert.equal(active.selection.start.line, line);
assert.equal(source[line].slice(active.selection.start.character, active.selection.end.character), shape);
panel.say({ kind: "go", part: { drawing: "nothing", shape } });
// What is typed is drawn without being saved; a text with faults is drawn as far as it can be read.
const client = globalThis.StandInClient.last;
const document = { uri: vscode.Uri.file(chart) };
const typed = async (version, text) => {
  const before = panel.told.filter(({ kind }) => kind === "drawings").length;
  const method = version === 1 ? "textDocument/didOpen" : "textDocument/didChange";
  const textDocument = { uri: document.uri.toString(), languageId: "groundstate-chart", version, text };
  client.write({ method, params: version === 1 ? { textDocument } : { textDocument, contentChanges: [{ text }] } });
  seen.typed({ document, contentChanges: [{ text }] });
  await until(() => panel.told.filter(({ kind }) => kind === "drawings").length > before, "nothing was drawn anew");
};
await typed(1, "chart Small\nmachine lamp\n\tcontrol {door}\n\tinitial state open \"Open\" {OPEN}\n\tstate shut \"Shut\" {SHUT}\n\topen -> shut\n\tshut -> open\nendmachine\n");
assert.deepEqual(last("drawings").drawings.map(({ name, boxes }) => [name, boxes.map(({ id }) => id).filter((id) => /open|shut/.test(id))]), [["lamp", ["open", "shut"]]]);
await typed(2, "chart <b>\nmachine");
assert.ok(!JSON.stringify(last("drawings").drawings).includes("<b>"));
await typed(3, "chart Small\nmachine lamp\n\tcontrol {door}\n\tinitial state open \"Open\" {OPEN}\n\tstate shut \"Shut\" {SHUT}\n\topen -> shut\n\tshut -> open\nendmachine\n");
// A session of the state view lights the state that it is in, and none when it ends.
const lights = () => last("marks").lit.map((part) => part.shape);
active.file = model;
await command("session.open");
await until(() => lights().join() === "shut", "the state is not lit");
answers.push("key", "true");
await command("session.set");
await command("session.step");
const [taken] = rows("groundstate.state").filter(({ contextValue }) => contextValue === "offer");
await command("session.take", ...taken.command.arguments);
await until(() => lights().join() === "open", "the next state is not lit");
await command("session.close");
await until(() => lights().length === 0, "a state is lit although nothing runs");
// So does a stop of the debugger.
const debugging = {
  id: "d1",
  customRequest: async (word, { variablesReference }) => {
    if (word === "scopes") return { scopes: [{ name: "Controlled", variablesReference: 1 }, { name: "Last updates", variablesReference: 2 }] };
    return { variables: variablesReference === 1 ? [{ name: "door", evaluateName: "door", value: "OPEN", variablesReference: 0 }] : assert.fail("it was asked for updates") };
  },
};
const tracker = seen.tracker.createDebugAdapterTracker(debugging);
tracker.onDidSendMessage({ type: "event", event: "output" });
tracker.onDidSendMessage({ type: "event", event: "stopped" });
await until(() => lights().join() === "open", "a stop lights nothing");
seen.terminated({ id: "other" });
assert.deepEqual(lights(), ["open"]);
seen.terminated(debugging);
await until(() => lights().length === 0, "a state is lit although the debugger has ended");

// The page of a run, and of the counterexample.
active.file = model;
seen.configuration["report.arguments"] = ["--random", "--steps", "20"];
await command("report");
const page = seen.panels.at(-1);
assert.match(page.title, /^Door\.asm/);
const own = /script-src 'nonce-(\w+)'/.exec(page.webview.html)[1];
const elements = [...page.webview.html.matchAll(/<(?:script|style)\b[^>]*>/g)].map(([tag]) => tag);
assert.ok(elements.length >= 3 && elements.every((tag) => tag.includes(`nonce="${own}"`)), elements.join("\n"));
assert.notEqual(own, nonce);
active.file = broken;
const before = seen.errors.length;
await command("report");
assert.equal(seen.errors.length, before + 1);

context.subscriptions.forEach((one) => one.dispose());
await deactivate();
fs.rmSync(folder.path, { recursive: true });
console.log("tests, state, verification, debugger, tasks, charts and reports do what they should, without VS Code");
