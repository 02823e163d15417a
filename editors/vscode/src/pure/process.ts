// Runs the program and hands over what it writes, line by line.
//
// In: words, never a shell's line, and a signal to stop. Out: each line of stdout as it comes, and how it ended. A line that is no
// JSON is left out. It must not know VS Code.

import { spawn } from "node:child_process";

export interface Ended {
  // The exit code; none if it was stopped or could not be started.
  code: number | undefined;
  // What it wrote to stderr, its end if that is much.
  errors: string;
}

const KEPT = 10_000;

export function run(
  program: string,
  words: string[],
  folder: string,
  line: (line: string) => void,
  signal?: AbortSignal,
): Promise<Ended> {
  return new Promise((resolve) => {
    const child = spawn(program, words, { cwd: folder, stdio: ["ignore", "pipe", "pipe"], windowsHide: true });
    let rest = "";
    let errors = "";
    const stop = () => child.kill("SIGINT");
    signal?.addEventListener("abort", stop, { once: true });
    if (signal?.aborted) stop();
    child.stdout.setEncoding("utf8").on("data", (text: string) => {
      const lines = (rest + text).split("\n");
      rest = lines.pop() ?? "";
      lines.forEach(line);
    });
    child.stderr.setEncoding("utf8").on("data", (text: string) => {
      errors = (errors + text).slice(-KEPT);
    });
    let ended = false;
    const end = (code: number | undefined, why?: string) => {
      if (ended) return;
      ended = true;
      signal?.removeEventListener("abort", stop);
      if (rest) line(rest);
      resolve({ code, errors: why ?? errors });
    };
    child.on("error", (error) => end(undefined, `${program} could not be started: ${error.message}`));
    child.on("close", (code) => end(code ?? undefined));
  });
}

// The same for `--format json`.
export function runJson(
  program: string,
  words: string[],
  folder: string,
  object: (object: Record<string, unknown>) => void,
  signal?: AbortSignal,
): Promise<Ended> {
  const line = (text: string) => {
    let read: unknown;
    try {
      read = JSON.parse(text);
    } catch {
      return;
    }
    if (typeof read === "object" && read !== null && !Array.isArray(read)) object(read as Record<string, unknown>);
  };
  return run(program, words, folder, line, signal);
}
