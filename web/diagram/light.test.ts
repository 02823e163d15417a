// Tests of what a run lights, what a place in the text picks, recording and search.

import { expect, test } from 'vitest'

import { frames, functionOf, isControl, lit } from './light'
import { type Fault, NOTHING, faultsOn, isSame, pickAt, rangesOf, spoken } from './pick'
import { freeName } from './record'
import { match, search } from './search'
import { box, drawing, line } from './testing'

const range = (line: number, from: number, to: number) => ({ start: { line, character: from }, end: { line, character: to } })

test('control states are lit, one for each agent', () => {
  const machine = { ...drawing([box('a', 'circle', 0, 0), box('b', 'circle', 0, 90)]), lights: [{ name: '$c', term: 'arm($c)', shapes: [{ value: 'UP', shape: 'a' }, { value: 'DOWN', shape: 'b' }] }] }
  const state = new Map([
    ['arm(c1)', 'UP'],
    ['arm(c2)', 'UP'],
    ['arm(c3)', 'DOWN'],
    ['other(c1)', 'DOWN'],
  ])
  expect([...lit(machine, state)]).toEqual([
    ['a', ['c1', 'c2']],
    ['b', ['c3']],
  ])
  expect(functionOf('light')).toBe('light')
  expect(isControl('light', 'light')).toBe(true)
  expect(isControl('phase(x)', 'phase(y)')).toBe(false)
})

test('a counterexample is followed from its first state', () => {
  const all = frames([
    { step: 0, values: [['x', '0'], ['y', '0']] },
    { step: 1, inputs: [['go', 'true']], changes: [{ location: 'x', from: '0', to: '1', by: 'M.asm:3' }] },
  ])
  expect(all.map(({ state }) => [...state])).toEqual([
    [['x', '0'], ['y', '0']],
    [['x', '1'], ['y', '0']],
  ])
  expect(all[1]?.changed.get('x')).toBe('0')
})

test('the smallest declaration around a place is picked, else the arrow', () => {
  const a = { ...box('a', 'circle', 0, 0), range: range(1, 0, 20) }
  const b = { ...box('b', 'rectangle', 0, 0), range: range(1, 5, 10) }
  const machine = drawing([a, b], [{ ...line(0, 1), range: range(2, 0, 6) }])
  expect(pickAt(machine, { line: 1, character: 7 }).boxes).toEqual(['b'])
  expect(pickAt(machine, { line: 2, character: 3 })).toEqual({ boxes: [], lines: [0] })
  expect(pickAt(machine, { line: 5, character: 0 })).toBe(NOTHING)
  expect(rangesOf(machine, { boxes: ['b', 'a'], lines: [0] })).toEqual([a.range, b.range, range(2, 0, 6)])
})

test('the worst fault of a shape is shown on it', () => {
  const machine = drawing([{ ...box('a', 'circle', 0, 0), range: range(1, 0, 20) }])
  const fault = (severity: 'error' | 'warning' | 'hint') => ({ uri: 'u', range: range(1, 2, 3), severity, message: severity, code: '' })
  expect(faultsOn(machine, [fault('warning'), fault('error'), fault('hint')]).get('a')?.message).toBe('error')
})

test('screen readers hear what a shape is and where it leads', () => {
  const words = {
    figure: { circle: 'State' } as never,
    initial: 'initial',
    dashed: 'to be refined',
    leads: (branch: string | null, to: string) => `${branch ?? ''} to ${to}`,
  }
  const machine = drawing([{ ...box('off', 'circle', 0, 0), initial: true }, box('on', 'circle', 0, 90)], [line(0, 1)])
  expect(spoken(machine, 0, words)).toBe('State off, initial,  to on')
})

test('a recorded run has a name that no file beside the model has', () => {
  expect(freeName('Lamp', [])).toBe('LampRun1')
  expect(freeName('Lamp', ['LampRun1', 'LampRun3'])).toBe('LampRun2')
})

test('a few letters find a name', () => {
  const names = ['VisualServoingComponent.chart', 'VisionSystem.chart', 'CoffeeMachine.asm']
  expect(search('vsco', names, (name) => name)[0]?.item).toBe('VisualServoingComponent.chart')
  expect(search('coffee', names, (name) => name).map(({ item }) => item)).toEqual(['CoffeeMachine.asm'])
  expect(match('zz', 'abc')).toBeNull()
  expect(search('delete this file', ['Delete this machine', 'Delete this file'], (name) => name).map(({ item }) => item)).toEqual(['Delete this file'])
  expect(match('delete file', 'Delete this file')).not.toBeNull()
  expect(match('', 'abc')).toEqual({ score: 0, at: [] })
})

test('what the language server and a job tell of one place is one fault', () => {
  const range = { start: { line: 1, character: 2 }, end: { line: 1, character: 9 } }
  const told: Fault = { uri: 'a', range, severity: 'error', message: 'it is too late: the deadline\nhelp: wait', code: 'late' }
  const check = (change: Partial<Fault>, same: boolean): void => expect(isSame(told, { ...told, message: 'it is too late\nhelp: wait', ...change })).toBe(same)
  check({}, true)
  check({ code: 'early' }, false)
  check({ message: 'it is too early' }, false)
  check({ range: { ...range, end: { line: 2, character: 0 } } }, false)
})
