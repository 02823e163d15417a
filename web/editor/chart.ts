// What is known of a chart beside its text: the picture, what is selected, which drawing is shown.
//
// Owns: asking for pictures (at most one at a time, the latest text wins; the last good picture stays while a broken text has
// none), operations one after another, and the selection both ways. INVARIANT: operations change the text alone; the picture
// comes from the server.

import type { Arrow, Drawing, Edited, Operation, Pictures, Position } from '../diagram/protocol'
import { NOTHING, type Selection, drawingAt, pickAt, rangesOf } from '../diagram/pick'
import { kept } from '../diagram/gestures'
import { stays } from '../diagram/machines'
import { changesOf, difference, rebased } from '../diagram/text'
import type { Doc } from './document'
import { Store } from './store'
import type { Studio } from './studio'

export interface ChartState {
  pictures: Pictures | null
  // The text has a fault that keeps it from being drawn: the picture is an earlier one.
  stale: boolean
  // The name of the drawing that is shown.
  shown: string | null
  selection: Selection
  // Counts the selections that were made in the text, so that the canvas can bring them into view.
  revealed: number
  // Counts refusals: what the canvas showed ahead goes back.
  refusals: number
}

export class Chart {
  readonly store = new Store<ChartState>({ pictures: null, stale: false, shown: null, selection: NOTHING, revealed: 0, refusals: 0 })
  private busy = false
  private again = false
  private frame = 0
  private queue: Promise<unknown> = Promise.resolve()
  // Shapes that an operation made, until a picture has them.
  private wanted: string[] = []
  // Names that were changed, until a picture has the new ones: what is said of the old one meanwhile is meant for the new one.
  private renamed = new Map<string, string>()

  constructor(
    private readonly studio: Studio,
    readonly doc: Doc,
  ) {
    doc.onText.push(() => this.refresh())
    doc.onCursor.push((at) => this.cursor(at))
    this.refresh()
  }

  get drawing(): Drawing | null {
    const { pictures, shown } = this.store.get()
    return pictures?.drawings.find((drawing) => drawing.name === shown) ?? pictures?.drawings[0] ?? null
  }

  // Asks for the picture of the present text, in the next frame.
  refresh(): void {
    if (this.frame !== 0) return
    this.frame = requestAnimationFrame(() => {
      this.frame = 0
      void this.ask()
    })
  }

  private async ask(): Promise<void> {
    if (this.busy) {
      this.again = true
      return
    }
    this.busy = true
    try {
      const params = { textDocument: { uri: this.doc.file.uri } }
      const pictures = await this.studio.ask<Pictures>('groundstate/chart/picture', params)
      const known = this.store.get().pictures
      // Without a drawing there is no machine, or none that could be read.
      const isBroken = pictures.guess === true || pictures.problems.length > 0
      if (isBroken && pictures.drawings.length === 0 && known && known.drawings.length > 0 && this.doc.text.trim() !== '') this.store.set({ stale: true })
      else this.show(pictures)
    } catch {
      if (this.studio.server.online === 'open') this.store.set({ stale: true })
    } finally {
      this.busy = false
      if (this.again) {
        this.again = false
        this.refresh()
      }
    }
  }

  private show(pictures: Pictures): void {
    const { shown, selection } = this.store.get()
    const names = (drawings: readonly Drawing[]): string[] => drawings.map((drawing) => drawing.name)
    const front = stays(names(this.store.get().pictures?.drawings ?? []), shown, names(pictures.drawings))
    const drawing = pictures.drawings.find((drawing) => drawing.name === front)
    const there = (id: string): boolean => drawing?.picture.boxes.some((box) => box.id === id) ?? false
    const made = this.wanted.length > 0 && this.wanted.every(there) ? this.wanted : null
    if (made) this.wanted = []
    for (const [old, name] of this.renamed) if (there(name)) this.renamed.delete(old)
    const boxes = made ?? selection.boxes.filter(there)
    // Lines are known by their index alone: a new picture may count them otherwise.
    const same = this.store.get().pictures?.drawings.find((old) => old.name === drawing?.name)
    const lines = same && drawing && same.picture.lines.length === drawing.picture.lines.length ? selection.lines : []
    const kept = !made && boxes.length === selection.boxes.length && lines.length === selection.lines.length
    this.store.set({
      pictures,
      stale: false,
      shown: drawing?.name ?? null,
      ...(kept ? {} : { selection: { boxes, lines } }),
    })
    this.mark(false)
  }

  // Shows another drawing of this chart.
  turnTo(name: string): void {
    if (this.store.get().shown === name) return
    this.store.set({ shown: name, selection: NOTHING })
    this.mark(false)
  }

  // What is selected on the canvas is shown in the text.
  select(selection: Selection): void {
    const old = this.store.get().selection
    const same = (a: readonly unknown[], b: readonly unknown[]): boolean => a.length === b.length && a.every((x, i) => x === b[i])
    if (same(old.boxes, selection.boxes) && same(old.lines, selection.lines)) return
    this.store.set({ selection })
    this.mark(true)
  }

  private mark(scroll: boolean): void {
    const drawing = this.drawing
    if (drawing) this.doc.pick(rangesOf(drawing, this.store.get().selection), scroll)
  }

  // The cursor in the text selects on the canvas.
  cursor(at: Position): void {
    const { pictures } = this.store.get()
    const drawing = pictures && drawingAt(pictures.drawings, at)
    if (!drawing) return
    const selection = pickAt(drawing, at)
    this.store.set((state) => ({ shown: drawing.name, selection, revealed: state.revealed + 1 }))
    this.mark(false)
  }

  // Does an operation on the shown drawing; resolves to the ids that it selects, or null if it was refused.
  // Whoever asked may tell of a refusal at its own place.
  operate(operation: Operation, options: { select?: boolean; refused?: (reason: string) => void } = {}): Promise<string[] | null> {
    const next = this.queue.then(() => this.perform(operation, options))
    this.queue = next.catch(() => null)
    return next
  }

  private async perform(asked: Operation, options: { select?: boolean; refused?: (reason: string) => void }): Promise<string[] | null> {
    const known = 'id' in asked ? this.renamed.get(asked.id) : undefined
    const operation = known === undefined ? asked : ({ ...asked, id: known } as Operation)
    const shown = this.drawing
    const drawing = shown?.name ?? ''
    if (this.doc.readOnly) return null
    const before = this.doc.text
    try {
      const params = { textDocument: { uri: this.doc.file.uri }, drawing, operation, ...(shown ? kept(shown, operation) : {}) }
      const { edits, select } = await this.studio.ask<Edited>('groundstate/chart/edit', params)
      let changes = changesOf(before, edits)
      if (this.doc.text !== before) {
        const carried = rebased(changes, difference(before, this.doc.text))
        if (!carried) return null
        changes = carried
      }
      if (changes.length > 0) this.doc.change(changes)
      if (operation.kind === 'rename') this.renamed.set(operation.id, operation.name)
      if (operation.kind === 'machine') this.store.set({ shown: operation.name, selection: NOTHING })
      else if (options.select !== false && operation.kind !== 'move') this.selectWhenThere(select)
      return select
    } catch (error) {
      if (options.refused) options.refused((error as Error).message)
      else this.studio.tell((error as Error).message, 'refused')
      this.store.set((state) => ({ refusals: state.refusals + 1 }))
      return null
    }
  }

  // Selects shapes as soon as a picture has them.
  selectWhenThere(ids: string[]): void {
    this.wanted = ids
    if (ids.length === 0) this.store.set({ selection: NOTHING })
    this.refresh()
  }

  // Several operations that are undone as one.
  async operateAll(operations: Operation[]): Promise<void> {
    const [only] = operations
    if (only && operations.length === 1) return void (await this.operate(only))
    await this.doc.grouped(async () => {
      for (const operation of operations) await this.operate(operation)
    })
  }

  // A new shape, and the arrow between it and what is there. Out: its id.
  async grow(add: Operation, arrow: (id: string) => Arrow): Promise<string | null> {
    let id: string | undefined
    await this.doc.grouped(async () => {
      id = (await this.operate(add))?.[0]
      if (id !== undefined) await this.operate({ kind: 'connect', ...arrow(id) }, { select: false })
    })
    return id ?? null
  }
}
