// What the studio says while texts are in no file, and while its program is not there.

export const LOST = {
  gone: 'The studio’s program is not there. What you type waits here.',
  start: 'Start it again:',
  command: (folder: string, port: string) => `groundstate studio ${folder} --port ${port}`,
  open: 'Open its new address in this browser: this page goes on then. Do not load this page anew.',
  other: 'The studio was started anew, and this page is of its former start. What you type waits here.',
  copy: 'Copy my text',
  copied: (name: string) => `The text of ${name} is in the clipboard.`,
  noClipboard: 'The browser does not give its clipboard: select the text and copy it.',
}

export const KEPT = {
  inBrowser: 'Until you have decided, this browser keeps your text, also if the page is closed.',
  notInBrowser: 'This browser has no room to keep your text: it is lost if the page is closed before you have decided.',
  waiting: (names: string[]) => `Typed before and in no file: ${names.join(', ')}.`,
  open: (name: string) => `Open ${name}`,
  write: (name: string) => `Write ${name} again`,
  discard: (name: string) => `Discard ${name}`,
  closing: (name: string) => `What you typed in ${name} is in no file`,
  closingHint: {
    conflict: 'The file was changed elsewhere, and which text it is to have is not decided.',
    gone: 'The file was deleted elsewhere.',
    failed: 'It could not be written.',
    offline: 'The studio’s program is not there.',
  } as Record<string, string>,
  keep: 'Keep it open',
  discardText: 'Discard my text',
}
