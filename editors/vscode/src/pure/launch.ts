// The configurations of a debug session, and what is missing in them.
//
// In: what the user wrote, or nothing. Out: what the adapter is launched with; or why it cannot be. It must not know VS Code.

export interface Launch {
  type?: string;
  request?: string;
  name?: string;
  program?: unknown;
  seed?: unknown;
  [key: string]: unknown;
}

const READY = /\.(asm|avalla)$/;

export function resolved(given: Launch, active: string | undefined): Launch | string {
  const empty = !given.type && !given.request && !given.name;
  const launch: Launch = empty ? { type: "groundstate", request: "launch", name: "Step through the file" } : { ...given };
  if (launch.program === undefined || launch.program === "") {
    if (!active || !READY.test(active)) return "Open a model (.asm) or a scenario (.avalla) first.";
    launch.program = active;
  }
  if (typeof launch.program !== "string" || !READY.test(launch.program)) {
    return `${String(launch.program)} is neither a model (.asm) nor a scenario (.avalla).`;
  }
  if (launch.seed !== undefined && !(Number.isSafeInteger(launch.seed) && Number(launch.seed) >= 0)) {
    return "`seed` is a whole number from 0.";
  }
  return launch;
}
