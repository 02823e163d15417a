// The manifest and the code agree: commands, views, files, and what the problem matcher reads.

import assert from "node:assert/strict";
import fs from "node:fs";

const root = new URL("../", import.meta.url);
const read = (file) => fs.readFileSync(new URL(file, root), "utf8");
const { contributes } = JSON.parse(read("package.json"));
const sources = fs.readdirSync(new URL("src/", root)).filter((name) => name.endsWith(".ts"));
const code = sources.map((name) => read(`src/${name}`)).join("\n");

const made = new Set(
  [...code.matchAll(/registerCommand\(\s*[`"]groundstate\.([\w.]+)[`"]/g)].map((found) => `groundstate.${found[1]}`),
);
const state = read("src/state.ts");
for (const found of state.matchAll(/register\("(\w+)"/g)) made.add(`groundstate.session.${found[1]}`);
for (const found of read("src/extension.ts").matchAll(/register\("(\w+)"/g)) made.add(`groundstate.${found[1]}`);
const declared = contributes.commands.map(({ command }) => command);
for (const command of declared) assert.ok(made.has(command), `${command} is declared and not registered`);
const shown = Object.values(contributes.menus).flat().map(({ command }) => command);
for (const command of shown) assert.ok(declared.includes(command), `${command} is in a menu and not declared`);
for (const view of contributes.views.groundstate) assert.ok(code.includes(`"${view.id}"`), `${view.id} has no content`);
const files = contributes.languages.flatMap(({ icon, configuration }) => [icon.light, icon.dark, configuration]);
files.push(contributes.viewsContainers.activitybar[0].icon);
for (const file of files) assert.ok(fs.existsSync(new URL(file, root)), `${file} is not there`);

const [first, second] = contributes.problemMatchers[0].pattern.map(({ regexp }) => new RegExp(regexp));
assert.deepEqual("error[unknown-function]: there is no `x`".match(first).slice(1), ["error", "unknown-function", "there is no `x`"]);
for (const arrow of ["-->", "╭▸"]) {
  assert.deepEqual(`  ${arrow} a/Lamp.asm:9:36`.match(second).slice(1), ["a/Lamp.asm", "9", "36"]);
}
console.log(`${declared.length} commands, ${contributes.views.groundstate.length} views, ${files.length} files agree`);
