// The Test Explorer: the scenarios of the folders, run by `groundstate test`, with what they cover.

import * as path from "node:path";
import {
  type CancellationToken,
  debug,
  type ExtensionContext,
  FileCoverage,
  Location,
  Range,
  type StatementCoverage,
  StatementCoverage as Statement,
  type TestController,
  TestCoverageCount,
  type TestItem,
  TestMessage,
  TestRunProfileKind,
  type TestRunRequest,
  tests,
  Uri,
  workspace,
} from "vscode";

import { log, program } from "./program";
import { runJson } from "./pure/process";
import { type Coverage, coverage, scenarioName, type Spot, tested } from "./pure/results";

const FILES = "**/*.avalla";
const LEFT_OUT = "**/{target,build,node_modules,.*}/**";

const range = (at: Spot) => new Range(at.line, at.column, at.endLine, at.endColumn);
const location = (at: Spot) => new Location(Uri.file(at.file), range(at));

async function discover(controller: TestController, uri: Uri): Promise<void> {
  let source: string;
  try {
    source = Buffer.from(await workspace.fs.readFile(uri)).toString("utf8");
  } catch {
    controller.items.delete(uri.toString());
    return;
  }
  const { name, line } = scenarioName(source, uri.fsPath);
  const item = controller.createTestItem(uri.toString(), name, uri);
  item.description = workspace.asRelativePath(uri);
  item.range = new Range(line, 0, line, 0);
  controller.items.add(item);
}

// Details come when the editor asks for them: what was not covered. What was is only known as a number.
class ModelCoverage extends FileCoverage {
  constructor(readonly found: Coverage) {
    const count = ({ covered, total }: { covered: number; total: number }) => new TestCoverageCount(covered, total);
    super(Uri.file(found.model), count(found.updates), count(found.branches), count(found.rules));
  }

  details(): StatementCoverage[] {
    const inModel = this.found.uncovered.filter((one) => one.at.file === this.found.model);
    return inModel.map((one) => new Statement(false, range(one.at)));
  }
}

async function runTests(
  controller: TestController,
  request: TestRunRequest,
  token: CancellationToken,
  covers: boolean,
): Promise<void> {
  const run = controller.createTestRun(request);
  const wanted: TestItem[] = [];
  const excluded = new Set(request.exclude ?? []);
  const take = (item: TestItem) => {
    if (item.uri && !excluded.has(item)) wanted.push(item);
  };
  if (request.include) request.include.forEach(take);
  else controller.items.forEach(take);
  const byFile = new Map(wanted.map((item) => [path.resolve(item.uri?.fsPath ?? ""), item]));
  wanted.forEach((item) => run.started(item));
  const stop = new AbortController();
  const listening = token.onCancellationRequested(() => stop.abort());
  const told = new Set<TestItem>();
  const folder = workspace.workspaceFolders?.[0]?.uri.fsPath ?? path.dirname(wanted[0]?.uri?.fsPath ?? ".");
  if (wanted.length) {
    const words = ["test", "--format", "json", ...(covers ? ["--coverage"] : []), ...byFile.keys()];
    const ended = await runJson(program(), words, folder, (object) => {
      const result = tested(object, folder);
      const item = result && byFile.get(result.file);
      if (result && item) {
        told.add(item);
        const messages = result.failures.map((failure) => {
          const message = new TestMessage(
            [failure.message, ...failure.related.map((one) => one.text)].filter(Boolean).join("\n"),
          );
          if (failure.at) message.location = location(failure.at);
          return message;
        });
        if (result.passed) run.passed(item);
        else if (result.faulty) run.errored(item, messages);
        else run.failed(item, messages);
      }
      const covered = coverage(object, folder);
      if (covered) run.addCoverage(new ModelCoverage(covered));
    }, stop.signal);
    log(ended.errors);
    for (const item of wanted.filter((item) => !told.has(item))) {
      if (token.isCancellationRequested) run.skipped(item);
      else run.errored(item, new TestMessage(ended.errors || "groundstate told no result of this scenario"));
    }
  }
  listening.dispose();
  run.end();
}

export function registerTests(context: ExtensionContext): void {
  const controller = tests.createTestController("groundstate", "Groundstate");
  const look = async () => {
    for (const uri of await workspace.findFiles(FILES, LEFT_OUT)) await discover(controller, uri);
  };
  controller.resolveHandler = async (item) => {
    if (!item) await look();
  };
  controller.refreshHandler = look;
  const profile = (name: string, kind: TestRunProfileKind, covers: boolean) =>
    controller.createRunProfile(name, kind, (request, token) => runTests(controller, request, token, covers), true);
  profile("Run", TestRunProfileKind.Run, false);
  const withCoverage = profile("Run with coverage", TestRunProfileKind.Coverage, true);
  withCoverage.loadDetailedCoverage = async (_run, file) => (file instanceof ModelCoverage ? file.details() : []);
  controller.createRunProfile("Debug", TestRunProfileKind.Debug, async (request) => {
    for (const item of request.include ?? []) {
      if (item.uri) {
        await debug.startDebugging(workspace.getWorkspaceFolder(item.uri), {
          type: "groundstate",
          request: "launch",
          name: item.label,
          program: item.uri.fsPath,
        });
      }
    }
  });
  const watcher = workspace.createFileSystemWatcher(FILES);
  watcher.onDidCreate((uri) => discover(controller, uri));
  watcher.onDidChange((uri) => discover(controller, uri));
  watcher.onDidDelete((uri) => controller.items.delete(uri.toString()));
  context.subscriptions.push(controller, watcher);
}
