// What the studio says while a machine of a chart gets another name, or goes.

const list = (names: readonly string[]): string => names.join(', ')

export const MACHINES = {
  menu: (name: string) => `What to do with ${name}`,
  more: 'Rename or delete this drawing',
  rename: 'Rename…',
  delete: 'Delete…',
  renameCommand: 'Rename this machine',
  deleteCommand: 'Delete this machine',
  renameTitle: (name: string) => `Rename ${name}`,
  renameHint: 'What names it in this and other charts has the new name at once; its model and its C++ when they are made again.',
  follow: 'Changed with it',
  faults: {
    form: 'A name has only a–z, A–Z, digits and _, and begins with a letter.',
    taken: 'Another machine, or a word of charts, has this name.',
  },
  renamed: (old: string, to: string, files: readonly string[]) => `${old} is ${to} now, in ${list(files)} too.`,
  deleteTitle: (name: string) => `Delete ${name}?`,
  deleteHint: 'It goes from the chart with its layout; undo brings it back. What its model has stays until you remove it there.',
  missed: 'Still names it, and will be at fault',
  deleteButton: 'Delete',
  deleted: (name: string) => `${name} is deleted.`,
  typing: 'The text keeps changing: try again when nobody types.',
  other: (name: string) => `${name} is another text by now: try again.`,
}
