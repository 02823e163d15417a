// Files that get another name, are deleted, and put back; charts that are made of models.
//
// In: a file of the list. Out: the disk's file is another, what is open of it goes on, and what names it names it again. INVARIANT: a text
// that is in no file yet is neither renamed nor deleted; what was deleted is kept as long as the page is open.

import { folderOf, stemOf, withStem } from '../diagram/names'
import type { File, Named, Names, Renamed } from '../diagram/protocol'
import { isAtRisk } from '../diagram/sync'
import { changesOf } from '../diagram/text'
import { words } from '../words'
import { lastName } from './ofChart'
import { Store } from './store'
import type { Studio } from './studio'

export interface Deleted {
  path: string
  text: string
}

export class Files {
  readonly store = new Store<{ deleted: readonly Deleted[] }>({ deleted: [] })

  constructor(private readonly studio: Studio) {
    studio.server.on<{ files: Renamed[] }>('studio/renamed', ({ files }) => this.follow(files))
  }

  // What names files, as they are on the disk.
  async names(files: readonly File[]): Promise<Names[]> {
    await this.studio.saveAll()
    return Promise.all(files.map(({ path }) => this.studio.server.request<Names>('studio/names', { path })))
  }

  // Gives files another name, and puts it where they are named.
  async rename(files: readonly File[], stem: string): Promise<boolean> {
    const { studio } = this
    try {
      const names = await this.names(files)
      if (files.some((file) => this.isUndecided(file))) return false
      const olds = files.map(({ path }) => ({ path, to: withStem(path, stem) }))
      const { files: renamed } = await studio.server.request<{ files: Renamed[] }>('studio/rename', { files: olds })
      this.follow(renamed)
      const places = files.flatMap((file, index) => (names[index]?.places ?? []).map((place) => ({ ...place, old: stemOf(file.path) })))
      const now = (path: string): string => renamed.find((one) => one.path === path)?.to ?? path
      const left = await this.write(places.filter(({ follows }) => follows).map((place) => ({ ...place, path: now(place.path) })), stem)
      studio.tell(words.files.renamed(lastName(files[0]?.path ?? ''), lastName(now(files[0]?.path ?? ''))))
      if (left.length > 0) studio.tell(words.files.notFollowed(left.map(lastName)), 'refused')
      return true
    } catch (error) {
      studio.tell((error as Error).message, 'refused')
      return false
    }
  }

  private follow(renamed: readonly Renamed[]): void {
    for (const { path, to, uri } of renamed) {
      const file = this.studio.fileAt(path)
      if (file) this.studio.follow(path, { ...file, path: to, uri })
    }
  }

  // Writes the new name where files are named. Out: the files where there is something else by now.
  private async write(places: readonly (Named & { old: string })[], stem: string): Promise<string[]> {
    const left = new Set<string>()
    for (const path of new Set(places.map((place) => place.path))) {
      const file = this.studio.fileAt(path)
      const doc = file && (await this.studio.document(file.uri))
      const own = places.filter((place) => place.path === path)
      const isThere = ({ range, old }: (typeof own)[number]): boolean => doc?.view.state.sliceDoc(doc.offsetAt(range.start), doc.offsetAt(range.end)) === old
      if (!doc || doc.readOnly || !own.every(isThere)) {
        left.add(path)
        continue
      }
      doc.change(changesOf(doc.text, own.map(({ range }) => ({ range, newText: stem }))))
    }
    // The language server hears of it though nobody asks: what it said of the former name is over.
    this.studio.client.sync()
    return [...left]
  }

  // Whether what a file is to hold is still to be decided; it is told.
  private isUndecided(file: File): boolean {
    const doc = this.studio.doc(file.uri)
    if (!doc || !isAtRisk(doc.store.get().sync)) return false
    this.studio.tell(words.files.undecided(lastName(file.path)), 'refused')
    return true
  }

  async remove(file: File): Promise<boolean> {
    const { studio } = this
    try {
      await studio.doc(file.uri)?.saved()
      if (this.isUndecided(file)) return false
      const { text } = await studio.server.request<{ text: string }>('studio/delete', { path: file.path })
      const { path } = file
      this.store.set(({ deleted }) => ({ deleted: [...deleted.filter((one) => one.path !== path), { path, text }] }))
      studio.store.set(({ files }) => ({ files: files.filter((one) => one.path !== path) }))
      studio.discard(file.uri)
      studio.currency.gone(path)
      studio.tell(words.files.deleted(lastName(path)), 'told', { name: words.files.putBack, act: () => void this.putBack(path) })
      return true
    } catch (error) {
      studio.tell((error as Error).message, 'refused')
      return false
    }
  }

  // The chart of a model's rules, in a new file beside it.
  async extract(model: File): Promise<void> {
    try {
      await this.studio.saveAll()
      const { text } = await this.studio.server.request<{ text: string }>('studio/extract', { path: model.path })
      const path = `${folderOf(model.path)}${stemOf(model.path)}.chart`
      if (await this.studio.write(path, text)) this.studio.tell(words.files.extracted(lastName(path), lastName(model.path)))
    } catch (error) {
      this.studio.tell((error as Error).message, 'refused')
    }
  }

  // Whether a chart may be made of a file: it is a model that has none.
  mayExtract(file: File): boolean {
    const { studio } = this
    return file.kind === 'model' && !studio.hello.readOnly && !studio.isLibrary(file.uri) && !studio.sibling(file, 'chart')
  }

  async putBack(path: string): Promise<void> {
    const text = this.store.get().deleted.find((one) => one.path === path)?.text
    if (text === undefined || !(await this.studio.write(path, text))) return
    this.store.set(({ deleted }) => ({ deleted: deleted.filter((one) => one.path !== path) }))
  }
}
