// Which results are of texts that are others now.
//
// In: the texts that jobs looked at, the open documents, what others write. Out: a store, by the number of the job. It asks nothing while
// there is a connection: the server tells of each text that a job looked at.

import { type Known, changedOf } from '../diagram/currency'
import type { Changed } from '../diagram/protocol'
import type { Job } from './jobs'
import { Store } from './store'
import type { Studio } from './studio'

const AFTER_MS = 80

const CURRENT: readonly string[] = []

export class Currency {
  // The paths that are others, of each job that has some.
  readonly store = new Store<{ changed: ReadonlyMap<number, readonly string[]> }>({ changed: new Map() })
  // The hash of each file as it was seen last.
  private readonly hashes = new Map<string, string | null>()
  private timer: ReturnType<typeof setTimeout> | undefined

  constructor(private readonly studio: Studio) {
    studio.server.on<Changed>('studio/changed', ({ path, text, hash }) => {
      this.hashes.set(path, text === null ? null : hash)
      this.later()
    })
    studio.jobs.store.subscribe(() => this.later())
  }

  // A file has another name, or none.
  gone(path: string): void {
    this.hashes.set(path, null)
    this.later()
  }

  later(): void {
    this.timer ??= setTimeout(() => this.look(), AFTER_MS)
  }

  look(): void {
    clearTimeout(this.timer)
    this.timer = undefined
    const open = new Map<string, Known>()
    for (const doc of this.studio.openDocs) {
      const { sync } = doc.store.get()
      const saved = sync.text === sync.baseText && !sync.gone
      if (saved) this.hashes.set(doc.file.path, sync.base)
      open.set(doc.file.path, { hash: sync.base, text: sync.text, saved })
    }
    const known = (path: string): Known | undefined => {
      const hash = this.hashes.get(path)
      return open.get(path) ?? (hash === undefined ? undefined : { hash, text: null, saved: true })
    }
    const changed = new Map<number, readonly string[]>()
    for (const job of this.studio.jobs.store.get().jobs) {
      const others = changedOf(job.texts, known)
      if (others.length > 0) changed.set(job.id, others)
    }
    const before = this.store.get().changed
    const same = before.size === changed.size && [...changed].every(([id, paths]) => before.get(id)?.join() === paths.join())
    if (!same) this.store.set({ changed })
  }

  // The texts as a job begins with them.
  looked(texts: readonly { path: string; hash: string | null }[]): Job['texts'] {
    return texts.map(({ path, hash }) => {
      this.hashes.set(path, hash)
      const sync = this.studio.doc(this.studio.fileAt(path)?.uri ?? null)?.store.get().sync
      return { path, hash, text: sync && sync.base === hash ? sync.baseText : null }
    })
  }

  // After the connection was lost, what was changed meanwhile is not told.
  async again(): Promise<void> {
    const paths = new Set(this.studio.jobs.store.get().jobs.flatMap(({ texts }) => texts.map(({ path }) => path)))
    for (const path of paths) {
      const read = this.studio.server.request<{ hash: string }>('studio/read', { path })
      this.hashes.set(path, await read.then(({ hash }) => hash, () => null))
    }
    this.later()
  }
}

// The texts of a job that are others now.
export const changedSince = (changed: ReadonlyMap<number, readonly string[]>, job: Job): readonly string[] => changed.get(job.id) ?? CURRENT
