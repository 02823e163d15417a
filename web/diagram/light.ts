// A state of a run on a drawing: which control states it is in, what its guards evaluate to, what changed.
//
// In: a session's or a counterexample's state, and the drawings. Out: ids of boxes by drawing. A drawing whose control variable
// has parameters lights one state for each agent.

import type { Box, Drawing, SessionState, Update } from './protocol'

export type State = ReadonlyMap<string, string>

export const stateOf = (session: SessionState): State =>
  new Map(Array.isArray(session.state) ? session.state : Object.entries(session.state))

// The function of a location or a term: `arm` of `arm(crane1)`.
export const functionOf = (term: string): string => (/^\s*([A-Za-z_]\w*)/.exec(term) ?? ['', ''])[1] ?? ''

const compact = (text: string): string => text.replace(/\s+/g, '')

// Whether a location is one of a control variable: the same function, and the same arguments unless the term has variables.
export function isControl(location: string, term: string): boolean {
  if (functionOf(location) !== functionOf(term)) return false
  return term.includes('$') || /\(.*\(/.test(term) || compact(location) === compact(term)
}

const argument = (location: string): string => /^[^(]*\((.*)\)\s*$/.exec(location)?.[1] ?? ''

// What is lit, each with the agents in it; the empty string for a machine that has none. In a system these are rows of components.
export function lit(drawing: Drawing, state: State): Map<string, string[]> {
  const out = new Map<string, string[]>()
  for (const { term, shapes } of drawing.lights) {
    const byValue = new Map(shapes.map(({ value, shape }) => [value, shape]))
    for (const [location, value] of state) {
      const shape = byValue.get(value)
      if (shape === undefined || !isControl(location, term)) continue
      const agent = drawing.kind === 'system' ? '' : argument(location)
      out.set(shape, [...(out.get(shape) ?? []), agent])
    }
  }
  return out
}

// The term of a machine's control variable.
export const controlOf = (drawing: Drawing): string | null => (drawing.kind === 'system' ? null : (drawing.lights[0]?.term ?? null))

// A guard's term, if it can be evaluated outside of the machine: no variables in it.
export const closedTerm = (box: Box): string | null =>
  box.figure === 'hexagon' && box.link && !box.link.includes('$') ? box.link : null

export interface Row {
  location: string
  value: string
  before: string | null
}

// The state as a table: what changed first, else in the state's order.
export function rows(state: State, updates: readonly Update[], filter: string): Row[] {
  const before = new Map(updates.map((update) => [update.location, update.before]))
  const wanted = filter.trim().toLowerCase()
  const all: Row[] = []
  for (const [location, value] of state) {
    if (wanted && !location.toLowerCase().includes(wanted) && !value.toLowerCase().includes(wanted)) continue
    all.push({ location, value, before: before.get(location) ?? null })
  }
  return all
}

// A counterexample's steps, as the checker writes them.
export interface RunStep {
  step: number
  values?: [string, string][]
  inputs?: [string, string][]
  choices?: string[]
  changes?: { location: string; from: string; to: string; by: string }[]
  fault?: string
}

export interface Frame {
  step: number
  state: State
  changed: ReadonlyMap<string, string>
  inputs: [string, string][]
  choices: string[]
  fault: string | null
}

// The states that a counterexample goes through.
export function frames(steps: readonly RunStep[]): Frame[] {
  let state = new Map<string, string>()
  return steps.map((step) => {
    const changed = new Map<string, string>()
    state = new Map(state)
    for (const [location, value] of step.values ?? []) state.set(location, value)
    for (const change of step.changes ?? []) {
      state.set(change.location, change.to)
      changed.set(change.location, change.from)
    }
    return {
      step: step.step,
      state,
      changed,
      inputs: step.inputs ?? [],
      choices: step.choices ?? [],
      fault: step.fault ?? null,
    }
  })
}
