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

const context = { subscriptions: [] };
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
const broken = file("Broken.asm", "asm Broken\n");
await command("verify", pathToFileURL(broken).href);
assert.deepEqual(rows("groundstate.verification"), []);

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
const [panel] = seen.panels;
assert.equal(panel.options.enableScripts, false);
assert.ok(panel.webview.html.includes("data:image/svg+xml"), panel.webview.html);
fs.writeFileSync(chart, "chart <b>");
await seen.saved({ uri: vscode.Uri.file(chart) });
assert.ok(panel.webview.html.includes("<pre>") && !panel.webview.html.includes("<b>"), panel.webview.html);

context.subscriptions.forEach((one) => one.dispose());
await deactivate();
fs.rmSync(folder.path, { recursive: true });
console.log("tests, state, verification, debugger, tasks and charts do what they should, without VS Code");
