// Shapes ↔ text: which shape a place in the text speaks of, and which places speak of a shape.
//
// In: the drawings of a chart, positions and ranges of its text. Out: ids of boxes, indices of lines, ranges.

import type { Box, Drawing, Line, Position, Range } from './protocol'
import { comparePositions, contains, overlap } from './text'

export interface Selection {
  // Ids of boxes.
  boxes: string[]
  // Indices of lines.
  lines: number[]
}

export const NOTHING: Selection = { boxes: [], lines: [] }

const size = (range: Range): number =>
  (range.end.line - range.start.line) * 10_000 + range.end.character - range.start.character

// The drawing whose section holds a position.
export const drawingAt = (drawings: readonly Drawing[], at: Position): Drawing | undefined =>
  drawings.find((drawing) => contains(drawing.range, at))

// What a position in the text speaks of: the smallest declaration around it, else the arrow.
export function pickAt(drawing: Drawing, at: Position): Selection {
  const boxes = drawing.picture.boxes.filter((box) => box.range && contains(box.range, at))
  boxes.sort((a, b) => size(a.range as Range) - size(b.range as Range))
  const first = boxes[0]
  if (first) return { boxes: [first.id], lines: [] }
  const line = drawing.picture.lines.findIndex((line) => line.range && contains(line.range, at))
  return line < 0 ? NOTHING : { boxes: [], lines: [line] }
}

// The places in the text that speak of what is selected, in the order of the text.
export function rangesOf(drawing: Drawing, selection: Selection): Range[] {
  const { boxes, lines } = drawing.picture
  const ranges: Range[] = []
  for (const id of selection.boxes) {
    const range = boxes.find((box) => box.id === id)?.range
    if (range) ranges.push(range)
  }
  for (const index of selection.lines) {
    const range = lines[index]?.range
    if (range) ranges.push(range)
  }
  return ranges.sort((a, b) => comparePositions(a.start, b.start))
}

export type Severity = 'error' | 'warning' | 'info' | 'hint'

export interface Fault {
  uri: string
  range: Range
  severity: Severity
  message: string
  code: string
}

// Whether a job tells what the language server has told: the server says more of it.
export function isSame(told: Fault, found: Fault): boolean {
  const at = (a: Position, b: Position): boolean => comparePositions(a, b) === 0
  const [said = ''] = found.message.split('\n')
  return at(told.range.start, found.range.start) && at(told.range.end, found.range.end) && told.code === found.code && told.message.startsWith(said)
}

const WEIGHT: Record<Severity, number> = { error: 3, warning: 2, info: 1, hint: 0 }

// The worst fault of each shape, by the ranges of their declarations and of their arrows.
export function faultsOn(drawing: Drawing, faults: readonly Fault[]): Map<string, Fault> {
  const found = new Map<string, Fault>()
  const note = (id: string, fault: Fault): void => {
    const known = found.get(id)
    if (!known || WEIGHT[fault.severity] > WEIGHT[known.severity]) found.set(id, fault)
  }
  for (const fault of faults) {
    if (fault.severity === 'hint' || !overlap(drawing.range, fault.range)) continue
    const around = drawing.picture.boxes.filter((box) => box.range && overlap(box.range, fault.range))
    if (around.length > 0) {
      // A fault that spans the section is the section's.
      if (around.length <= 2) for (const box of around) note(box.id, fault)
      continue
    }
    const line = drawing.picture.lines.find((line) => line.range && overlap(line.range, fault.range))
    const from = line && drawing.picture.boxes[line.from]
    if (from) note(from.id, fault)
  }
  return found
}

// The faults that begin within a range, the worst first; hints are none.
export const faultsAt = (faults: readonly Fault[], range: Range): Fault[] =>
  faults
    .filter((fault) => fault.severity !== 'hint' && contains(range, fault.range.start))
    .sort((a, b) => WEIGHT[b.severity] - WEIGHT[a.severity])

// A name for screen readers: what it is, what it says, where its arrows lead.
export interface Spoken {
  figure: Record<Box['figure'], string>
  initial: string
  dashed: string
  leads: (branch: Line['branch'], to: string) => string
}

export function spoken(drawing: Drawing, index: number, words: Spoken): string {
  const box = drawing.picture.boxes[index]
  if (!box) return ''
  const said = (box: Box): string => box.lines.join(' ') || box.id
  const parts = [`${words.figure[box.figure]} ${said(box)}`]
  if (box.initial) parts.push(words.initial)
  if (box.dashed) parts.push(words.dashed)
  for (const line of drawing.picture.lines) {
    const to = drawing.picture.boxes[line.to]
    if (line.from === index && to) parts.push(words.leads(line.branch, said(to)))
  }
  return parts.join(', ')
}
