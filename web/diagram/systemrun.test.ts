// Tests of what the run of a system shows: lanes, what happens in a step, the parts that locations belong to.

import { expect, test } from 'vitest'

import { type RunStep, frames } from './light'
import type { Drawing } from './protocol'
import { happened, lanesOf, marksOf, partsOf, timeAfter, varying } from './systemrun'
import { box, drawing } from './testing'

const component = (id: string, title: string, details: [string, string][]) => ({
  ...box(id, 'component', 0, 0),
  lines: [title],
  details: details.map(([phase, text]) => ({ id: `${id}/${phase}`, text, right: '1 ms' })),
})

const SYSTEM: Drawing = {
  ...drawing(
    [
      component('look', 'Look', [['look_scan', 'elaborate scan'], ['look_write_seen', 'write seen']]),
      component('plan', 'Plan', [['plan_read_seen', 'read seen']]),
      { ...box('seen', 'channel', 0, 0), lines: ['seen'] },
    ],
    [],
    'system',
  ),
  lights: [
    { name: 'Look', term: 'scheduler_currentPhase(look)', shapes: [{ value: 'look_scan', shape: 'look/look_scan' }, { value: 'look_write_seen', shape: 'look/look_write_seen' }] },
    { name: 'Plan', term: 'scheduler_currentPhase(plan)', shapes: [{ value: 'plan_read_seen', shape: 'plan/plan_read_seen' }] },
  ],
}

const to = (location: string, from: string, to: string) => ({ location, from, to, by: 'S.asm:1:1' })

const STEPS: RunStep[] = [
  {
    step: 0,
    values: [
      ['scheduler_mainThread(look)', 'look_task'],
      ['scheduler_mainThread(plan)', 'plan_task'],
      ['sem(seen)', 'seen_lock'],
      ['sem_state(seen_lock,look_task)', 'READY'],
      ['sem_state(seen_lock,plan_task)', 'READY'],
      ['task_deadlinesMissed(plan_task)', '0'],
      ['scheduler_currentPhase(look)', 'look_wait'],
      ['scheduler_currentPhase(plan)', 'plan_wait'],
      ['plan_mode', 'GO'],
      ['tooOld', '3'],
    ],
  },
  { step: 1, changes: [to('scheduler_currentPhase(look)', 'look_wait', 'look_scan')] },
  {
    step: 2,
    changes: [
      to('sem_state(seen_lock,look_task)', 'READY', 'WAITING'),
      to('scheduler_currentPhase(look)', 'look_scan', 'look_write_seen'),
      to('scheduler_currentPhase(plan)', 'plan_wait', 'plan_read_seen'),
    ],
  },
  { step: 3, changes: [to('sem_state(seen_lock,look_task)', 'WAITING', 'EXECUTION')] },
  {
    step: 4,
    changes: [
      to('scheduler_currentPhase(look)', 'look_write_seen', 'look_wait'),
      to('sem_state(seen_lock,look_task)', 'EXECUTION', 'READY'),
      to('task_deadlinesMissed(plan_task)', '0', '1'),
      to('sb_fresh(seen)', 'undef', 'true'),
    ],
  },
]

const RUN = frames(STEPS)

test('a lane has what its component does, and where it waits for a lock', () => {
  const told = lanesOf(SYSTEM, RUN).map(({ title, spans }) => [title, ...spans.map(({ from, to, tone, text }) => `${from}-${to} ${tone} ${text}`)])
  expect(told).toEqual([
    ['Look', '1-2 work elaborate scan', '2-3 wait write seen', '3-4 write write seen'],
    ['Plan', '2-5 read read seen'],
  ])
  expect(lanesOf(SYSTEM, [])).toEqual([])
})

test('a cycle that begins where another one ends is a span of its own', () => {
  const again = [...STEPS.slice(0, 2), { step: 2, changes: [to('scheduler_currentPhase(look)', 'look_scan', 'look_scan')] }]
  expect(lanesOf(SYSTEM, frames(again))[0]?.spans.map(({ from, to }) => [from, to])).toEqual([[1, 2], [2, 3]])
})

test('a step is told as what tasks do, what ends first', () => {
  const check = (at: number, expected: string[]): void => {
    const [first, frame] = [RUN[0], RUN[at]]
    if (!first || !frame) throw new Error('no such step')
    expect(happened(SYSTEM, first, frame).map(({ part, kind, what }) => `${part} ${kind} ${what}`.trim())).toEqual(expected)
  }
  check(0, [])
  check(1, ['look begins elaborate scan'])
  check(2, ['look begins write seen', 'look asks seen', 'plan begins read seen'])
  check(3, ['look enters seen'])
  check(4, ['look leaves seen', 'look rests', 'plan misses'])
})

test('locations stand with the part that they speak of; those that never change can be left out', () => {
  const [first] = RUN
  const all = [...(RUN.at(-1)?.state.keys() ?? [])]
  expect(first && partsOf(SYSTEM, first, all).map(({ id, locations }) => [id, locations.length])).toEqual([['look', 2], ['plan', 4], ['seen', 4], [null, 1]])
  const moving = varying(RUN)
  expect(all.filter((location) => !moving.has(location))).toEqual(['scheduler_mainThread(look)', 'scheduler_mainThread(plan)', 'sem(seen)', 'sem_state(seen_lock,plan_task)', 'plan_mode', 'tooOld'])
})

test('times are told in the unit of the tick', () => {
  const check = (ticks: number, tick: string | null, expected: string): void => expect(timeAfter(ticks, tick)).toBe(expected)
  check(7, null, '7 ms')
  check(3, '0.1 ms', '0.3 ms')
  check(41, '0.5 ms', '20.5 ms')
  check(0, '250 us', '0 us')
  check(12000, '1 ms', '12000 ms')
  check(1, 'soon', '')
  expect([marksOf(1), marksOf(6), marksOf(32), marksOf(100)]).toEqual([[0, 1], [0, 1, 2, 3, 4, 5, 6], [0, 10, 20, 30], [0, 20, 40, 60, 80, 100]])
})
