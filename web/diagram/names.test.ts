// The parts of file names, what belongs together by them, and what a new chart holds.

import { expect, test } from 'vitest'

import { companions, emptyChart, endingOf, foldersOf, isFileName, linesOf, stemOf, withStem } from './names'
import type { File } from './protocol'

const file = (path: string, kind: File['kind']): File => ({ path, uri: `file:///${path}`, kind })

test('a path has a folder, a name and an ending', () => {
  expect([stemOf('a/Lamp.verify.yaml'), endingOf('a/Lamp.verify.yaml'), withStem('a/Lamp.verify.yaml', 'Light')]).toEqual(['Lamp', '.verify.yaml', 'a/Light.verify.yaml'])
  expect(withStem('Lamp.chart', 'Light')).toBe('Light.chart')
})

test('what has the name of a chart in its folder belongs to it', () => {
  const chart = file('a/Lamp.chart', 'chart')
  const own = [file('a/Lamp.asm', 'model'), file('a/Lamp.verify.yaml', 'verification')]
  const others = [file('Lamp.asm', 'model'), file('a/Lamps.asm', 'model'), file('a/b/Lamp.asm', 'model'), file('a/Lamp.avalla', 'scenario')]
  expect(companions([chart, ...own, ...others], chart)).toEqual(own)
  expect(companions([chart, ...own], file('a/Lamp.avalla', 'scenario'))).toEqual([])
})

test('names that a file can have', () => {
  const model = (stem: string): boolean => isFileName(file('a.asm', 'model'), stem)
  expect(['Lamp2', 'a_b', '2a', 'a b', 'a/b', ''].map(model)).toEqual([true, true, false, false, false, false])
  const scenario = (stem: string): boolean => isFileName(file('a.avalla', 'scenario'), stem)
  expect(['turned-on', '2 lamps', '.a', 'a/b', 'a.', ' a', ''].map(scenario)).toEqual([true, true, false, false, false, false, false])
})

test('the lines that name a file', () => {
  const at = (path: string, line: number) => ({ path, range: { start: { line, character: 1 }, end: { line, character: 2 } }, follows: true })
  expect(linesOf([at('a', 3), at('b', 0), at('a', 1), at('a', 3)])).toEqual([
    { path: 'a', lines: [2, 4] },
    { path: 'b', lines: [1] },
  ])
})

test('a new chart lies in one of the folders', () => {
  expect(foldersOf([file('b/Lamp.asm', 'model'), file('a/c/Lamp.asm', 'model'), file('b/Lamp.chart', 'chart')])).toEqual(['', 'a/c/', 'b/'])
  expect(emptyChart('Lamp')).toBe('chart Lamp\n\nmachine Lamp "Lamp"\n\tcontrol lampState\n\tinitial state idle "Idle"\nendmachine\n')
})
