// The debugger: the same program with `dap`.

import {
  debug,
  DebugAdapterExecutable,
  type DebugConfiguration,
  type ExtensionContext,
  type ProviderResult,
  window,
} from "vscode";

import { program } from "./program";
import { resolved } from "./pure/launch";

export function registerDebugger(context: ExtensionContext): void {
  context.subscriptions.push(
    debug.registerDebugAdapterDescriptorFactory("groundstate", {
      createDebugAdapterDescriptor: () => new DebugAdapterExecutable(program(), ["dap"]),
    }),
    debug.registerDebugConfigurationProvider("groundstate", {
      resolveDebugConfiguration: (_folder, given): ProviderResult<DebugConfiguration> => {
        const launch = resolved(given, window.activeTextEditor?.document.uri.fsPath);
        if (typeof launch === "string") {
          return window.showErrorMessage(launch).then(() => undefined);
        }
        return launch as DebugConfiguration;
      },
    }),
  );
}
