// Tests of positions, differences and changes carried over others, on random texts.

import { expect, test } from 'vitest'

import { applied, changesOf, difference, offsetOf, positionOf, rebased } from './text'
import { random } from './testing'

const lines = (next: () => number, count: number): string =>
  Array.from({ length: count }, () => `${'abcxyz'[Math.floor(next() * 6)]}${Math.floor(next() * 4)}\n`).join('')

test('positions and offsets agree, also with carriage returns', () => {
  const text = 'a\r\nbc\n\nd'
  for (let offset = 0; offset <= text.length; offset++) expect(offsetOf(text, positionOf(text, offset))).toBe(offset)
  expect(offsetOf(text, { line: 9, character: 0 })).toBe(text.length)
  expect(offsetOf(text, { line: 1, character: 99 })).toBe(5)
})

test('edits become changes in order', () => {
  const range = (line: number, from: number, to: number) => ({ start: { line, character: from }, end: { line, character: to } })
  const changes = changesOf('one\ntwo\n', [
    { range: range(1, 0, 3), newText: 'TWO' },
    { range: range(0, 0, 0), newText: '// ' },
    { range: range(0, 0, 0), newText: '!' },
  ])
  expect(applied('one\ntwo\n', changes)).toBe('// !one\nTWO\n')
})

test('a difference leads to the other text and leaves equal lines alone', () => {
  const next = random(7)
  for (let round = 0; round < 400; round++) {
    const [a, b] = [lines(next, Math.floor(next() * 12)), lines(next, Math.floor(next() * 12))]
    expect(applied(a, difference(a, b))).toBe(b)
  }
  expect(difference('a\nb\nc\n', 'a\nB\nc\nd\n')).toEqual([
    { from: 2, to: 3, insert: 'B' },
    { from: 6, to: 6, insert: 'd\n' },
  ])
})

test('changes that do not touch commute', () => {
  const next = random(11)
  for (let round = 0; round < 400; round++) {
    const base = lines(next, 12)
    const other = difference(base, base.slice(0, 9).replace(/\w/, 'Q') + base.slice(9))
    const mine = difference(base, base.slice(0, -2) + 'Z\n')
    const carried = rebased(mine, other)
    const back = rebased(other, mine)
    if (!carried || !back) continue
    expect(applied(applied(base, other), carried)).toBe(applied(applied(base, mine), back))
  }
})
