// Another name for a machine of a chart, or none: which edits of which texts that is.
//
// In: what the server knows of the machine's name (`studio/machine`). Out: edits by file, and why a name cannot be. What names the machine
// is the server's to find.

import type { MachineNames, TextEdit } from './protocol'

export type NameFault = 'form' | 'taken'

export function nameFault(names: Pick<MachineNames, 'taken'>, name: string): NameFault | null {
  if (!/^[A-Za-z]\w*$/.test(name)) return 'form'
  return names.taken.includes(name) ? 'taken' : null
}

// A text as charts write it.
export const quoted = (text: string): string => `"${text.replace(/[\\"]/g, '\\$&').replace(/\n/g, '\\n')}"`

// The machine of the file at `path` is called `to`, and shows `title`; null leaves what it shows as it is.
export function renaming(path: string, names: MachineNames, to: string, title: string | null): Map<string, TextEdit[]> {
  const edits = new Map<string, TextEdit[]>()
  const add = (file: string, edit: TextEdit): void => void edits.set(file, [...(edits.get(file) ?? []), edit])
  for (const place of names.places) add(place.path, { range: place.range, newText: to })
  if (title !== null) add(path, { range: names.title, newText: title.trim() === '' ? '' : ` ${quoted(title)}` })
  return edits
}

export const removal = (names: MachineNames): TextEdit[] => names.lines.map((range) => ({ range, newText: '' }))

// Which drawing is shown once there are others: the same one, else the one in its place.
export function stays(before: readonly string[], shown: string | null, now: readonly string[]): string | null {
  if (shown !== null && now.includes(shown)) return shown
  const at = shown === null ? -1 : before.indexOf(shown)
  return now[Math.max(0, Math.min(at, now.length - 1))] ?? null
}
