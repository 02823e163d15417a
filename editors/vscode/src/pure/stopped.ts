// The values of functions in a stop of the debugger, by the variables that the adapter tells.
//
// In: a way to ask the adapter, and names of functions. Out: locations with their values. It must not know VS Code.

interface Told {
  name: string;
  value: string;
  evaluateName?: string;
  variablesReference: number;
}

export type Ask = (command: string, args: object) => Promise<unknown>;

// Scopes that have functions, not what is asked for, nor updates.
const SCOPES = ["Controlled", "Shared", "Monitored", "Out", "Derived"];

const list = (answer: unknown, key: string): Record<string, unknown>[] => {
  const found = typeof answer === "object" && answer !== null ? (answer as Record<string, unknown>)[key] : undefined;
  return Array.isArray(found) ? found : [];
};

export async function stateOf(ask: Ask, functions: ReadonlySet<string>): Promise<Map<string, string>> {
  const state = new Map<string, string>();
  if (!functions.size) return state;
  const variables = async (variablesReference: unknown) =>
    list(await ask("variables", { variablesReference }), "variables") as unknown as Told[];
  for (const scope of list(await ask("scopes", { frameId: 1 }), "scopes")) {
    if (!SCOPES.includes(String(scope.name))) continue;
    for (const one of await variables(scope.variablesReference)) {
      if (!functions.has(one.name)) continue;
      // A function with arguments is no location itself; its locations are within.
      if (one.evaluateName) state.set(one.name, one.value);
      else for (const inner of await variables(one.variablesReference)) state.set(inner.name, inner.value);
    }
  }
  return state;
}
