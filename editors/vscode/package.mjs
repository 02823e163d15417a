// Packs the extension: for this platform with the program inside, if it was built (`cargo build --release -p cli`), else for all platforms without.
//
// `GROUNDSTATE_BINARY` names another program, `GROUNDSTATE_TARGET` another platform, as vsce calls them. The program is started first:
// one that does not run is not packed.

import { execFileSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL(".", import.meta.url));
const name = process.platform === "win32" ? "groundstate.exe" : "groundstate";
const bin = path.join(root, "bin");
const binary = process.env.GROUNDSTATE_BINARY ?? path.join(root, "../../target/release", name);
const target = process.env.GROUNDSTATE_TARGET ?? `${process.platform}-${process.arch}`;

fs.rmSync(bin, { recursive: true, force: true });
for (const old of fs.readdirSync(root).filter((file) => file.endsWith(".vsix"))) fs.rmSync(path.join(root, old));
const words = ["vsce", "package", "--no-dependencies"];
if (fs.existsSync(binary)) {
  const version = execFileSync(binary, ["--version"], { encoding: "utf8" }).trim();
  fs.mkdirSync(bin);
  fs.copyFileSync(binary, path.join(bin, name));
  fs.chmodSync(path.join(bin, name), 0o755);
  words.push("--target", target, "--out", `groundstate-${target}.vsix`);
  console.log(`with ${version} inside, for ${target}`);
} else {
  words.push("--out", "groundstate.vsix");
  console.log(`${path.relative(root, binary)} is not built: without a program inside, for all platforms`);
}
try {
  execFileSync("npx", words, { cwd: root, stdio: "inherit", shell: process.platform === "win32" });
} finally {
  fs.rmSync(bin, { recursive: true, force: true });
}
