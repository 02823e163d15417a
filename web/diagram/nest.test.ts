// Tests of what goes into composite states by dragging.

import { expect, test } from 'vitest'

import { frames, holders, moveInto } from './gestures'
import { box, drawing } from './testing'

const within = (id: string, x: number, y: number, around: string | null) => ({ ...box(id, 'circle', x, y, 40, 40), within: around })
const frame = (id: string, x: number, y: number, size: number, around: string | null) => ({ ...box(id, 'composite', x, y, size, size), within: around })

const machine = drawing([
  frame('outer', 0, 0, 400, null),
  frame('inner', 20, 20, 150, 'outer'),
  within('deep', 40, 40, 'inner'),
  within('middle', 300, 300, 'outer'),
  within('free', 600, 600, null),
])

const moved = (id: string, dx: number, dy: number, meant = false): unknown => {
  const operation = moveInto(machine, new Map([[id, [dx, dy]]]), meant)
  return operation?.kind === 'nest' ? operation.into : operation?.kind
}

test('a shape that is let go on a frame goes into it', () => {
  expect(moved('free', -300, -300)).toBe('outer')
  expect(moved('free', -530, -530)).toBe('inner')
  expect(moved('middle', -220, -220)).toBe('inner')
  expect(moved('free', 10, 10)).toBe('move')
  const operation = moveInto(machine, new Map([['free', [-300, -300]], ['middle', [-10, 0]]]), false)
  expect(operation).toEqual({ kind: 'nest', ids: ['free'], into: 'outer', places: { free: [320, 320], middle: [310, 320] } })
})

test('a frame follows what it holds, unless leaving it is meant', () => {
  expect(moved('deep', 180, 180)).toBe('move')
  expect(moved('deep', 700, 700)).toBe('move')
  expect(moved('deep', 180, 180, true)).toBe('outer')
  expect(moved('deep', 700, 700, true)).toBe(null)
  expect(moved('free', 30, 30, true)).toBe('move')
})

test('a composite state goes into no state that it holds', () => {
  expect(holders(machine, 'deep')).toEqual(['inner', 'outer'])
  const named = (id: string): string[] => frames(machine, machine.picture.boxes.find((box) => box.id === id) ?? box('', 'circle', 0, 0))
  expect([named('outer'), named('inner'), named('free')]).toEqual([[], ['outer'], ['outer', 'inner']])
})
