// Tests of how a machine of a chart gets another name, and goes.

import { expect, test } from 'vitest'

import { nameFault, quoted, removal, renaming, stays } from './machines'
import type { MachineNames, Range } from './protocol'
import { applied, changesOf } from './text'

const CHART = 'chart Door\n\nmachine door "Door"\n\tinstance g of door\nendmachine\n\nlayout door\nendlayout\n'

const range = (line: number, from: number, to: number): Range => ({ start: { line, character: from }, end: { line, character: to } })

const NAMES: MachineNames = {
  places: [
    { path: 'Door.chart', range: range(2, 8, 12), isOwn: true },
    { path: 'Door.chart', range: range(6, 7, 11), isOwn: true },
    { path: 'House.chart', range: range(4, 1, 5), isOwn: false },
  ],
  title: range(2, 12, 19),
  lines: [{ start: { line: 2, character: 0 }, end: { line: 8, character: 0 } }],
  taken: ['state', 'gate'],
}

test('a machine gets its name wherever it is named, and its text', () => {
  const check = (title: string | null, head: string, titled = NAMES.title): void => {
    const edits = renaming('Door.chart', { ...NAMES, title: titled }, 'hatch', title)
    expect(applied(CHART, changesOf(CHART, edits.get('Door.chart') ?? []))).toBe(CHART.replace('machine door "Door"', head).replace('layout door', 'layout hatch'))
    expect(edits.get('House.chart')).toEqual([{ range: range(4, 1, 5), newText: 'hatch' }])
  }
  check(null, 'machine hatch "Door"')
  check('The "hatch"', 'machine hatch "The \\"hatch\\""')
  check('', 'machine hatch')
  check('Hatch', 'machine hatch "Hatch" "Door"', range(2, 12, 12))
  check('', 'machine hatch "Door"', range(2, 12, 12))
})

test('a machine goes with its lines', () => {
  expect(applied(CHART, changesOf(CHART, removal(NAMES)))).toBe('chart Door\n\n')
})

test('a name is refused that is none, or another’s', () => {
  const check = (name: string, fault: ReturnType<typeof nameFault>): void => expect(nameFault(NAMES, name)).toBe(fault)
  check('hatch_2', null)
  check('', 'form')
  check('2nd', 'form')
  check('a b', 'form')
  check('gate', 'taken')
  check('state', 'taken')
  expect(quoted('a\\b\n')).toBe('"a\\\\b\\n"')
})

test('the drawing in the same place is shown when the shown one is gone', () => {
  const check = (shown: string | null, now: string[], expected: string | null): void => expect(stays(['a', 'b', 'c'], shown, now)).toBe(expected)
  check('b', ['a', 'b'], 'b')
  check('b', ['a', 'x', 'c'], 'x')
  check('c', ['a', 'b'], 'b')
  check(null, ['a', 'b'], 'a')
  check('other', ['a', 'b'], 'a')
  check('a', [], null)
})
