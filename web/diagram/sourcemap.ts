// Lines of C++ ↔ places of the model that they stand for.
//
// In: the source map as the server tells it, lines and columns from 1. Out: lines of a generated file; a place of a text. What the map
// does not say is not guessed: a line between two mapped ones belongs to the one before, until an empty line.

import type { Range } from './protocol'

export interface MappedLine {
  file: string
  line: number
  // The path of the text, as the studio names files.
  model: string
  at: [line: number, column: number, endLine: number, endColumn: number]
}

export interface GeneratedLine {
  file: string
  line: number
}

const rangeOf = ([line, column, endLine, endColumn]: MappedLine['at']): Range => ({
  start: { line: line - 1, character: column - 1 },
  end: { line: endLine - 1, character: endColumn - 1 },
})

const size = ([line, column, endLine, endColumn]: MappedLine['at']): number => (endLine - line) * 10_000 + endColumn - column

// The generated lines for a place of a text: of the smallest piece around it; else of all pieces that begin in its line.
export function generatedFor(map: readonly MappedLine[], model: string, at: { line: number; character: number }): GeneratedLine[] {
  const here = map.filter((mapped) => mapped.model === model)
  const around = here.filter(({ at: [line, column, endLine, endColumn] }) => {
    const after = at.line + 1 > line || (at.line + 1 === line && at.character + 1 >= column)
    const before = at.line + 1 < endLine || (at.line + 1 === endLine && at.character + 1 <= endColumn)
    return after && before
  })
  const least = around.reduce((least, mapped) => Math.min(least, size(mapped.at)), Infinity)
  const chosen = around.length > 0 ? around.filter((mapped) => size(mapped.at) === least) : here.filter((mapped) => mapped.at[0] === at.line + 1)
  const seen = new Set<string>()
  return chosen
    .map(({ file, line }) => ({ file, line }))
    .filter(({ file, line }) => !seen.has(`${file}:${line}`) && seen.add(`${file}:${line}`))
}

// The place that a generated line stands for.
export function modelFor(map: readonly MappedLine[], file: string, line: number, text: readonly string[]): { model: string; range: Range } | null {
  const here = map.filter((mapped) => mapped.file === file && mapped.line <= line)
  const last = here.reduce<MappedLine | null>((best, mapped) => (best === null || mapped.line > best.line ? mapped : best), null)
  if (!last) return null
  for (let between = last.line + 1; between <= line; between++) if ((text[between - 1] ?? '').trim() === '') return null
  return { model: last.model, range: rangeOf(last.at) }
}
