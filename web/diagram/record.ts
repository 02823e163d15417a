// A session by hand → a scenario in Avalla that plays it again.
//
// In: what was set, chosen and stepped, and the states in between. Out: the text of a scenario with `set`, `step` and `check`.
// What was taken back is not in it.

import type { Update } from './protocol'

export interface Recorded {
  sets: [string, string][]
  updates: Pick<Update, 'location' | 'after'>[]
}

export function scenario(name: string, model: string, steps: readonly Recorded[]): string {
  const lines = [`scenario ${name}`, '', `load ${model}`, '']
  for (const { sets, updates } of steps) {
    for (const [location, value] of sets) lines.push(`set ${location} := ${value};`)
    lines.push('step')
    for (const { location, after } of updates) lines.push(`check ${location} = ${after};`)
    lines.push('')
  }
  return `${lines.join('\n').trimEnd()}\n`
}

// A name for a scenario of that model that no file beside it has.
export function freeName(model: string, taken: readonly string[]): string {
  for (let count = 1; ; count++) {
    const name = `${model}Run${count}`
    if (!taken.includes(name)) return name
  }
}
