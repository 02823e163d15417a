// Tasks: commands of the program on the file that is open, with their faults as problems.

import { type ExtensionContext, ProcessExecution, Task, type TaskDefinition, tasks, TaskScope } from "vscode";

import { program } from "./program";

const COMMANDS: Record<string, string[]> = {
  check: ["check"],
  test: ["test"],
  verify: ["verify"],
  review: ["review"],
};

function task(definition: TaskDefinition, words: string[], file: string): Task {
  const made = new Task(
    definition,
    TaskScope.Workspace,
    String(definition.command),
    "groundstate",
    new ProcessExecution(program(), [...words, file]),
    "$groundstate",
  );
  return made;
}

export function registerTasks(context: ExtensionContext): void {
  context.subscriptions.push(
    tasks.registerTaskProvider("groundstate", {
      provideTasks: () =>
        Object.entries(COMMANDS).map(([command, words]) => task({ type: "groundstate", command }, words, "${file}")),
      resolveTask: (given) => {
        const words = COMMANDS[String(given.definition.command)];
        return words && task(given.definition, words, String(given.definition.file ?? "${file}"));
      },
    }),
  );
}
