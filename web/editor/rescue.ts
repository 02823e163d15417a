// Texts that are in no file yet, kept in the browser: a page that is closed or loaded anew loses none of them.
//
// Owns: one entry of the browser's storage for each such text, of this folder. In: documents as they change. Out: a text that was kept is
// put back into its document when that is opened; the paths of those that wait. INVARIANT: what a file holds is kept no longer.

import { isDirty, status } from '../diagram/sync'
import type { Doc } from './document'
import { Store } from './store'
import type { Studio } from './studio'

const AFTER_MS = 300

export interface Kept {
  text: string
  // The hash of the file's text that it may be written over; null if that is to be decided.
  base: string | null
}

export class Rescue {
  // The paths of texts that were kept by an earlier page and not opened yet; and those that the browser could not keep.
  readonly store = new Store<{ waiting: readonly string[]; failed: ReadonlySet<string> }>({ waiting: [], failed: new Set() })
  private readonly timers = new Map<string, ReturnType<typeof setTimeout>>()

  constructor(private readonly studio: Studio) {
    const prefix = this.key('')
    const waiting = Object.keys(localStorage).filter((key) => key.startsWith(prefix))
    this.store.set({ waiting: waiting.map((key) => key.slice(prefix.length)).sort() })
    // The page that was left open may have written one meanwhile.
    window.addEventListener('storage', ({ key, newValue }) => newValue === null && key?.startsWith(prefix) && this.waitsNoLonger(key.slice(prefix.length)))
  }

  private waitsNoLonger(path: string): void {
    const { waiting } = this.store.get()
    if (waiting.includes(path)) this.store.set({ waiting: waiting.filter((one) => one !== path) })
  }

  private key(path: string): string {
    return `groundstate-kept ${this.studio.hello.root} ${path}`
  }

  // Follows a document. What is written in a moment needs no keeping.
  watch(doc: Doc): void {
    doc.store.subscribe(() => {
      const now = status(doc.store.get().sync)
      if (now === 'saving' || now === 'unsaved') return
      clearTimeout(this.timers.get(doc.file.path))
      if (now === 'saved') return this.drop(doc.file.path)
      this.timers.set(doc.file.path, setTimeout(() => this.now(doc), AFTER_MS))
    })
  }

  // Keeps a document at once, if its file does not hold it.
  now(doc: Doc): void {
    const { sync } = doc.store.get()
    if (isDirty(sync)) this.keep(doc.file.path, doc.mine ?? sync.text, sync.conflict ? null : sync.base)
  }

  private keep(path: string, text: string, base: string | null): void {
    const failed = new Set(this.store.get().failed)
    try {
      localStorage.setItem(this.key(path), JSON.stringify({ text, base } satisfies Kept))
      failed.delete(path)
    } catch {
      // There is no room for it, or the browser forbids it.
      failed.add(path)
    }
    if (failed.size !== this.store.get().failed.size) this.store.set({ failed })
  }

  kept(path: string): Kept | null {
    try {
      return JSON.parse(localStorage.getItem(this.key(path)) ?? 'null') as Kept | null
    } catch {
      return null
    }
  }

  drop(path: string): void {
    clearTimeout(this.timers.get(path))
    localStorage.removeItem(this.key(path))
    this.waitsNoLonger(path)
  }

  // Puts what was kept into a document that is opened.
  restore(doc: Doc): void {
    const kept = this.kept(doc.file.path)
    this.waitsNoLonger(doc.file.path)
    if (!kept) return
    doc.event({ kind: 'kept', text: kept.text, base: kept.base })
    if (!isDirty(doc.store.get().sync)) this.drop(doc.file.path)
  }
}
