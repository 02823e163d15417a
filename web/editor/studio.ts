// The whole of an open folder: its files, the texts that are open, the language client, faults, what is shown.
//
// Owns: opening and closing, which file and drawing is in front, the address of both, renaming in all files, notices. In: the
// server. It must not know how anything looks.

import { LSPClient } from '@codemirror/lsp-client'

import { type Fault, type Severity, isSame } from '../diagram/pick'
import type { Changed, File, Hello, Place, Range, TextEdit } from '../diagram/protocol'
import { isAtRisk, isDirty, status } from '../diagram/sync'
import { changesOf } from '../diagram/text'
import { words } from '../words'
import { Chart } from './chart'
import { Currency } from './currency'
import { Doc } from './document'
import { Files } from './files'
import { Jobs } from './jobs'
import { Marks } from './marks'
import type { OfChart } from './ofChart'
import { Rescue } from './rescue'
import { Runner } from './run'
import { sanitized } from './sanitize'
import { quiet } from './quiet'
import { type Online, type Server, type Transport, isLost } from './server'
import { Store } from './store'
import { Texts } from './texts'

export type Layout = 'both' | 'picture' | 'text'
export type Panel = 'problems' | 'run' | 'timeline' | 'check' | 'graph' | 'times' | 'code'
export type Dialog =
  | { kind: 'search' }
  | { kind: 'new' }
  | { kind: 'keys' }
  | { kind: 'rename'; old: string; uri: string; at: { line: number; character: number } }
  | { kind: 'machine'; uri: string }
  | { kind: 'renameMachine' | 'deleteMachine'; uri: string; name: string }
  | { kind: 'renameFile' | 'deleteFile'; file: File }
  // A text that is in no file is to be closed.
  | { kind: 'closing'; uri: string }
  // The model of a chart is not the one that it would be built to.
  | { kind: 'older'; asked: OfChart; model: File; state: 'differs' | 'faulty' | 'unknown' }

export interface Notice {
  text: string
  tone: 'told' | 'refused'
  // What can be done about it.
  action: { name: string; act: () => void } | null
  count: number
}

export interface StudioState {
  online: Online
  hello: Hello | null
  files: File[]
  tabs: string[]
  active: string | null
  layout: Layout
  // There is room for one pane alone.
  narrow: boolean
  panel: Panel | null
  // The results need more room than the panel has.
  tall: boolean
  // The text beside a chart: its own, or its model's.
  beside: 'chart' | 'model'
  faults: ReadonlyMap<string, Fault[]>
  notice: Notice | null
  dialog: Dialog | null
  // Where one came from by double-clicking, the last one last.
  trail: { uri: string; drawing: string }[]
  // Counts documents that were opened, so that views look again.
  opened: number
}

// Where there is no room for both, the picture comes first.
export const layoutShown = ({ layout, narrow }: StudioState): Layout => (narrow && layout === 'both' ? 'picture' : layout)

interface Published {
  uri: string
  version?: number
  diagnostics: { range: Range; severity?: number; message: string; code?: string | number }[]
}

// The server gave an answer up because the text changed.
const CONTENT_MODIFIED = -32801
const PATIENCE_MS = 6000

const SEVERITIES: Severity[] = ['error', 'error', 'warning', 'info', 'hint']

export class Studio {
  readonly store = new Store<StudioState>({
    online: 'connecting',
    hello: null,
    files: [],
    tabs: [],
    active: null,
    layout: 'both',
    narrow: false,
    panel: null,
    tall: false,
    beside: 'chart',
    faults: new Map(),
    notice: null,
    dialog: null,
    trail: [],
    opened: 0,
  })
  readonly client: LSPClient
  readonly runner: Runner
  readonly jobs: Jobs
  readonly marks: Marks
  readonly currency: Currency
  readonly rescue: Rescue
  readonly files: Files
  private readonly docs = new Map<string, Doc>()
  private readonly charts = new Map<string, Chart>()
  private readonly opening = new Map<string, Promise<Doc | null>>()
  // Faults by what told them: the language server, and the last job.
  private readonly told = new Map<string, Fault[]>()
  private found = new Map<string, Fault[]>()
  private notices = 0
  // Who waits for a language session to begin.
  private readonly beginning = new Set<() => void>()
  private readonly transport: Transport

  constructor(
    readonly server: Server,
    readonly hello: Hello,
  ) {
    this.client = new LSPClient({
      rootUri: hello.root,
      timeout: 120_000,
      sanitizeHTML: sanitized,
      workspace: (client) => new Texts(client, this),
      notificationHandlers: {
        'textDocument/publishDiagnostics': (_, params: Published) => (this.published(params), true),
        'window/logMessage': () => true,
      },
    })
    this.runner = new Runner(this)
    this.jobs = new Jobs(this)
    this.marks = new Marks(this)
    this.currency = new Currency(this)
    this.rescue = new Rescue(this)
    this.files = new Files(this)
    this.store.set({ online: server.online, hello, files: hello.files })
    this.transport = quiet(server.transport)
    this.client.connect(this.transport)
    server.on<Changed>('studio/changed', (params) => this.changedOutside(params))
    server.on<{ files: File[] }>('studio/files', ({ files }) => this.store.set({ files }))
    server.watch((online) => this.connection(online))
  }

  // A question about texts: the language server has them as they are now. INVARIANT: the client sends changes after a promise, so a
  // question waits for the same one, or it would come before them.
  // If the text changed before the answer was there, it asks again.
  async ask<Result>(method: string, params: unknown): Promise<Result> {
    const until = performance.now() + PATIENCE_MS
    for (let tries = 0; ; tries++) {
      this.client.sync()
      await this.begun()
      try {
        return await this.server.request<Result>(method, params)
      } catch (error) {
        if ((error as { code?: number }).code !== CONTENT_MODIFIED || performance.now() > until) throw error
        await new Promise((resolve) => setTimeout(resolve, Math.min(20 * tries, 150)))
      }
    }
  }

  // The language session. Of one that never begins, because the connection breaks before, nothing is heard: whoever waits is told.
  private begun(): Promise<unknown> {
    if (this.server.online !== 'open') return Promise.reject(new Error(words.shell.connectionLost))
    return new Promise((done, failed) => {
      const lost = (): void => failed(new Error(words.shell.connectionLost))
      this.beginning.add(lost)
      this.client.initializing.then(done, failed).finally(() => this.beginning.delete(lost))
    })
  }

  private connection(online: Online): void {
    const before = this.store.get().online
    this.store.set({ online })
    // Why there is none may be known only later.
    if (isLost(online) && !isLost(before)) {
      for (const doc of this.docs.values()) doc.event({ kind: 'offline' })
      this.client.disconnect()
      for (const lost of this.beginning) lost()
      this.beginning.clear()
      this.runner.lost()
      this.jobs.lost()
    }
    // If it breaks again meanwhile, the next connection begins anew.
    if (online === 'open') void this.again().catch(() => undefined)
  }

  // After the connection came back: a new language session with the texts as they are, and a look at the files.
  private async again(): Promise<void> {
    this.client.workspace.syncFiles()
    this.client.connect(this.transport)
    const hello = await this.server.request<Hello>('studio/hello', {})
    this.store.set({ hello, files: hello.files })
    for (const doc of this.docs.values()) doc.event({ kind: 'online' })
    for (const chart of this.charts.values()) chart.refresh()
    await this.currency.again()
  }

  private changedOutside({ path, hash, text }: Changed): void {
    const file = this.store.get().files.find((file) => file.path === path)
    const doc = file && this.docs.get(file.uri)
    if (file) this.marks.drop(file.uri)
    if (doc) doc.event(text === null ? { kind: 'gone' } : { kind: 'seen', hash, text })
    this.redraw()
  }

  // Pictures hang on the files that charts import, too.
  redraw(): void {
    for (const chart of this.charts.values()) chart.refresh()
  }

  private published({ uri, diagnostics, version }: Published): void {
    const file = this.client.workspace.getFile(uri)
    if (file && version !== undefined && version !== null && version !== file.version) return
    const faults = diagnostics.map(
      (item): Fault => ({
        uri,
        range: item.range,
        severity: SEVERITIES[item.severity ?? 1] ?? 'error',
        message: item.message,
        code: String(item.code ?? ''),
      }),
    )
    this.told.set(uri, faults)
    this.merge(uri)
  }

  // What the last job found, until the text is another.
  find(findings: ReadonlyMap<string, Fault[]>): void {
    const before = [...this.found.keys()]
    this.found = new Map(findings)
    for (const uri of new Set([...before, ...findings.keys()])) this.merge(uri)
  }

  private merge(uri: string): void {
    const told = this.told.get(uri) ?? []
    const faults = [...told, ...(this.found.get(uri) ?? []).filter((fault) => !told.some((other) => isSame(other, fault)))]
    const all = new Map(this.store.get().faults)
    if (faults.length > 0) all.set(uri, faults)
    else all.delete(uri)
    this.store.set({ faults: all })
    this.docs.get(uri)?.diagnose(faults)
  }

  tell(text: string, tone: Notice['tone'] = 'told', action: Notice['action'] = null): void {
    this.store.set({ notice: { text, tone, action, count: ++this.notices } })
  }

  // Files.

  file(uri: string): File | undefined {
    const { files, hello } = this.store.get()
    return files.find((file) => file.uri === uri) ?? hello?.library.find((file) => file.uri === uri)
  }

  fileAt(path: string): File | undefined {
    return this.store.get().files.find((file) => file.path === path)
  }

  // The file that a job speaks of: it names files as they were given to it, so the end of the path decides.
  named(path: string): File | undefined {
    const { files } = this.store.get()
    const clean = path.replaceAll('\\', '/').replace(/^\.\//, '')
    return files.find((file) => clean === file.path || clean.endsWith(`/${file.path}`)) ?? files.find((file) => file.path.endsWith(`/${clean}`))
  }

  // A file with the same name but another ending: the model of a chart.
  sibling(file: File, ending: string): File | undefined {
    return this.file(file.uri.replace(/\.[^./]*$/, `.${ending}`))
  }

  isLibrary(uri: string): boolean {
    return !this.store.get().files.some((file) => file.uri === uri)
  }

  doc(uri: string | null): Doc | undefined {
    return uri === null ? undefined : this.docs.get(uri)
  }

  chart(uri: string | null): Chart | undefined {
    return uri === null ? undefined : this.charts.get(uri)
  }

  get openDocs(): Doc[] {
    return [...this.docs.values()]
  }

  // The document of a file, read if need be; it is not brought to the front.
  document(uri: string): Promise<Doc | null> {
    const known = this.docs.get(uri)
    if (known) return Promise.resolve(known)
    const begun = this.opening.get(uri)
    if (begun) return begun
    const promise = this.load(uri).finally(() => this.opening.delete(uri))
    this.opening.set(uri, promise)
    return promise
  }

  private async load(uri: string): Promise<Doc | null> {
    const own = this.store.get().files.find((file) => file.uri === uri)
    const file: File = own ?? this.file(uri) ?? { uri, path: decodeURIComponent(uri.split('/').at(-1) ?? uri), kind: kindOf(uri) }
    try {
      const params = own ? { path: own.path } : { uri }
      const { text, hash } = await this.server.request<{ text: string; hash?: string }>('studio/read', params)
      const readOnly = !own || this.hello.readOnly
      const doc = new Doc(this, file, text, hash ?? null, readOnly)
      this.begin(doc)
      return doc
    } catch (error) {
      this.tell((error as Error).message, 'refused')
      return null
    }
  }

  private begin(doc: Doc): void {
    const { file } = doc
    const { uri } = file
    this.docs.set(uri, doc)
    doc.onText.push(() => {
      if (this.found.delete(uri)) this.merge(uri)
      this.marks.drop(uri)
    })
    doc.store.subscribe(() => this.currency.later())
    if (!doc.readOnly) {
      this.rescue.watch(doc)
      this.rescue.restore(doc)
    }
    if (file.kind === 'chart') this.charts.set(uri, new Chart(this, doc))
    const faults = this.store.get().faults.get(uri)
    if (faults) doc.diagnose(faults)
    this.runner.markAgain()
    this.store.set((state) => ({ opened: state.opened + 1 }))
  }

  // A file has another name: what is open of it goes on under that, with what was typed and can be undone.
  follow(path: string, file: File): void {
    const old = this.openDocs.find((doc) => doc.file.path === path)
    const named = <T extends { uri: string }>(one: T): T => (old && one.uri === old.file.uri ? { ...one, uri: file.uri } : one)
    this.store.set(({ files }) => ({ files: files.map((one) => (one.path === path ? file : one)) }))
    this.currency.gone(path)
    if (!old) return
    const { uri } = old.file
    const shown = this.charts.get(uri)?.store.get().shown
    this.forget(old)
    const doc = new Doc(this, file, old.text, null, old.readOnly, old)
    this.begin(doc)
    if (typeof shown === 'string') this.charts.get(file.uri)?.turnTo(shown)
    this.rescue.now(doc)
    this.rescue.drop(path)
    // What the file holds now, and what is to be written.
    doc.event({ kind: 'online' })
    this.told.delete(uri)
    this.found.delete(uri)
    this.merge(uri)
    this.store.set(({ tabs, active, trail }) => ({
      tabs: tabs.map((tab) => (tab === uri ? file.uri : tab)),
      active: active === uri ? file.uri : active,
      trail: trail.map(named),
    }))
    if (this.runner.store.get().file?.uri === uri) void this.runner.close()
  }

  // Brings a file to the front, and a place or a drawing of it before the eyes.
  async open(uri: string, where: { range?: Range; drawing?: string; focus?: boolean } = {}): Promise<Doc | null> {
    const doc = await this.document(uri)
    if (!doc) return null
    this.store.set((state) => ({
      active: uri,
      tabs: state.tabs.includes(uri) ? state.tabs : [...state.tabs, uri],
      beside: state.active === uri ? state.beside : 'chart',
    }))
    if (where.drawing !== undefined) this.chart(uri)?.turnTo(where.drawing)
    const { range } = where
    if (range) {
      if (layoutShown(this.store.get()) === 'picture') this.store.set({ layout: this.store.get().narrow ? 'text' : 'both' })
      requestAnimationFrame(() => doc.reveal(range, where.focus ?? true))
    }
    return doc
  }

  // From a shape into the drawing that it stands for; `back` leads out again.
  async enter(uri: string, drawing: string): Promise<void> {
    const { active, trail } = this.store.get()
    const here = this.chart(active)?.drawing?.name
    await this.open(uri, { drawing })
    if (active !== null && here !== undefined) this.store.set({ trail: [...trail, { uri: active, drawing: here }] })
  }

  async back(index: number): Promise<void> {
    const { trail } = this.store.get()
    const to = trail[index]
    if (!to) return
    await this.open(to.uri, { drawing: to.drawing })
    this.store.set({ trail: trail.slice(0, index) })
  }

  // Closes a file; one whose text is in no file only if the user says so.
  close(uri: string): void {
    const sync = this.docs.get(uri)?.store.get().sync
    const now = sync && status(sync)
    if (now === 'conflict' || now === 'gone' || now === 'failed' || (now === 'offline' && sync && isDirty(sync))) {
      return this.store.set({ dialog: { kind: 'closing', uri } })
    }
    this.closeTab(uri)
    const doc = this.docs.get(uri)
    if (!doc) return
    void doc.saved().then(() => {
      // It may have been opened again, or stand beside a chart.
      const { sync } = doc.store.get()
      if (!this.store.get().tabs.includes(uri) && !isAtRisk(sync)) this.forget(doc)
    })
  }

  // Closes a file whose text is in no file: the text is given up.
  discard(uri: string): void {
    this.closeTab(uri)
    const doc = this.docs.get(uri)
    if (!doc) return
    this.forget(doc)
    this.rescue.drop(doc.file.path)
  }

  private closeTab(uri: string): void {
    const { tabs, active } = this.store.get()
    const index = tabs.indexOf(uri)
    const left = tabs.filter((tab) => tab !== uri)
    this.store.set({ tabs: left, ...(active === uri ? { active: left[Math.min(index, left.length - 1)] ?? null } : {}) })
  }

  private forget(doc: Doc): void {
    // What its file holds is known for the last time.
    this.currency.look()
    const { uri } = doc.file
    this.docs.delete(uri)
    this.charts.delete(uri)
    doc.destroy()
    this.store.set((state) => ({ opened: state.opened + 1 }))
  }

  // The page may be gone in a moment: what can be written is, and the rest is kept. Out: whether something could be lost.
  flush(): boolean {
    const open = this.openDocs.filter((doc) => !doc.readOnly)
    for (const doc of open) {
      this.rescue.now(doc)
      doc.flush()
    }
    return open.some((doc) => isAtRisk(doc.store.get().sync))
  }

  // A place in the model of the chart in front is shown beside the picture.
  async show(place: Place, focus = true): Promise<void> {
    if (this.besideModel(place.uri)) {
      const doc = await this.document(place.uri)
      requestAnimationFrame(() => doc?.reveal(place.range, focus))
    } else await this.open(place.uri, { range: place.range, focus })
  }

  // Puts a model's text beside the picture, if it is that of the chart in front.
  besideModel(uri: string): boolean {
    const { active } = this.store.get()
    const layout = layoutShown(this.store.get())
    const front = active === null ? undefined : this.file(active)
    if (front?.kind !== 'chart' || this.sibling(front, 'asm')?.uri !== uri || layout === 'picture') return false
    this.store.set({ beside: 'model' })
    return true
  }

  // Renaming.

  askRename(doc: Doc): void {
    const { state } = doc.view
    const word = state.wordAt(state.selection.main.head)
    if (!word) return this.tell(words.rename.nothing, 'refused')
    this.store.set({
      dialog: { kind: 'rename', old: state.sliceDoc(word.from, word.to), uri: doc.file.uri, at: doc.positionAt(word.from) },
    })
  }

  async rename(uri: string, position: { line: number; character: number }, newName: string): Promise<boolean> {
    try {
      const params = { textDocument: { uri }, position, newName }
      const edit = await this.ask<WorkspaceEdit | null>('textDocument/rename', params)
      return edit !== null && (await this.apply(edit))
    } catch (error) {
      this.tell((error as Error).message, 'refused')
      return false
    }
  }

  private async apply(edit: WorkspaceEdit): Promise<boolean> {
    const all = new Map<string, TextEdit[]>(Object.entries(edit.changes ?? {}))
    for (const { textDocument, edits } of edit.documentChanges ?? []) all.set(textDocument.uri, edits)
    const targets: [Doc, TextEdit[]][] = []
    for (const [uri, edits] of all) {
      const doc = await this.document(uri)
      if (!doc || doc.readOnly) {
        this.tell(words.rename.readOnly, 'refused')
        return false
      }
      targets.push([doc, edits])
    }
    for (const [doc, edits] of targets) doc.change(changesOf(doc.text, edits))
    return true
  }

  // Looks at the folder's files at once, without waiting to be told.
  async look(): Promise<void> {
    const { files } = await this.server.request<Hello>('studio/hello', {})
    this.store.set({ files })
  }

  // A new project from a template.
  async create(template: string, name: string): Promise<boolean> {
    try {
      const { open } = await this.server.request<{ open: string }>('studio/new', { template, name })
      await this.look()
      const file = this.fileAt(open)
      if (file) await this.open(file.uri)
      return true
    } catch (error) {
      this.tell((error as Error).message, 'refused')
      return false
    }
  }

  // A new file with this text; opened.
  async write(path: string, text: string): Promise<boolean> {
    try {
      await this.server.request('studio/write', { path, text, base: null })
      await this.look()
      const file = this.fileAt(path)
      if (file) await this.open(file.uri)
      return true
    } catch (error) {
      this.tell((error as Error).message, 'refused')
      return false
    }
  }

  async saveAll(): Promise<void> {
    await Promise.all(this.openDocs.map((doc) => (doc.readOnly ? null : doc.saved())))
  }
}

interface WorkspaceEdit {
  changes?: Record<string, TextEdit[]>
  documentChanges?: { textDocument: { uri: string }; edits: TextEdit[] }[]
}

function kindOf(uri: string): File['kind'] {
  if (uri.endsWith('.chart')) return 'chart'
  if (uri.endsWith('.avalla')) return 'scenario'
  return 'model'
}
