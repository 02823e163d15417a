// What jobs found in a model, on its text and on the chart beside it: findings of a review, mutants that nobody noticed, what scenarios
// covered.
//
// In: the lines of a job. Out: faults of texts, and marks of shapes, until the text is another. INVARIANT: a shape is called covered only
// if places of the model are known to speak of it, and nothing of them was left out by the scenarios.

import { functionOf } from '../diagram/light'
import { type Shapes, type Speaking, meant } from '../diagram/places'
import type { Drawing, File, Position, Range } from '../diagram/protocol'
import { words } from '../words'
import type { Fault } from '../diagram/pick'
import type { Job, LinePlace, ToldFault } from './jobs'
import { Store } from './store'
import type { Studio } from './studio'

export interface Coverage {
  covered: boolean
  // What is missing.
  told: string[]
}

// By drawing and shape.
export type Covered = ReadonlyMap<string, ReadonlyMap<string, Coverage>>

export interface Mutant extends LinePlace {
  operator: string
  outcome: string
  before: string[]
  after: string[]
  why?: string
  states?: number
  // The components of a system that decide by it.
  components?: string[]
}

interface Uncovered extends LinePlace {
  what: string
  rule: string
}

export interface CoverageLine {
  model: string
  totals: { kind: string; covered: number; total: number }[]
  uncovered: Uncovered[]
}

const lines = (job: Job, type: string): Record<string, unknown>[] => job.lines.filter((line): line is Record<string, unknown> => typeof line === 'object' && line['type'] === type)

export const findings = (job: Job): { meta: string; finding: ToldFault }[] => lines(job, 'finding') as unknown as { meta: string; finding: ToldFault }[]
export const mutants = (job: Job): Mutant[] => lines(job, 'mutant') as unknown as Mutant[]
export const coverages = (job: Job): CoverageLine[] => lines(job, 'coverage') as unknown as CoverageLine[]

const squeezed = (text: string[]): string => text.join(' ').replace(/\s+/g, ' ').trim()

export const mutantTold = (mutant: Mutant): string => words.marks.survived([mutant.operator, ...(mutant.components ?? [])].join(', '), squeezed(mutant.before), squeezed(mutant.after))

export const rangeOf = (place: LinePlace): Range => ({
  start: { line: place.line - 1, character: place.column - 1 },
  end: { line: (place.end_line ?? place.line) - 1, character: (place.end_column ?? place.column) - 1 },
})

interface Found {
  range: Range
  message: string
  severity: Fault['severity']
  code: string
  // Of what was not covered: which part of which rule.
  what: string
  rule: string
}

const before = (a: Position, b: Position): boolean => a.line < b.line || (a.line === b.line && a.character <= b.character)

const UNCOVERED = 'uncovered'

// Of a rule that is marked as a whole, what is in it would look as if it were not covered either: its first line stands for it.
const headOf = ({ start, end }: Range): Range => ({ start, end: end.line === start.line ? end : { line: start.line, character: Infinity } })

// A rule that never ran at all.
const WHOLE = 'the whole'

// That no branch was taken says nothing of what is in the branches.
const isBeside = (item: Found): boolean => item.what === 'branch `no branch`'

// Whether what was not covered says something of the shapes. That the machine was in no other state says nothing of this one; and that
// a state is left for itself changes nothing, so no scenario covers the update.
function speaks(what: string, shapes: Shapes, drawings: readonly Drawing[]): boolean {
  if (what === 'branch `no branch`') return meant(shapes) !== shapes.state
  const [, written, value] = /^`([A-Za-z_]\w*)[^:=]*:=\s*([A-Za-z_]\w*)`$/.exec(what) ?? []
  if (written === undefined || shapes.state === null) return true
  const light = drawings.find((drawing) => drawing.name === shapes.drawing)?.lights[0]
  return !(light && functionOf(light.term) === written && light.shapes.some((shape) => shape.value === value && shape.shape === shapes.state))
}

export class Marks {
  // The coverage of charts, by their URIs.
  readonly covered = new Store<{ of: ReadonlyMap<string, Covered> }>({ of: new Map() })

  // When texts were last another.
  private readonly changed = new Map<string, number>()

  constructor(private readonly studio: Studio) {}

  // What a job found, by the files that it is in.
  texts(job: Job): Map<string, Fault[]> {
    const out = new Map<string, Fault[]>()
    for (const [uri, found] of this.found(job)) {
      out.set(uri, found.map(({ range, message, severity, code }) => ({ uri, range: code === UNCOVERED ? headOf(range) : range, message, severity, code })))
    }
    return out
  }

  private found(job: Job): Map<string, Found[]> {
    const out = new Map<string, Found[]>()
    const note = (place: LinePlace, message: string, severity: Fault['severity'], code: string, what = '', rule = ''): void => {
      const file = this.studio.named(place.file)
      if (file) out.set(file.uri, [...(out.get(file.uri) ?? []), { range: rangeOf(place), message, severity, code, what, rule }])
    }
    for (const { finding } of findings(job)) note(finding, finding.help ? `${finding.message}\n${words.check.help(finding.help)}` : finding.message, 'warning', finding.id)
    for (const mutant of mutants(job)) if (mutant.outcome === 'survived') note(mutant, mutantTold(mutant), 'warning', mutant.operator)
    for (const { uncovered } of coverages(job)) for (const item of uncovered) note(item, words.marks.uncovered(item.what, item.rule), 'info', UNCOVERED, item.what, item.rule)
    return out
  }

  // The same on the charts of the models: faults on shapes, and coverage.
  async charts(job: Job): Promise<Map<string, Fault[]>> {
    const out = new Map<string, Fault[]>()
    const found = this.found(job)
    const covers = coverages(job).map(({ model }) => this.studio.named(model)?.uri)
    const of = new Map<string, Covered>()
    for (const uri of new Set([...found.keys(), ...covers])) {
      const model = uri === undefined ? undefined : this.studio.file(uri)
      // What is said of a chart's own text stands on its shapes already.
      if (model?.kind === 'chart') continue
      const chart = model && this.studio.sibling(model, 'chart')
      const drawings = chart && this.studio.chart(chart.uri)?.store.get().pictures?.drawings
      // What a job said of another text is said of no shape.
      if (!model || !chart || !drawings || (this.changed.get(model.uri) ?? 0) >= job.began) continue
      const items = found.get(model.uri) ?? []
      const told = items.filter(({ code }) => code !== UNCOVERED)
      const shapes = await this.speaking(model, chart, told.map(({ range }) => range.start))
      const faults = told.flatMap((one, index): Fault[] => {
        const range = this.onChart(drawings, shapes[index]?.shapes ?? null)
        return range ? [{ uri: chart.uri, range, message: one.message, severity: one.severity, code: one.code }] : []
      })
      if (faults.length > 0) out.set(chart.uri, faults)
      if (covers.includes(model.uri)) of.set(chart.uri, await this.coverage(model, chart, drawings, items.filter(({ code }) => code === UNCOVERED)))
    }
    if (job.job === 'test') this.covered.set({ of })
    return out
  }

  // The coverage of a chart goes with the text that it was of.
  drop(uri: string): void {
    this.changed.set(uri, Date.now())
    const { of } = this.covered.get()
    const chart = this.studio.file(uri)?.kind === 'model' ? uri.replace(/\.asm$/, '.chart') : uri
    if (of.has(chart)) this.covered.set({ of: new Map([...of].filter(([known]) => known !== chart)) })
  }

  clear(): void {
    if (this.covered.get().of.size > 0) this.covered.set({ of: new Map() })
  }

  private onChart(drawings: readonly Drawing[], shapes: Shapes | null): Range | null {
    const id = shapes && meant(shapes)
    const drawing = shapes && drawings.find((drawing) => drawing.name === shapes.drawing)
    return (id && drawing?.picture.boxes.find((box) => box.id === id)?.range) || null
  }

  private async coverage(model: File, chart: File, drawings: readonly Drawing[], missing: Found[]): Promise<Covered> {
    const known = await this.speaking(model, chart, null)
    const all = new Map<string, Map<string, Coverage>>()
    const note = (shapes: Shapes | null, told: string | null): void => {
      if (!shapes) return
      const drawing = all.get(shapes.drawing) ?? new Map<string, Coverage>()
      all.set(shapes.drawing, drawing)
      // What is missing within a guard or an action is missing in its state, too.
      for (const id of new Set([meant(shapes), shapes.state])) {
        if (id === null) continue
        const former = drawing.get(id) ?? { covered: true, told: [] }
        drawing.set(id, told === null || former.told.includes(told) ? former : { covered: false, told: [...former.told, told] })
      }
    }
    for (const { position: here, shapes } of known) {
      note(shapes, null)
      // Of a rule that never ran only the name is told, and not its parts one by one.
      for (const item of missing) if (item.what === WHOLE && shapes?.rule === item.rule) note(shapes, item.message)
      for (const item of missing) if (!isBeside(item) && before(item.range.start, here) && before(here, item.range.end)) note(shapes, item.message)
    }
    const own = await this.speaking(model, chart, missing.map(({ range }) => range.start))
    own.forEach(({ shapes }, index) => {
      const item = missing[index]
      if (shapes && item && speaks(item.what, shapes, drawings)) note(shapes, item.message)
    })
    return all
  }

  // The shapes that places of a model speak of; without places, all that speak of shapes.
  private async speaking(model: File, chart: File, positions: Position[] | null): Promise<Speaking[]> {
    if (positions?.length === 0) return []
    await this.studio.document(model.uri)
    return this.studio.ask<Speaking[]>('groundstate/chart/places', { textDocument: { uri: chart.uri }, model: model.uri, positions })
  }
}
