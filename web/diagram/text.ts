// Texts and their edits: positions, offsets, differences, and changes that are carried over other changes.
//
// In: texts, and edits as the Language Server Protocol writes them. Out: changes by offset, sorted, none overlapping, all in
// terms of the text before. INVARIANT: what no change names keeps its bytes.

import type { Position, Range, TextEdit } from './protocol'

export interface Change {
  from: number
  to: number
  insert: string
}

// Where lines begin; a line ends with \n, and \r before it belongs to the line.
export function lineStarts(text: string): number[] {
  const starts = [0]
  for (let at = text.indexOf('\n'); at >= 0; at = text.indexOf('\n', at + 1)) starts.push(at + 1)
  return starts
}

export function offsetOf(text: string, position: Position, starts = lineStarts(text)): number {
  const start = starts[position.line]
  if (start === undefined) return text.length
  const end = starts[position.line + 1] ?? text.length + 1
  return Math.min(start + position.character, end - 1)
}

export function positionOf(text: string, offset: number, starts = lineStarts(text)): Position {
  let low = 0
  let high = starts.length - 1
  while (low < high) {
    const middle = (low + high + 1) >> 1
    if ((starts[middle] ?? 0) <= offset) low = middle
    else high = middle - 1
  }
  return { line: low, character: offset - (starts[low] ?? 0) }
}

export function changesOf(text: string, edits: readonly TextEdit[]): Change[] {
  const starts = lineStarts(text)
  const changes = edits.map((edit) => ({
    from: offsetOf(text, edit.range.start, starts),
    to: offsetOf(text, edit.range.end, starts),
    insert: edit.newText,
  }))
  return sorted(changes)
}

// Insertions at one place keep their order.
function sorted(changes: Change[]): Change[] {
  return changes
    .map((change, index) => ({ change, index }))
    .sort((a, b) => a.change.from - b.change.from || a.change.to - b.change.to || a.index - b.index)
    .map(({ change }) => change)
}

export function applied(text: string, changes: readonly Change[]): string {
  let out = ''
  let at = 0
  for (const { from, to, insert } of changes) {
    out += text.slice(at, from) + insert
    at = to
  }
  return out + text.slice(at)
}

export const comparePositions = (a: Position, b: Position): number => a.line - b.line || a.character - b.character

export const contains = (range: Range, at: Position): boolean =>
  comparePositions(range.start, at) <= 0 && comparePositions(at, range.end) <= 0

export const overlap = (a: Range, b: Range): boolean =>
  comparePositions(a.start, b.end) <= 0 && comparePositions(b.start, a.end) <= 0

// LIMIT: beyond so many cells of lines × lines a difference is one change.
const CELLS = 4_000_000

// The changes that take a text to another, by lines; within one changed place, as short as can be at both ends.
export function difference(before: string, after: string): Change[] {
  if (before === after) return []
  const a = splitLines(before)
  const b = splitLines(after)
  let head = 0
  while (head < a.length && head < b.length && a[head] === b[head]) head++
  let tail = 0
  while (tail < a.length - head && tail < b.length - head && a[a.length - 1 - tail] === b[b.length - 1 - tail]) tail++
  const left = a.slice(head, a.length - tail)
  const right = b.slice(head, b.length - tail)
  const changes: Change[] = []
  let at = a.slice(0, head).join('').length
  for (const [removed, added] of hunks(left, right)) {
    if (typeof removed === 'number') {
      at += removed
      continue
    }
    const [old, fresh] = [removed.join(''), added.join('')]
    changes.push(...trimmed(old, fresh, at))
    at += old.length
  }
  return changes
}

function splitLines(text: string): string[] {
  return text.split(/(?<=\n)/)
}

function trimmed(old: string, fresh: string, at: number): Change[] {
  if (old === fresh) return []
  let head = 0
  while (head < old.length && head < fresh.length && old[head] === fresh[head]) head++
  let tail = 0
  while (
    tail < old.length - head &&
    tail < fresh.length - head &&
    old[old.length - 1 - tail] === fresh[fresh.length - 1 - tail]
  )
    tail++
  return [{ from: at + head, to: at + old.length - tail, insert: fresh.slice(head, fresh.length - tail) }]
}

// Stretches of equal lines, as how long they are, and of lines that differ, by a longest common subsequence.
function* hunks(a: string[], b: string[]): Generator<[number, string[]] | [string[], string[]]> {
  if (a.length * b.length > CELLS || a.length === 0 || b.length === 0) {
    if (a.length || b.length) yield [a, b]
    return
  }
  const width = b.length + 1
  const table = new Uint32Array((a.length + 1) * width)
  const cell = (i: number, j: number): number => table[i * width + j] ?? 0
  for (let i = a.length - 1; i >= 0; i--) {
    for (let j = b.length - 1; j >= 0; j--) {
      table[i * width + j] = a[i] === b[j] ? cell(i + 1, j + 1) + 1 : Math.max(cell(i + 1, j), cell(i, j + 1))
    }
  }
  let [i, j] = [0, 0]
  while (i < a.length || j < b.length) {
    let same = 0
    while (i < a.length && j < b.length && a[i] === b[j]) {
      same += a[i]?.length ?? 0
      i++
      j++
    }
    if (same > 0) yield [same, []]
    const [fromA, fromB] = [i, j]
    while ((i < a.length || j < b.length) && !(i < a.length && j < b.length && a[i] === b[j])) {
      if (j >= b.length || (i < a.length && cell(i + 1, j) >= cell(i, j + 1))) i++
      else j++
    }
    if (i > fromA || j > fromB) yield [a.slice(fromA, i), b.slice(fromB, j)]
  }
}

// Changes of a text, carried over others of the same text, so that they apply after these; null where they touch each other.
export function rebased(changes: readonly Change[], over: readonly Change[]): Change[] | null {
  const out: Change[] = []
  for (const change of changes) {
    let shift = 0
    for (const other of over) {
      if (other.to < change.from) shift += other.insert.length - (other.to - other.from)
      else if (other.from <= change.to) return null
    }
    out.push({ from: change.from + shift, to: change.to + shift, insert: change.insert })
  }
  return out
}
