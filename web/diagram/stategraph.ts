// The state graph of a small model: its states, the steps between them, and where each is drawn.
//
// Owns: what the lines of a listing mean, places by distance from the initial states, which states are next to which. In: objects of
// `groundstate graph`. Out: plain data. INVARIANT: the same listing has the same places.

import type { Point } from './geometry'

export interface ListedStep {
  to: number | null
  fault?: string
  ways: number
  inputs?: [string, string][]
  choices?: string[]
}

export interface ListedState {
  state: number
  initial: boolean
  depth: number
  values: [string, string][]
  violated?: string[]
  holds?: (boolean | null)[]
  whole: boolean
  steps: ListedStep[]
}

export interface Listing {
  states: ListedState[]
  // How much of it there is; null as long as it comes.
  end: { complete: boolean; reason?: string; states: number; steps: number } | null
}

// Reads the lines of a job. What is cut short is no listing: a state whose number is not the next ends it.
export function listing(lines: readonly (string | Record<string, unknown>)[]): Listing {
  const states: ListedState[] = []
  let end: Listing['end'] = null
  for (const line of lines) {
    if (typeof line !== 'object') continue
    if (line['type'] === 'graph-state' && line['state'] === states.length) states.push(line as unknown as ListedState)
    if (line['type'] === 'graph') end = line as unknown as NonNullable<Listing['end']>
  }
  if (end && end.states !== states.length) end = { ...end, complete: false }
  return { states, end }
}

export interface Places {
  points: Point[]
  width: number
  height: number
}

const APART_X = 92
const APART_Y = 34
const SWEEPS = 10
const MARGIN = 30

// Columns by distance; within a column, states lie near those that they are joined to.
export function placed(depths: readonly number[], edges: readonly (readonly [number, number])[]): Places {
  const columns: number[][] = []
  depths.forEach((depth, state) => (columns[depth] ??= []).push(state))
  const joined: number[][] = depths.map(() => [])
  for (const [from, to] of edges) {
    if (from === to || depths[from] === undefined || depths[to] === undefined) continue
    joined[from]?.push(to)
    joined[to]?.push(from)
  }
  const tall = Math.max(1, ...columns.map((column) => column?.length ?? 0))
  const y: number[] = []
  const spread = (column: number[]): void => column.forEach((state, index) => (y[state] = (index - (column.length - 1) / 2) * APART_Y))
  columns.forEach(spread)
  for (let sweep = 0; sweep < SWEEPS; sweep++) {
    const order = sweep % 2 === 0 ? columns : [...columns].reverse()
    for (const column of order) {
      const wish = new Map<number, number>()
      for (const state of column) {
        const near = (joined[state] ?? []).filter((other) => depths[other] !== depths[state])
        const sum = near.reduce((sum, other) => sum + (y[other] ?? 0), 0)
        wish.set(state, near.length > 0 ? sum / near.length : (y[state] ?? 0))
      }
      column.sort((a, b) => (wish.get(a) ?? 0) - (wish.get(b) ?? 0) || a - b)
      spread(column)
    }
  }
  const height = (tall - 1) * APART_Y + 2 * MARGIN
  const points = depths.map((depth, state): Point => [MARGIN + depth * APART_X, height / 2 + (y[state] ?? 0)])
  return { points, width: Math.max(0, columns.length - 1) * APART_X + 2 * MARGIN, height }
}

export const edgesOf = (states: readonly ListedState[]): [number, number][] =>
  states.flatMap((state) => state.steps.flatMap((step): [number, number][] => (step.to === null ? [] : [[state.state, step.to]])))

export type Key = 'on' | 'back' | 'above' | 'below' | 'first'

// The state that a key leads to: along a step, back along one, or beside it in its column.
export function neighbour(states: readonly ListedState[], places: Places, at: number | null, key: Key): number | null {
  if (states.length === 0) return null
  if (key === 'first' || at === null) return 0
  if (key === 'on') return states[at]?.steps.find((step) => step.to !== null && step.to !== at)?.to ?? at
  if (key === 'back') {
    const before = states.filter((state) => state.state !== at && state.steps.some((step) => step.to === at))
    return before.sort((a, b) => a.depth - b.depth || a.state - b.state)[0]?.state ?? at
  }
  const column = states.filter((state) => state.depth === states[at]?.depth).map((state) => state.state)
  column.sort((a, b) => (places.points[a]?.[1] ?? 0) - (places.points[b]?.[1] ?? 0))
  return column[column.indexOf(at) + (key === 'below' ? 1 : -1)] ?? at
}

const n = (value: number): string => String(Math.round(value * 10) / 10)

export const DOT = 8

// Lines with tips, as one path each: between states, curved where both ways lead, around a state that leads to itself.
export function edgePaths(places: Places, edges: readonly (readonly [number, number])[]): { lines: string; tips: string } {
  const there = new Set(edges.map(([from, to]) => from * 100_000 + to))
  let lines = ''
  let tips = ''
  for (const [from, to] of edges) {
    const a = places.points[from]
    const b = places.points[to]
    if (!a || !b) continue
    if (from === to) {
      lines += `M${n(a[0] - 5)} ${n(a[1] - DOT + 2)}C${n(a[0] - 13)} ${n(a[1] - 24)} ${n(a[0] + 13)} ${n(a[1] - 24)} ${n(a[0] + 5)} ${n(a[1] - DOT + 2)}`
      continue
    }
    const length = Math.max(Math.hypot(b[0] - a[0], b[1] - a[1]), 0.001)
    const [dx, dy] = [(b[0] - a[0]) / length, (b[1] - a[1]) / length]
    // A step back, or one of two between the same states, gives way to the side.
    const side = there.has(to * 100_000 + from) || b[0] <= a[0] ? Math.min(26, length / 5) : 0
    const [cx, cy] = [(a[0] + b[0]) / 2 + dy * side * 2, (a[1] + b[1]) / 2 - dx * side * 2]
    const leave = Math.max(Math.hypot(cx - a[0], cy - a[1]), 0.001)
    const reach = Math.max(Math.hypot(b[0] - cx, b[1] - cy), 0.001)
    const [ux, uy] = [(b[0] - cx) / reach, (b[1] - cy) / reach]
    const start: Point = [a[0] + ((cx - a[0]) / leave) * DOT, a[1] + ((cy - a[1]) / leave) * DOT]
    const end: Point = [b[0] - ux * (DOT + 2), b[1] - uy * (DOT + 2)]
    lines += `M${n(start[0])} ${n(start[1])}Q${n(cx)} ${n(cy)} ${n(end[0])} ${n(end[1])}`
    const back: Point = [end[0] - ux * 7, end[1] - uy * 7]
    tips += `M${n(end[0])} ${n(end[1])}L${n(back[0] - uy * 3)} ${n(back[1] + ux * 3)}L${n(back[0] + uy * 3)} ${n(back[1] - ux * 3)}Z`
  }
  return { lines, tips }
}
