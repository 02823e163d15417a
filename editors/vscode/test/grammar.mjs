// The grammar colours what it is to colour: each line is a text, a part of it, and the scope that part has.

import assert from "node:assert/strict";
import fs from "node:fs";
import { createRequire } from "node:module";

const require = createRequire(import.meta.url);
const oniguruma = require("vscode-oniguruma");
const textmate = require("vscode-textmate");

const wasm = fs.readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm"));
await oniguruma.loadWASM(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength));
const path = new URL("../syntaxes/asmetal.tmLanguage.json", import.meta.url);
const registry = new textmate.Registry({
  onigLib: Promise.resolve({
    createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
    createOnigString: (text) => new oniguruma.OnigString(text),
  }),
  loadGrammar: async () => textmate.parseRawGrammar(fs.readFileSync(path, "utf8"), path.pathname),
});
const grammar = await registry.loadGrammar("source.asmetal");

const cases = [
  ["asm Lamp", "Lamp", "entity.name.type.module"],
  ["import ../patterns/Task // x", "../patterns/Task", "string.unquoted.path"],
  ["\tenum domain Light = {ON | OFF}", "ON", "constant.other.enum"],
  ["\tcontrolled light: Light", "controlled", "storage.modifier"],
  ["\tcontrolled light: Light", "Light", "entity.name.type"],
  ["\trule r_Put($n in Integer) = skip", "r_Put", "entity.name.function.rule"],
  ["\trule r_Put($n in Integer) = skip", "$n", "variable.parameter"],
  ["x := 2.5 // half", ":=", "keyword.operator"],
  ["x := 2.5 // half", "2.5", "constant.numeric"],
  ["x := 2.5 // half", "// half", "comment.line"],
  ["if a and b then skip endif", "and", "keyword.operator.word"],
  ["check light = ON;", "check", "keyword.control.scenario"],
  ["/* if */ skip", " if ", "comment.block"],
  ["s := \"say \\\"go\\\"\"", "\\\"", "constant.character.escape"],
  ["\tinitial state off {OFF}", "state", "keyword.declaration.chart"],
];
for (const [line, part, scope] of cases) {
  const { tokens } = grammar.tokenizeLine(line, textmate.INITIAL);
  const at = line.indexOf(part);
  const token = tokens.find((token) => token.startIndex <= at && at < token.endIndex);
  assert.ok(
    token.scopes.some((name) => name.startsWith(scope)),
    `${part} in ${line} is ${token.scopes.join(" ")}, not ${scope}`,
  );
}
console.log(`${cases.length} parts have their colours`);
