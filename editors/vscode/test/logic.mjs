// What the extension does without VS Code, with the real program where it was built: results of tests and verification, sessions
// over the language server, launches, pages.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import * as esbuild from "esbuild";

const root = fileURLToPath(new URL("../", import.meta.url));
const names = fs.readdirSync(path.join(root, "src/pure")).map((name) => name.replace(/\.ts$/, ""));
const entry = names.map((name) => `export * as ${name} from "./src/pure/${name}";`).join("\n");
const outfile = path.join(root, "out/test/pure.mjs");
const stdin = { contents: entry, resolveDir: root };
await esbuild.build({ stdin, bundle: true, platform: "node", format: "esm", outfile, logLevel: "error" });
const { results, session, launch, page, picture, stopped, where, process: processes } = await import(pathToFileURL(outfile).href);

let done = 0;
const test = async (name, work) => {
  try {
    await work();
    done += 1;
  } catch (error) {
    console.error(`failed: ${name}`);
    throw error;
  }
};

await test("names of scenarios", () => {
  const check = (text, name, line) => assert.deepEqual(results.scenarioName(text, "/a/File.avalla"), { name, line });
  check("scenario ride\nload x", "ride", 0);
  check("// scenario not\n/* scenario nor\nthis */\n\tscenario ride // x", "ride", 3);
  check("", "File", 0);
  check("scenario", "File", 0);
});

await test("answers that are none are left out", () => {
  for (const odd of [{}, { type: "scenario" }, { type: "scenario", faults: [null, 3, {}] }, { type: "scenario", faults: "x" }]) {
    results.tested(odd, "/a");
  }
  assert.equal(results.tested({ type: "summary" }, "/a"), undefined);
  assert.equal(results.verdict({ type: "explored" }, "/a"), undefined);
  assert.equal(results.verdict({ type: "verdict", verdict: "maybe", trace: 3 }, "/a").verdict, "unknown");
  assert.equal(results.spot({ file: "<std>/StandardLibrary.asm", line: 3 }, "/a"), undefined);
  assert.deepEqual(results.spot({ file: "b.asm", line: 2, column: 0 }, "/a"), {
    file: path.resolve("/a/b.asm"), line: 1, column: 0, endLine: 0, endColumn: 0,
  });
});

await test("mutants", () => {
  const one = { type: "mutant", outcome: "survived", operator: "rule-deleted", components: ["eye"], before: ["  x := 1", "y"], after: [], file: "b.asm", line: 2, column: 3 };
  assert.equal(results.mutant(one, "/a").told, "nobody notices if this changes in eye (rule-deleted): x := 1 y \u2192 nothing");
  assert.equal(results.mutant(one, "/a").at.line, 1);
  for (const odd of [{ type: "mutant" }, { type: "mutant", before: 3, components: "x" }]) results.mutant(odd, "/a");
  assert.equal(results.mutation({ type: "mutation", survived: 1, judged: 1, score: null }), "1 of 1 mutant not noticed");
  assert.equal(results.mutation(one), undefined);
});

await test("counterexamples are found by their names", () => {
  const taken = new Set();
  const files = ["in-domain.avalla", "inv_a.avalla", "inv_a.trace"];
  assert.equal(results.counterexample("inv_a", files, taken), "inv_a.avalla");
  assert.equal(results.counterexample("inv_a", files, taken), undefined);
  assert.equal(results.counterexample("in-domain", files, taken), "in-domain.avalla");
});

await test("launches", () => {
  const check = (given, active, expect) => assert.deepEqual(launch.resolved(given, active), expect);
  const ready = { type: "groundstate", request: "launch", name: "Step through the file", program: "/a/L.asm" };
  check({}, "/a/L.asm", ready);
  check({ ...ready, program: "" }, "/a/L.asm", ready);
  check({ ...ready, seed: 3 }, undefined, { ...ready, seed: 3 });
  for (const wrong of [{}, { ...ready, program: "/a/L.chart" }, { ...ready, seed: -1 }, { ...ready, program: 3 }]) {
    assert.equal(typeof launch.resolved(wrong, undefined), "string");
  }
});

await test("pages run their own scripts alone", () => {
  const chart = page.chartPage('x"><script>', "abc");
  assert.ok(chart.includes("default-src 'none'") && chart.includes("script-src 'nonce-abc'") && !chart.includes("<script>"), chart);
  assert.ok(page.failedPage("<b>$& no</b>", "n").includes("<pre>&#60;b&#62;$&#38; no"));
  const html = '<html>\n<head>\n<meta name="color-scheme" content="light dark"/>\n<style>\n@media (prefers-color-scheme: dark) { a {} }</style></head>' +
    "<body><p>&lt;script&gt;</p><scripted/><script type=\"application/json\">{}</script><script>\nrun()</script></body></html>";
  const dark = page.reportPage(html, "abc", "dark");
  assert.equal([...dark.matchAll(/<(script|style)[ >]/g)].length, [...dark.matchAll(/<(script|style) nonce="abc"/g)].length);
  assert.ok(dark.includes('content="dark"/>') && dark.includes("@media all { a {} }") && dark.includes("<scripted/>"), dark);
  assert.ok(dark.indexOf("Content-Security-Policy") < dark.indexOf("<style"), dark);
  assert.ok(page.reportPage(html, "abc", "light").includes("@media not all { a {} }"));
  assert.ok(page.reportPage("<script>alert(1)</script>", "abc", "light").includes("no page of a report"));
});

await test("the program that comes with the extension", () => {
  const all = () => true;
  const none = () => false;
  const own = path.join("/e", "bin", "groundstate");
  assert.equal(where.where("", "/e", "linux", all), own);
  assert.equal(where.where(undefined, "/e", "win32", all), path.join("/e", "bin", "groundstate.exe"));
  assert.equal(where.where("", "/e", "linux", none), "groundstate");
  assert.equal(where.where(" /opt/gs ", "/e", "linux", all), "/opt/gs");
  assert.equal(where.where("groundstate", "/e", "linux", all), "groundstate");
});

const range = (line, start, endLine, end) => ({ start: { line, character: start }, end: { line: endLine, character: end } });
const box = (id, range, nameRange = null) => ({ id, figure: "circle", label: "", x: 0, y: 0, width: 10, height: 10, range, nameRange });
const drawings = [
  {
    name: "lamp", kind: "machine", title: "", range: range(1, 0, 9, 0), svg: "<svg/>",
    picture: {
      left: -1, top: 0, width: 20.2, height: 10,
      boxes: [box("on", range(3, 1, 3, 20), range(3, 7, 3, 9)), box("off", range(4, 1, 6, 4)), box("inner", range(5, 2, 5, 8)), box("exit 1", null)],
      lines: [{ from: 0, to: 1, points: [[0, 0], [1, 1]], range: range(7, 1, 7, 10) }],
    },
    lights: [{ term: "mode", shapes: [{ value: "ON", shape: "on" }, { value: "OFF", shape: "off" }] }, { term: "arm( $x )", shapes: [{ value: "UP", shape: "inner" }] }],
  },
];

await test("the cursor is in the innermost part, and a part leads to its text", () => {
  const check = (line, character, expect) => assert.deepEqual(picture.partsAt(drawings, { line, character }), expect.map((part) => ({ drawing: "lamp", ...part })));
  check(3, 1, [{ shape: "on" }]);
  check(3, 20, [{ shape: "on" }]);
  check(3, 21, []);
  check(5, 3, [{ shape: "inner" }]);
  check(5, 9, [{ shape: "off" }]);
  check(7, 5, [{ line: 0 }]);
  check(0, 0, []);
  assert.deepEqual(picture.textOf(drawings, { drawing: "lamp", shape: "on" }), range(3, 7, 3, 9));
  assert.deepEqual(picture.textOf(drawings, { drawing: "lamp", shape: "off" }), range(4, 1, 6, 4));
  assert.deepEqual(picture.textOf(drawings, { drawing: "lamp", line: 0 }), range(7, 1, 7, 10));
  for (const part of [{ drawing: "lamp", shape: "exit 1" }, { drawing: "lamp", line: 7 }, { drawing: "none", shape: "on" }, { drawing: "lamp" }]) {
    assert.equal(picture.textOf(drawings, part), null);
  }
  const { view, boxes, image } = picture.shown(drawings[0]);
  assert.deepEqual([view, boxes.map(({ hasText }) => hasText)], [[-1, 0, 21, 10], [true, true, true, false]]);
  assert.equal(image, `data:image/svg+xml;base64,${Buffer.from("<svg/>").toString("base64")}`);
});

await test("a state lights the shapes of its values", () => {
  const lit = (state) => picture.lit(drawings, new Map(Object.entries(state))).map(({ shape, agents }) => [shape, agents]);
  assert.deepEqual(lit({ mode: "ON", other: "OFF" }), [["on", []]]);
  assert.deepEqual(lit({ "mode(a)": "ON", modes: "ON" }), []);
  assert.deepEqual(lit({ "arm(LEFT)": "UP", "arm(RIGHT)": "UP", "arm(REST)": "DOWN" }), [["inner", ["LEFT", "RIGHT"]]]);
  assert.deepEqual(lit({}), []);
  assert.deepEqual([...picture.functionsOf(drawings)], ["mode", "arm"]);
});

await test("a stop of the debugger tells the values of the functions that are wanted", async () => {
  const asked = [];
  const variables = {
    1: [{ name: "mode", evaluateName: "mode", value: "ON", variablesReference: 0 }, { name: "arm", value: "(Side) → Arm", variablesReference: 3 }, { name: "other", value: "", variablesReference: 4 }],
    3: [{ name: "arm(LEFT)", evaluateName: "arm(LEFT)", value: "UP", variablesReference: 0 }],
  };
  const ask = async (command, { variablesReference }) => {
    asked.push(variablesReference ?? command);
    if (command === "scopes") return { scopes: [{ name: "Asked for", variablesReference: 9 }, { name: "Controlled", variablesReference: 1 }] };
    return { variables: variables[variablesReference] };
  };
  assert.deepEqual([...(await stopped.stateOf(ask, new Set(["mode", "arm"])))], [["mode", "ON"], ["arm(LEFT)", "UP"]]);
  assert.deepEqual(asked, ["scopes", 1, 3]);
  assert.equal((await stopped.stateOf(ask, new Set())).size, 0);
  assert.equal((await stopped.stateOf(async () => undefined, new Set(["mode"]))).size, 0);
});

const at = (line, uri = "file:///L.asm") => ({ uri, range: { start: { line, character: 0 }, end: { line, character: 1 } } });
const told = {
  version: 1, session: 1, step: 2, waiting: "input", word: "pressed", offered: ["true", "false"], at: null,
  state: { light: "ON" }, updates: [{ location: "light", before: "OFF", after: "ON", at: at(3) }], unchanged: [at(4), at(3)],
  rules: [{ name: "r_Main", at: at(2) }], next: at(3), refused: null, stale: false,
  faults: [{ id: "x", message: "wrong", at: at(5), related: [{ text: "here, too", at: at(6) }] }],
};

await test("what a session tells", () => {
  assert.equal(session.headline(told), "step 2: pressed is asked for");
  const titles = session.sections(told).map(({ title, rows }) => `${title} ${rows.length}`);
  assert.deepEqual(titles, ["Wrong 2", "pressed is 2", "Last updates 1", "Rules that ran 1", "State 1"]);
  const notes = session.notes(told).map(({ line, text, kind }) => [line, kind, text]);
  const update = [3, "update", "light: OFF → ON"];
  assert.deepEqual(notes, [update, [4, "unchanged", "as it was"], [5, "fault", "wrong"], [6, "fault", "here, too"]]);
  const many = { ...told, updates: Array.from({ length: 5000 }, (_, n) => ({ ...told.updates[0], at: at(n) })), unchanged: [] };
  assert.ok(session.notes(many).length <= 200);
});

await test("a session makes one request after the other, and refuses other versions", async () => {
  const asked = [];
  let version = 1;
  const one = new session.Session(async (method, params) => {
    asked.push([method, params]);
    await new Promise((go) => setTimeout(go, 5));
    return { ...told, version };
  });
  await Promise.all([one.open("file:///L.asm", 3), one.request("step"), one.request("back")]);
  assert.deepEqual(asked.map(([method, params]) => [method.split("/")[2], params.session]), [["open", undefined], ["step", 1], ["back", 1]]);
  version = 2;
  await assert.rejects(one.request("step"), /version 2/);
});

await test("a program that is not there", async () => {
  const ended = await processes.run("/no/such/program", [], root, () => assert.fail("it wrote"));
  assert.equal(ended.code, undefined);
  assert.match(ended.errors, /could not be started/);
});

const program = process.env.GROUNDSTATE ?? path.join(root, "../../target/debug/groundstate");
if (!fs.existsSync(program)) {
  console.log(`${done} parts do what they should; ${program} is not built, so nothing was tried with it`);
  process.exit(0);
}

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "groundstate-extension-"));
const file = (name, text) => {
  fs.writeFileSync(path.join(folder, name), text);
  return path.join(folder, name);
};
const model = file("Lamp.asm", `asm Lamp
import StandardLibrary
signature:
	enum domain Light = {ON | OFF}
	controlled light: Light
	controlled n: Integer
	monitored pressed: Boolean
definitions:
	rule r_Toggle = if light = ON then light := OFF else light := ON endif
	invariant inv_small over n: n < 3
	main rule r_Main = par if pressed then r_Toggle[] endif if n < 4 then n := n + 1 endif endpar
default init s0:
	function light = OFF
	function n = 0
`);
const press = "scenario press\nload Lamp.asm\nset pressed := true;\nstep\ncheck light = ON;\n";
const good = file("Good.avalla", press);
const bad = file("Bad.avalla", `${press}step\ncheck light = ON;\n`);
const broken = file("Broken.avalla", "scenario broken\nload None.asm\nstep\n");
const objects = async (words, signal) => {
  const all = [];
  const ended = await processes.runJson(program, words, folder, (object) => all.push(object), signal);
  return { all, ended };
};

await test("scenarios, with what they cover", async () => {
  const { all, ended } = await objects(["test", "--format", "json", "--coverage", good, bad, broken]);
  assert.equal(ended.code, 1);
  const tests = all.map((one) => results.tested(one, folder)).filter(Boolean);
  assert.deepEqual(tests.map(({ file, passed, faulty }) => [file, passed, faulty]), [[good, true, false], [bad, false, false], [broken, false, true]]);
  const [failure] = tests[1].failures;
  assert.deepEqual([failure.at.file, failure.at.line, failure.at.column], [bad, 6, 0]);
  assert.match(failure.message, /expected ON, found OFF/);
  assert.equal(tests[2].failures[0].at.line, 1);
  const [covered] = all.map((one) => results.coverage(one, folder)).filter(Boolean);
  assert.deepEqual([covered.model, covered.updates, covered.rules], [model, { covered: 3, total: 3 }, { covered: 2, total: 2 }]);
  assert.ok(covered.uncovered.every(({ at }) => at.file === model && at.line === 10), JSON.stringify(covered.uncovered));
});

await test("verdicts, and the scenario of the counterexample", async () => {
  const kept = path.join(folder, "kept");
  const { all, ended } = await objects(["verify", "--format", "json", "--counterexample", kept, model]);
  assert.equal(ended.code, 1);
  const verdicts = all.map((one) => results.verdict(one, folder)).filter(Boolean);
  const violated = verdicts.filter(({ verdict }) => verdict === "violated");
  assert.deepEqual(violated.map(({ check, detail, at }) => [check, detail, at.line]), [["inv_small", "after 3 steps", 9]]);
  assert.ok(verdicts.filter(({ verdict }) => verdict === "holds").every(({ detail }) => /^in all \d+ states$/.test(detail)));
  assert.ok(verdicts.map(results.shownCheck).includes("no deadlock"));
  assert.match(all.map(results.explored).find(Boolean), /^all states explored: 9/);
  assert.equal(results.counterexample("inv_small", fs.readdirSync(kept), new Set()), "inv_small.avalla");
});

await test("a search is stopped", async () => {
  const endless = file("Endless.asm", fs.readFileSync(model, "utf8").replace("asm Lamp", "asm Endless").replaceAll("n < 4", "n < 100000000").replace("n < 3", "n >= 0"));
  const stop = new AbortController();
  setTimeout(() => stop.abort(), 300);
  const { ended } = await objects(["verify", "--format", "json", endless], stop.signal);
  assert.notEqual(ended.code, 0);
});

await test("the page of a report", async () => {
  const out = path.join(folder, "report.html");
  const ended = await processes.run(program, ["report", "--random", "--steps", "50", "-o", out, model], folder, () => {});
  assert.equal(ended.code === 0 || ended.code === 1, true, ended.errors);
  const written = fs.readFileSync(out, "utf8");
  // Scripts and styles are elements: nothing of the page would be stopped by a policy that knows their nonce alone.
  assert.ok(!/\son\w+=/.test(written.replace(/<script[\s\S]*?<\/script>/g, "")) && !/\sstyle="/.test(written.replace(/<script[\s\S]*?<\/script>/g, "")));
  assert.ok(!/(src|href)="(https?:)?\/\//.test(written));
  const html = page.reportPage(written, "n0", "dark");
  assert.ok(!/prefers-color-scheme/.test(html) && /<script nonce="n0" type="application\/json"/.test(html));
});

// Messages with a length, as both protocols have them.
function connect(word) {
  const child = spawn(program, [word], { stdio: ["pipe", "pipe", "ignore"] });
  let rest = Buffer.alloc(0);
  const heard = [];
  const waiting = [];
  child.stdout.on("data", (bytes) => {
    rest = Buffer.concat([rest, bytes]);
    for (;;) {
      const header = rest.indexOf("\r\n\r\n");
      if (header < 0) return;
      const length = Number(/Content-Length: (\d+)/.exec(rest.toString("latin1", 0, header))[1]);
      if (rest.length < header + 4 + length) return;
      heard.push(JSON.parse(rest.toString("utf8", header + 4, header + 4 + length)));
      rest = rest.subarray(header + 4 + length);
      waiting.splice(0).forEach((go) => go());
    }
  });
  const send = (message) => {
    const text = Buffer.from(JSON.stringify(message));
    child.stdin.write(`Content-Length: ${text.length}\r\n\r\n`);
    child.stdin.write(text);
  };
  const hear = async (wanted) => {
    for (;;) {
      const index = heard.findIndex(wanted);
      if (index >= 0) return heard.splice(index, 1)[0];
      await new Promise((go) => waiting.push(go));
    }
  };
  return { send, hear, ended: new Promise((go) => child.on("close", go)) };
}

await test("a session over the language server", async () => {
  const server = connect("lsp");
  let id = 0;
  const ask = async (method, params) => {
    const mine = ++id;
    server.send({ jsonrpc: "2.0", id: mine, method, params });
    const { result, error } = await server.hear((message) => message.id === mine && !message.method);
    if (error) throw new Error(error.message);
    return result;
  };
  const uri = pathToFileURL(folder).href;
  await ask("initialize", { processId: null, capabilities: {}, workspaceFolders: [{ uri, name: "t" }] });
  server.send({ jsonrpc: "2.0", method: "initialized", params: {} });
  const one = new session.Session(ask);
  await one.open(pathToFileURL(model).href);
  await one.request("step");
  assert.equal(session.headline(one.state), "step 0: pressed is asked for");
  await one.request("answer", { value: "true" });
  assert.deepEqual(session.notes(one.state).map(({ line, text }) => [line, text]), [[8, "light: OFF → ON"], [10, "n: 0 → 1"]]);
  await one.request("back");
  assert.equal(one.state.step, 0);
  await one.close();
  // A scenario, up to the check that fails.
  await one.open(pathToFileURL(bad).href);
  while (one.state.waiting === "step") await one.request("step");
  assert.equal(session.headline(one.state), "step 2: the run has ended (failed)");
  const fault = session.notes(one.state).find(({ kind }) => kind === "fault");
  assert.deepEqual([fault.line, fault.uri], [6, pathToFileURL(bad).href]);
  await one.close();
  await assert.rejects(one.open(pathToFileURL(path.join(folder, "None.asm")).href));
  // The pictures of a chart in both colours, with the places of their shapes.
  const chart = path.join(root, "../../examples/micro_assembly/AssemblySystem.chart");
  const textDocument = { uri: pathToFileURL(chart).href };
  const [light, dark] = [await ask("groundstate/chart/picture", { textDocument, theme: "light" }), await ask("groundstate/chart/picture", { textDocument, theme: "dark" })];
  assert.ok(light.version === picture.VERSION && light.drawings.length > 0 && light.drawings.every(({ svg }) => svg.startsWith("<svg")));
  assert.notEqual(light.drawings[0].svg, dark.drawings[0].svg);
  const { left, top, width, height } = light.drawings[0].picture;
  assert.ok(light.drawings[0].svg.includes(`viewBox="${[left, top, Math.ceil(width), Math.ceil(height)].join(" ")}"`), light.drawings[0].svg.slice(0, 300));
  for (const { name, picture: { boxes } } of light.drawings) {
    for (const { id, nameRange } of boxes.filter((one) => one.nameRange)) {
      assert.ok(picture.partsAt(light.drawings, nameRange.start).some((part) => part.drawing === name && part.shape === id), id);
    }
  }
  assert.equal((await ask("groundstate/chart/picture", { textDocument })).drawings[0].svg, undefined);
  await assert.rejects(ask("groundstate/chart/picture", { textDocument, theme: "pink" }), /light or dark/);
  await ask("shutdown", null);
  server.send({ jsonrpc: "2.0", method: "exit", params: null });
  assert.equal(await server.ended, 0);
});

await test("a counterexample is debugged", async () => {
  const adapter = connect("dap");
  let seq = 0;
  const ask = async (command, args) => {
    const mine = ++seq;
    adapter.send({ seq: mine, type: "request", command, arguments: args });
    const { success, message, body } = await adapter.hear((one) => one.type === "response" && one.request_seq === mine);
    assert.ok(success, message);
    return body;
  };
  await ask("initialize", { adapterID: "groundstate" });
  await ask("launch", launch.resolved({}, path.join(folder, "kept/inv_small.avalla")));
  await adapter.hear((one) => one.event === "initialized");
  await ask("configurationDone", {});
  await adapter.hear((one) => one.event === "stopped");
  await ask("continue", { threadId: 1 });
  const stopped = await adapter.hear((one) => one.event === "stopped");
  assert.equal(stopped.body.reason, "exception");
  const { stackFrames } = await ask("stackTrace", { threadId: 1 });
  assert.deepEqual([stackFrames[0].source.path, stackFrames[0].line], [model, 10]);
  await ask("disconnect", {});
  assert.equal(await adapter.ended, 0);
});

fs.rmSync(folder, { recursive: true });
console.log(`${done} parts do what they should, also with ${path.relative(process.cwd(), program)}`);
