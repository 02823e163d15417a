// One open text: the CodeMirror view that holds it, its history, and its agreement with the file.
//
// Owns: the view (also while it is not on screen), undo and redo for all that edits the text, the saving. INVARIANT: the text is
// the single document. What the canvas does comes here as changes of the text, each one transaction.

import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from '@codemirror/autocomplete'
import { defaultKeymap, history, historyField, historyKeymap, indentWithTab, isolateHistory, redo, redoDepth, undo, undoDepth } from '@codemirror/commands'
import { bracketMatching, codeFolding, foldGutter, foldKeymap, indentUnit } from '@codemirror/language'
import { type Diagnostic, lintKeymap, setDiagnostics } from '@codemirror/lint'
import { LSPPlugin, formatKeymap, findReferencesKeymap, hoverTooltips, jumpToDefinitionKeymap, serverCompletion, signatureHelp } from '@codemirror/lsp-client'
import { highlightSelectionMatches, searchKeymap } from '@codemirror/search'
import { Annotation, ChangeSet, type ChangeSpec, EditorState, Transaction } from '@codemirror/state'
import { EditorView, crosshairCursor, drawSelection, dropCursor, highlightActiveLine, highlightActiveLineGutter, keymap, lineNumbers, rectangularSelection } from '@codemirror/view'

import type { File, Position, Range } from '../diagram/protocol'
import { type Effect, type Sync, type SyncEvent, opened, turn, writeAfter } from '../diagram/sync'
import type { Written } from '../diagram/protocol'
import { words } from '../words'
import { coloured, languageId } from './language'
import { type Mark, marks, setPicked, setRan } from './picked'
import { Store } from './store'
import type { Studio } from './studio'
import { editorTheme } from './theme'

// A change that did not come from the user's hands in the text.
const FromOutside = Annotation.define<true>()

export interface DocState {
  sync: Sync
  // How much there is to undo and to redo.
  undos: number
  redos: number
}

export class Doc {
  readonly store: Store<DocState>
  readonly view: EditorView
  private timer: ReturnType<typeof setTimeout> | undefined
  private ended = false
  // Since when a write waits.
  private waits: number | null = null
  // While a conflict is decided: the text as it is being put together.
  mine: string | null = null
  // What was changed since a group began.
  private group: ChangeSet | null = null
  // Called after each change of the text, and when the cursor is moved by hand.
  onText: (() => void)[] = []
  onCursor: ((at: Position) => void)[] = []

  constructor(
    private readonly studio: Studio,
    readonly file: File,
    text: string,
    hash: string | null,
    readonly readOnly: boolean,
    // The document that goes on in this one, because its file has another name.
    former?: Doc,
  ) {
    const before = former?.store.get() ?? { sync: opened(text, hash ?? ''), undos: 0, redos: 0 }
    this.store = new Store<DocState>({ ...before, sync: { ...before.sync, sent: null, passed: false } })
    const config = { extensions: this.extensions() }
    const state = former
      ? EditorState.fromJSON(former.view.state.toJSON({ history: historyField }), config, { history: historyField })
      : EditorState.create({ ...config, doc: text })
    this.view = new EditorView({ state })
    this.mine = former?.mine ?? null
  }

  private extensions() {
    return [
      // Files keep their line ends: what is before \n belongs to the line.
      EditorState.lineSeparator.of('\n'),
      EditorState.allowMultipleSelections.of(true),
      EditorState.tabSize.of(4),
      indentUnit.of('\t'),
      this.readOnly ? [EditorState.readOnly.of(true), EditorView.editable.of(false)] : [],
      EditorView.contentAttributes.of({ tabindex: '0', 'aria-label': words.text.label(this.file.path) }),
      lineNumbers(),
      foldGutter(),
      codeFolding(),
      history(),
      drawSelection(),
      dropCursor(),
      rectangularSelection(),
      crosshairCursor(),
      highlightActiveLine(),
      highlightActiveLineGutter(),
      bracketMatching(),
      closeBrackets(),
      highlightSelectionMatches({ minSelectionLength: 3 }),
      coloured(this.file.kind),
      autocompletion({ icons: false }),
      this.studio.client.plugin(this.file.uri, languageId(this.file.kind)),
      serverCompletion(),
      hoverTooltips({ hoverTime: 350 }),
      signatureHelp(),
      keymap.of([
        { key: 'F2', run: () => (this.studio.askRename(this), true) },
        ...closeBracketsKeymap,
        ...searchKeymap,
        ...historyKeymap,
        ...foldKeymap,
        ...completionKeymap,
        ...lintKeymap,
        ...formatKeymap,
        ...jumpToDefinitionKeymap,
        ...findReferencesKeymap,
        indentWithTab,
        ...defaultKeymap,
      ]),
      marks,
      editorTheme,
      EditorView.updateListener.of((update) => {
        if (update.docChanged) {
          if (this.group) this.group = this.group.compose(update.changes)
          const text = update.state.doc.toString()
          this.store.set({ undos: undoDepth(update.state), redos: redoDepth(update.state) })
          this.event({ kind: 'edited', text })
          for (const listener of this.onText) listener()
        }
        const byHand = update.transactions.some((t) => t.annotation(Transaction.userEvent) && !t.annotation(FromOutside))
        if (byHand && (update.selectionSet || update.docChanged) && this.view.hasFocus) {
          const at = this.positionAt(update.state.selection.main.head)
          for (const listener of this.onCursor) listener(at)
        }
      }),
    ]
  }

  get text(): string {
    return this.view.state.doc.toString()
  }

  positionAt(offset: number): Position {
    const line = this.view.state.doc.lineAt(Math.min(offset, this.view.state.doc.length))
    return { line: line.number - 1, character: offset - line.from }
  }

  offsetAt(position: Position): number {
    const { doc } = this.view.state
    if (position.line >= doc.lines) return doc.length
    const line = doc.line(position.line + 1)
    return Math.min(line.from + position.character, line.to)
  }

  // One transaction: what undo takes back at once.
  change(changes: ChangeSpec): void {
    const grouped = this.group !== null
    this.view.dispatch({
      changes,
      annotations: [
        FromOutside.of(true),
        Transaction.userEvent.of('diagram'),
        grouped ? Transaction.addToHistory.of(false) : isolateHistory.of('full'),
      ],
    })
  }

  // What a gesture changes by several operations is undone as one: the changes are taken back and made again at once.
  async grouped(work: () => Promise<void>): Promise<void> {
    const { doc } = this.view.state
    this.group = ChangeSet.empty(doc.length)
    try {
      await work()
    } finally {
      const all: ChangeSet = this.group
      this.group = null
      if (!all.empty) {
        const annotations = [FromOutside.of(true), Transaction.addToHistory.of(false)]
        this.view.dispatch({ changes: all.invert(doc), annotations })
        this.change(all)
      }
    }
  }

  undo(): void {
    undo(this.view)
  }

  redo(): void {
    redo(this.view)
  }

  // Puts a place of the text before the reader's eyes and the cursor at it.
  reveal(range: Range, focus: boolean): void {
    const from = this.offsetAt(range.start)
    const to = this.offsetAt(range.end)
    this.view.dispatch({
      selection: focus ? { anchor: from, head: to } : { anchor: from },
      effects: EditorView.scrollIntoView(from, { y: 'center', yMargin: 40 }),
      annotations: FromOutside.of(true),
    })
    if (focus) this.view.focus()
  }

  scrollTo(range: Range): void {
    const from = this.offsetAt(range.start)
    this.view.dispatch({ effects: EditorView.scrollIntoView(from, { y: 'nearest', yMargin: 60 }), annotations: FromOutside.of(true) })
  }

  // Shows the places of what is selected on the canvas.
  pick(ranges: readonly Range[], scroll: boolean): void {
    const picked: Mark[] = ranges.map((range) => ({
      from: this.offsetAt(range.start),
      to: this.offsetAt(range.end),
      kind: 'picked',
    }))
    const first = picked[0]
    const seen = first && this.view.visibleRanges.some(({ from, to }) => first.from >= from && first.to <= to)
    this.view.dispatch({
      effects: [
        setPicked.of(picked),
        ...(first && scroll ? [EditorView.scrollIntoView(first.from, { y: seen ? 'nearest' : 'center', yMargin: 60 })] : []),
      ],
      ...(first && scroll ? { selection: { anchor: first.from } } : {}),
      annotations: FromOutside.of(true),
    })
  }

  ran(places: { range: Range; kind: Mark['kind'] }[]): void {
    const found = places.map(({ range, kind }) => ({ from: this.offsetAt(range.start), to: this.offsetAt(range.end), kind }))
    this.view.dispatch({ effects: setRan.of(found), annotations: FromOutside.of(true) })
  }

  diagnose(faults: { range: Range; severity: Diagnostic['severity']; message: string; code: string }[]): void {
    const plugin = LSPPlugin.get(this.view)
    if (!plugin) return
    const length = plugin.syncedDoc.length
    const at = (position: Position): number => {
      const line = position.line >= plugin.syncedDoc.lines ? null : plugin.syncedDoc.line(position.line + 1)
      return plugin.unsyncedChanges.mapPos(line ? Math.min(line.from + position.character, line.to) : length)
    }
    const diagnostics = faults.map((fault): Diagnostic => {
      const from = at(fault.range.start)
      return { from, to: Math.max(from, at(fault.range.end)), severity: fault.severity, message: fault.message }
    })
    this.view.dispatch(setDiagnostics(this.view.state, diagnostics))
  }

  // Agreement with the file.

  event(event: SyncEvent): void {
    if (this.readOnly || this.ended) return
    const { state, effects } = turn(this.store.get().sync, event)
    this.store.set({ sync: state })
    for (const effect of effects) this.act(effect)
  }

  private act(effect: Effect): void {
    switch (effect.kind) {
      case 'schedule':
        clearTimeout(this.timer)
        this.waits ??= performance.now()
        this.timer = setTimeout(() => this.event({ kind: 'due' }), writeAfter(performance.now() - this.waits))
        return
      case 'apply':
        this.view.dispatch({
          changes: effect.changes,
          annotations: [FromOutside.of(true), Transaction.addToHistory.of(false), Transaction.remote.of(true)],
        })
        return
      case 'write':
        this.waits = null
        void this.write(effect.text, effect.base)
        return
      case 'read':
        void this.read()
    }
  }

  private async write(text: string, base: string | null): Promise<void> {
    try {
      const params = { path: this.file.path, text, base }
      const answer = await this.studio.server.request<Written>('studio/write', params)
      this.event({ kind: 'written', answer })
    } catch (error) {
      if (this.studio.server.online === 'open') this.event({ kind: 'failed', message: (error as Error).message })
    }
  }

  private async read(): Promise<void> {
    try {
      const params = { path: this.file.path }
      const { text, hash } = await this.studio.server.request<{ text: string; hash: string }>('studio/read', params)
      this.event({ kind: 'seen', hash, text })
    } catch {
      if (this.studio.server.online === 'open') this.event({ kind: 'gone' })
    }
  }

  // Writes at once, for what needs the file: jobs and sessions.
  async saved(): Promise<void> {
    clearTimeout(this.timer)
    this.event({ kind: 'due' })
    for (let tries = 0; tries < 100; tries++) {
      const { sync } = this.store.get()
      if (sync.conflict || sync.failure !== null || !sync.online) return
      if (sync.sent === null && sync.text === sync.baseText) return
      await new Promise((resolve) => setTimeout(resolve, 20))
      this.event({ kind: 'due' })
    }
  }

  // Sends what is not written yet, as far as it can be: the page may be gone in a moment.
  flush(): void {
    clearTimeout(this.timer)
    this.event({ kind: 'due' })
  }

  destroy(): void {
    this.ended = true
    clearTimeout(this.timer)
    this.view.destroy()
  }
}
