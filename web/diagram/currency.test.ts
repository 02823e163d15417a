// Which results are of texts that are others now: as they are typed, saved, changed elsewhere, and back again.

import { expect, test } from 'vitest'

import { type Known, type Looked, changedOf } from './currency'

test('a result is of other texts as soon as one of them is another, and no longer than that', () => {
  const looked: Looked[] = [
    { path: 'Lift.chart', hash: 'a', text: 'chart Lift' },
    { path: 'Data.asm', hash: 'b', text: null },
    { path: 'Lift.verify.yaml', hash: null, text: null },
  ]
  const check = (now: Record<string, Known>, changed: string[]): void => expect(changedOf(looked, (path) => now[path])).toEqual(changed)
  check({}, [])
  const open = (text: string, hash: string, saved: boolean): Known => ({ text, hash, saved })
  // As it is typed, before it is saved, and back again.
  check({ 'Lift.chart': open('chart Lif', 'a', false) }, ['Lift.chart'])
  check({ 'Lift.chart': open('chart Lif', 'c', true) }, ['Lift.chart'])
  check({ 'Lift.chart': open('chart Lift', 'c', false) }, [])
  // One that was opened since: only its file can be compared.
  check({ 'Data.asm': open('module Data', 'b', true) }, [])
  check({ 'Data.asm': open('module Dat', 'b', false) }, ['Data.asm'])
  // In a file alone: changed, gone, come.
  check({ 'Lift.chart': { text: null, hash: 'c', saved: true } }, ['Lift.chart'])
  check({ 'Lift.chart': { text: null, hash: 'a', saved: true } }, [])
  check({ 'Data.asm': { text: null, hash: null, saved: true }, 'Lift.verify.yaml': { text: null, hash: 'd', saved: true } }, ['Data.asm', 'Lift.verify.yaml'])
})
