// Where the program is: as the setting says, else the one that came with the extension, else the one on the path.
//
// In: the setting, the folder of the extension, and how to see whether a file is there. Out: a path or a name. It must not know VS
// Code.

import * as path from "node:path";

export function where(setting: string | undefined, extension: string, platform: string, exists: (file: string) => boolean): string {
  const said = setting?.trim();
  if (said) return said;
  const own = path.join(extension, "bin", platform === "win32" ? "groundstate.exe" : "groundstate");
  return exists(own) ? own : "groundstate";
}
