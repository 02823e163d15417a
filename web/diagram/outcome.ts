// How a job came out, in a word: what its code says, unless its lines say that this would mislead.
//
// In: the code, the lines, and which model each scenario of a test loads. Out: a kind, with what is to be told. INVARIANT: nothing is called
// good that says nothing of what was asked, or that has something beside it which is not good.

type Line = string | Record<string, unknown>

export interface Loads {
  scenario: string
  model: string | null
}

export interface Ended {
  job: string
  path: string
  running: boolean
  code: number | null
  lines: readonly Line[]
  loads: readonly Loads[]
}

export type Outcome =
  | { kind: 'running' | 'good' | 'bad' | 'unknown' | 'stopped' | 'world' }
  // No scenario was of the model that was asked for.
  | { kind: 'elsewhere'; of: string[]; passed: number; played: number }
  // A program did what its model allows, and something else besides.
  | { kind: 'conforms'; beside: string }

const of = (lines: readonly Line[], type: string): Record<string, unknown>[] =>
  lines.filter((line): line is Record<string, unknown> => typeof line === 'object' && line['type'] === type)

// What a verdict of `conform` tells besides its first line, as few words as say it.
export function besideOf(words: string): string | null {
  const [, ...beside] = words.split('\n').map((line) => line.trim())
  const told = beside.flatMap((line) => {
    const missed = /^(\d+) deadlines? (?:was|were) missed/.exec(line)?.[1]
    if (missed !== undefined) return [`${missed} ${missed === '1' ? 'deadline' : 'deadlines'} missed`]
    const outside = /^(\d+ of \d+) were outside the chart's bounds/.exec(line)?.[1]
    return outside === undefined ? [] : [`${outside} outside the chart’s bounds`]
  })
  return told.length > 0 ? told.join(', ') : null
}

// Whether a scenario came out as it should.
export const hasPassed = (scenario: { result?: unknown }): boolean => scenario.result === 'passed' || scenario.result === 'failed-as-expected'

export function outcomeOf({ job, path, running, code, lines, loads }: Ended): Outcome {
  if (running) return { kind: 'running' }
  if (code === null) return { kind: 'stopped' }
  if (code === 1) return { kind: 'bad' }
  if (code === 3) return { kind: 'unknown' }
  if (code !== 0) return { kind: 'world' }
  if (job === 'test' && loads.length > 0 && !loads.some(({ model }) => model === path)) {
    const played = of(lines, 'scenario')
    const models = new Set(loads.flatMap(({ model }) => (model === null ? [] : [model])))
    return { kind: 'elsewhere', of: [...models], passed: played.filter(hasPassed).length, played: played.length }
  }
  const verdict = of(lines, 'conformance').at(-1)
  const beside = verdict?.['verdict'] === 'conforms' ? besideOf(String(verdict['words'])) : null
  return beside === null ? { kind: 'good' } : { kind: 'conforms', beside }
}
