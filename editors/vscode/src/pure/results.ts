// The answers of `groundstate test`, `verify` and `mutate`, as objects of `--format json`.
//
// In: one object after the other. Out: what the views show of it. Lines and columns come from 1 and go out from 0. It must not
// know VS Code.

import * as path from "node:path";

export interface Spot {
  file: string;
  line: number;
  column: number;
  endLine: number;
  endColumn: number;
}

export interface Failure {
  message: string;
  at: Spot | undefined;
  related: { text: string; at: Spot }[];
}

export interface Tested {
  file: string;
  name: string;
  passed: boolean;
  // It could not be run.
  faulty: boolean;
  failures: Failure[];
}

export interface Covered {
  covered: number;
  total: number;
}

export interface Coverage {
  model: string;
  rules: Covered;
  branches: Covered;
  updates: Covered;
  uncovered: { what: string; rule: string; at: Spot }[];
}

type Json = Record<string, unknown>;

const isObject = (value: unknown): value is Json => typeof value === "object" && value !== null && !Array.isArray(value);
const text = (value: unknown): string => (typeof value === "string" ? value : "");
const number = (value: unknown): number => (typeof value === "number" && Number.isFinite(value) ? value : 0);
const objects = (value: unknown): Json[] => (Array.isArray(value) ? value.filter(isObject) : []);

// A place; none where the answer has none.
export function spot(value: unknown, folder: string): Spot | undefined {
  if (!isObject(value) || typeof value.file !== "string" || value.file.startsWith("<")) return undefined;
  const from1 = (key: string) => Math.max(0, number(value[key]) - 1);
  return {
    file: path.resolve(folder, value.file),
    line: from1("line"),
    column: from1("column"),
    endLine: from1("end_line"),
    endColumn: from1("end_column"),
  };
}

function failure(fault: Json, folder: string): Failure {
  const reason = text(fault.reason);
  const help = text(fault.help);
  const message = [reason ? `${text(fault.message)}: ${reason}` : text(fault.message), help].filter(Boolean).join("\n");
  const related = objects(fault.labels).flatMap((label) => {
    const at = spot(label, folder);
    return at ? [{ text: text(label.text), at }] : [];
  });
  return { message, at: spot(fault, folder), related };
}

// The result of a scenario; none if the object is something else.
export function tested(object: Json, folder: string): Tested | undefined {
  if (object.type !== "scenario") return undefined;
  const result = text(object.result);
  return {
    file: path.resolve(folder, text(object.file)),
    name: text(object.name),
    passed: result === "passed" || result === "failed-as-expected",
    faulty: result === "faulty",
    failures: objects(object.faults).map((fault) => failure(fault, folder)),
  };
}

// What scenarios covered of a model; none if the object is something else.
export function coverage(object: Json, folder: string): Coverage | undefined {
  if (object.type !== "coverage") return undefined;
  const total = (kind: string): Covered => {
    const found = objects(object.totals).find((one) => one.kind === kind);
    return { covered: number(found?.covered), total: number(found?.total) };
  };
  const uncovered = objects(object.uncovered).flatMap((one) => {
    const at = spot(one, folder);
    return at ? [{ what: text(one.what), rule: text(one.rule), at }] : [];
  });
  const [rules, branches, updates] = [total("rules"), total("branches"), total("updates")];
  return { model: path.resolve(folder, text(object.model)), rules, branches, updates, uncovered };
}

export interface Verdict {
  check: string;
  // A check that comes with every model, or a property.
  builtin: boolean;
  verdict: "holds" | "violated" | "unknown";
  at: Spot | undefined;
  // Why it is not known, or how many states it holds in.
  detail: string;
  // How many steps the run takes that violates it.
  steps: number | undefined;
}

// What every model is checked for, in words.
const BUILTIN: Record<string, string> = {
  consistent: "no inconsistent update",
  "in-domain": "no update outside its domain",
  defined: "every guard and operation is defined",
  "no-deadlock": "no deadlock",
};

export const shownCheck = ({ check, builtin }: Verdict): string => (builtin ? (BUILTIN[check] ?? check) : check);

// The verdict on a property; none if the object is something else.
export function verdict(object: Json, folder: string): Verdict | undefined {
  if (object.type !== "verdict") return undefined;
  const said = object.verdict;
  const is = said === "holds" || said === "violated" ? said : "unknown";
  const reasons = Array.isArray(object.reasons) ? object.reasons.map(text).filter(Boolean) : [];
  const steps = is === "violated" ? Math.max(0, objects(object.trace).length - 1) : undefined;
  let detail = reasons.join("; ");
  if (is === "holds") detail = text(object.by) || (number(object.states) ? `in all ${number(object.states)} states` : "");
  if (is === "violated") detail = `after ${steps} ${steps === 1 ? "step" : "steps"}`;
  return { check: text(object.check), builtin: object.kind === "builtin", verdict: is, at: spot(object.at, folder), detail, steps };
}

// The extent of a search; none if the object is something else.
export function explored(object: Json): string | undefined {
  if (object.type !== "explored") return undefined;
  const complete = object.complete === true ? "all" : "not all";
  return `${complete} states explored: ${number(object.states)}, to a depth of ${number(object.depth)}`;
}

export interface Mutant {
  // `killed`, `survived` and others.
  outcome: string;
  operator: string;
  at: Spot | undefined;
  // What the fault is.
  told: string;
}

// What became of a mutant; none if the object is something else.
export function mutant(object: Json, folder: string): Mutant | undefined {
  if (object.type !== "mutant") return undefined;
  const shown = (value: unknown) => (Array.isArray(value) ? value.map(text).join(" ").replace(/\s+/g, " ").trim() : "");
  const operator = text(object.operator);
  const components = Array.isArray(object.components) ? object.components.map(text).filter(Boolean) : [];
  const within = components.length ? ` in ${components.join(", ")}` : "";
  const told = `nobody notices if this changes${within} (${operator}): ${shown(object.before)} \u2192 ${shown(object.after) || "nothing"}`;
  return { outcome: text(object.outcome), operator, at: spot(object, folder), told };
}

// How many mutants came to what; none if the object is something else.
export function mutation(object: Json): string | undefined {
  if (object.type !== "mutation") return undefined;
  const [survived, all] = [number(object.survived), number(object.judged)];
  const score = typeof object.score === "number" ? `, score ${object.score} %` : "";
  return `${survived} of ${all} ${all === 1 ? "mutant" : "mutants"} not noticed${score}`;
}

// Why the program did not do its work; none if the object is something else.
export function failed(object: Json): string | undefined {
  return object.type === "failure" ? text(object.message) : undefined;
}

// The file of the counterexample of a check, among those written to a folder: names are made fit for files, and numbered where two
// are alike.
export function counterexample(check: string, files: string[], taken: Set<string>): string | undefined {
  const plain = (name: string) => name.toLowerCase().replace(/[^a-z0-9]/g, "");
  const scenarios = files.filter((file) => file.endsWith(".avalla") && !taken.has(file)).sort();
  const found = scenarios.find((file) => plain(file.slice(0, -".avalla".length)) === plain(check));
  if (found) taken.add(found);
  return found;
}

// The name of a scenario, and the line that it is written in; its file's name if it has none.
export function scenarioName(source: string, file: string): { name: string; line: number } {
  const bare = source.replace(/\/\*[\s\S]*?\*\//g, (comment) => comment.replace(/[^\n]/g, " "));
  const lines = bare.split("\n").map((line) => line.replace(/\/\/.*$/, ""));
  for (const [line, words] of lines.entries()) {
    const found = /^\s*scenario\s+([^\s;]+)/.exec(words);
    if (found?.[1]) return { name: found[1], line };
  }
  return { name: path.basename(file, ".avalla"), line: 0 };
}
