// Both ways between C++ and a model, and what is not on the map.

import { describe, expect, test } from 'vitest'

import { type MappedLine, generatedFor, modelFor } from './sourcemap'

const MAP: MappedLine[] = [
  { file: 'a.cpp', line: 3, model: 'a.asm', at: [10, 2, 14, 8] },
  { file: 'a.cpp', line: 5, model: 'a.asm', at: [11, 3, 11, 12] },
  { file: 'b.cpp', line: 9, model: 'a.asm', at: [11, 3, 11, 12] },
  { file: 'a.cpp', line: 20, model: 'b.asm', at: [11, 3, 11, 12] },
]

describe('a place of the model', () => {
  const at = (line: number, character: number) => generatedFor(MAP, 'a.asm', { line, character })
  test('gives the lines of the smallest piece around it', () => {
    expect(at(10, 4)).toEqual([{ file: 'a.cpp', line: 5 }, { file: 'b.cpp', line: 9 }])
    expect(at(12, 0)).toEqual([{ file: 'a.cpp', line: 3 }])
  })
  test('gives those of its line if it is in none, and nothing elsewhere', () => {
    expect(at(9, 0)).toEqual([{ file: 'a.cpp', line: 3 }])
    expect(at(30, 0)).toEqual([])
    expect(generatedFor(MAP, 'c.asm', { line: 10, character: 4 })).toEqual([])
  })
})

describe('a generated line', () => {
  const text = Array.from({ length: 30 }, (_, index) => (index === 7 ? '' : `line ${index + 1}`))
  test('stands for what the last mapped line before it stands for', () => {
    expect(modelFor(MAP, 'a.cpp', 5, text)).toEqual({ model: 'a.asm', range: { start: { line: 10, character: 2 }, end: { line: 10, character: 11 } } })
    expect(modelFor(MAP, 'a.cpp', 7, text)?.range.start.line).toBe(10)
  })
  test('stands for nothing before the first one, behind an empty line, and in another file', () => {
    expect(modelFor(MAP, 'a.cpp', 2, text)).toBeNull()
    expect(modelFor(MAP, 'a.cpp', 9, text)).toBeNull()
    expect(modelFor(MAP, 'c.cpp', 9, text)).toBeNull()
  })
})
