// What a job is said to have come to: by its code, and where its code alone would mislead.

import { expect, test } from 'vitest'

import { type Ended, type Outcome, outcomeOf } from './outcome'

const ended: Ended = { job: 'verify', path: 'a/Press.asm', running: false, code: 0, lines: [], loads: [] }
const check = (change: Partial<Ended>, outcome: Outcome): void => expect(outcomeOf({ ...ended, ...change })).toEqual(outcome)

test('a code says how a job came out', () => {
  check({}, { kind: 'good' })
  check({ running: true, code: null }, { kind: 'running' })
  check({ code: null }, { kind: 'stopped' })
  check({ code: 1 }, { kind: 'bad' })
  check({ code: 3 }, { kind: 'unknown' })
  check({ code: 2 }, { kind: 'world' })
})

test('scenarios of another model say nothing of this one', () => {
  const lines = [{ type: 'scenario', result: 'passed' }, { type: 'scenario', result: 'failed-as-expected' }]
  const loads = ['One.avalla', 'Two.avalla'].map((scenario) => ({ scenario, model: 'a/PressCell.asm' }))
  check({ job: 'test', lines, loads }, { kind: 'elsewhere', of: ['a/PressCell.asm'], passed: 2, played: 2 })
  check({ job: 'test', lines, loads: [...loads, { scenario: 'Own.avalla', model: 'a/Press.asm' }] }, { kind: 'good' })
  check({ job: 'test', lines, loads, code: 1 }, { kind: 'bad' })
  check({ job: 'test', path: 'a/One.avalla', lines }, { kind: 'good' })
})

test('a program that conforms is not good if it missed deadlines or bounds', () => {
  const program = (...words: string[]) => ({ job: 'program', lines: [{ type: 'conformance', verdict: 'conforms', words: words.join('\n') }] })
  check(program('conforms: 900 events'), { kind: 'good' })
  check(program('conforms', '  1 deadline was missed (arm 1); whether'), { kind: 'conforms', beside: '1 deadline missed' })
  check(program('conforms', '97 deadlines were missed (drive 97); whether', "952 of 952 were outside the chart's bounds, as"), {
    kind: 'conforms',
    beside: '97 deadlines missed, 952 of 952 outside the chart’s bounds',
  })
})
