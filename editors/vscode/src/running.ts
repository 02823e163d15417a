// What runs at present: the values of a session in the state view, or of a stop in the debugger. Previews of charts show it.
//
// The last that told something counts. A debugger is asked only for the functions that somebody wants.

import { debug, EventEmitter, type ExtensionContext } from "vscode";

import type { State } from "./pure/picture";
import { stateOf } from "./pure/stopped";

type Of = (functions: ReadonlySet<string>) => Promise<State>;

const changed = new EventEmitter<void>();
export const onDidRun = changed.event;

let source: { id: string; of: Of } | undefined;

function runs(id: string, of: Of): void {
  source = { id, of };
  changed.fire();
}

function ended(id: string): void {
  if (source?.id !== id) return;
  source = undefined;
  changed.fire();
}

// The values of functions as they are now; none if nothing runs.
export async function running(functions: ReadonlySet<string>): Promise<State> {
  try {
    return (await source?.of(functions)) ?? new Map();
  } catch {
    // The run has gone on, or has ended.
    return new Map();
  }
}

// The state view tells its state, or that it has none.
export function sessionRuns(state: Record<string, string> | undefined): void {
  if (state) runs("session", async () => new Map(Object.entries(state)));
  else ended("session");
}

export function registerRunning(context: ExtensionContext): void {
  context.subscriptions.push(
    debug.registerDebugAdapterTrackerFactory("groundstate", {
      createDebugAdapterTracker: (session) => ({
        onDidSendMessage: (message: { type?: string; event?: string }) => {
          if (message.type !== "event" || message.event !== "stopped") return;
          runs(session.id, (functions) => stateOf((command, args) => Promise.resolve(session.customRequest(command, args)), functions));
        },
      }),
    }),
    debug.onDidTerminateDebugSession((session) => ended(session.id)),
  );
}
