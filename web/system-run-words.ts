// What the studio says of the run of a system that a check found: what its tasks do, and what the checks of every system mean.

import type { Happened } from './diagram/systemrun'

// SYNC(checks of systems): spec/verification.md.
const CLAIMS: [RegExp, string][] = [
  [/^inv_deadlines$/, 'no task misses a deadline'],
  [/^inv_periods$/, 'each synchronous task begins its cycles when their periods begin'],
  [/^inv_watchdog$/, 'no synchronous task waits past its watchdog'],
  [/^inv_patterns$/, 'locks, buffers and queues are used as their patterns say'],
  [/^inv_whole$/, 'an array holds what it gives for as long as it is read'],
  [/^inv_handedOver$/, 'what is read is the newest datum that was handed over'],
  [/^inv_swapped$/, 'only the master swaps the arrays of a buffer, when there is something new'],
  [/^inv_indexSection$/, 'indexes are swapped within the lock'],
  [/^inv_slaveInside$/, 'a slave is inside the lock while it works'],
  [/^inv_nothingLost$/, 'each datum that was due is written, or counted as dropped'],
  [/^inv_valueNewest$/, 'a shared value that is not new is the one stored last'],
  [/^inv_valueCounted$/, 'each value that was overwritten is counted'],
  [/^inv_misses_/, 'the task misses no more deadlines than the chart allows'],
  [/^inv_fresh_/, 'the reading brings something new as often as the chart says'],
  [/^ctlSpec_fresh/, 'something new comes at all'],
  [/^inv_age\d+_/, 'the data that arrive are no older than the chart allows'],
  [/^inv_twoUsers$/, 'each buffer has two users'],
  [/^inv_oneLock$/, 'no task asks for a lock while it holds one'],
  [/^ctlSpec_served$/, 'whoever asks for a lock gets it, or gives up'],
  [/^ctlSpec_works$/, 'every task begins its cycle again and again'],
]

export const SYSTEM_RUN = {
  lanes: 'Tasks over time',
  lane: (task: string, now: string | null, waits: boolean) => `${task}: ${now ?? 'idle'}${waits ? ', waiting for the lock' : ''}`,
  span: (phase: string, waits: boolean, from: string, to: string) => `${phase}${waits ? ', waiting for the lock' : ''}: ${from} to ${to}`,
  tones: { work: 'elaborates', read: 'reads', write: 'writes', wait: 'waits for the lock' },
  happens: 'In this step',
  begins: 'Nothing has begun yet.',
  nothing: 'All tasks go on with what they do.',
  kinds: {
    begins: (phase) => `begins: ${phase}`,
    rests: () => 'has ended its cycle',
    asks: (channel) => `asks for the lock of ${channel}`,
    enters: (channel) => `gets the lock of ${channel}`,
    leaves: (channel) => `gives back the lock of ${channel}`,
    'gives-up': (channel) => `gives up waiting for the lock of ${channel}`,
    misses: () => 'misses its deadline',
    'too-old': () => 'gets data that are older than the chart allows',
  } satisfies Record<Happened['kind'], (what: string) => string> as Record<Happened['kind'], (what: string) => string>,
  rest: 'Other locations',
  whole: 'Show the locations that never change, too',
  violated: 'Here the property does not hold.',
  claimed: (claim: string) => `Violated: ${claim}.`,
  // What a check of every system says; null of others.
  claim: (check: string): string | null => CLAIMS.find(([form]) => form.test(check))?.[1] ?? null,
}
