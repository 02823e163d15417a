// Tests of state graphs: listings that are cut short, places, keys, lines.

import { expect, test } from 'vitest'

import { type ListedState, edgePaths, edgesOf, listing, neighbour, placed } from './stategraph'

const state = (number: number, depth: number, to: (number | null)[]): ListedState => ({
  state: number,
  initial: depth === 0,
  depth,
  values: [],
  whole: true,
  steps: to.map((to) => ({ to, ways: 1 })),
})

const line = (state: ListedState): Record<string, unknown> => ({ type: 'graph-state', ...state })
const all = [state(0, 0, [0, 1, 2]), state(1, 1, [3]), state(2, 1, [3, null]), state(3, 2, [0])]

test('a listing is read whole, or is not complete', () => {
  const end = { type: 'graph', complete: true, states: 4, steps: 7 }
  const whole = listing([...all.map(line), end])
  expect([whole.states.length, whole.end?.complete]).toEqual([4, true])
  // A line is missing, comes late, comes twice.
  for (const lines of [[all[0], all[2], all[3]], [all[1], all[0], all[2], all[3]], [all[0], all[0], all[1], all[2]]])
    expect(listing([...lines.map((one) => line(one as ListedState)), end]).end?.complete, JSON.stringify(lines)).toBe(false)
  expect(listing(all.map(line)).end).toBe(null)
  expect(listing(['more than 20000 lines: the rest is not shown']).states).toEqual([])
})

test('places are by distance, apart from each other, and the same each time', () => {
  const depths = all.map((one) => one.depth)
  const places = placed(depths, edgesOf(all))
  const [first, left, right, last] = places.points
  expect([first?.[0] === last?.[0], left?.[0] === right?.[0], left?.[1] === right?.[1]]).toEqual([false, true, false])
  expect(placed(depths, edgesOf(all))).toEqual(places)
  expect(placed([], [])).toMatchObject({ points: [] })
})

test('many states have places of their own within the picture', () => {
  let seed = 7
  const random = (most: number): number => (seed = (seed * 16807) % 2147483647) % most
  const depths = Array.from({ length: 2000 }, (_, index) => Math.floor(Math.sqrt(index)))
  const edges = Array.from({ length: 12_000 }, (): [number, number] => [random(2000), random(2000)])
  const { points, width, height } = placed(depths, edges)
  expect(new Set(points.map(String)).size).toBe(2000)
  for (const [x, y] of points) expect(x >= 0 && x <= width && y >= 0 && y <= height).toBe(true)
})

test('keys go along steps, back, and beside', () => {
  const places = placed(all.map((one) => one.depth), edgesOf(all))
  const go = (at: number | null, key: Parameters<typeof neighbour>[3]): number | null => neighbour(all, places, at, key)
  expect([go(null, 'on'), go(0, 'on'), go(1, 'on'), go(3, 'on')]).toEqual([0, 1, 3, 0])
  expect([go(3, 'back'), go(1, 'back'), go(0, 'back')]).toEqual([1, 0, 3])
  const below = go(1, 'below') === 2 ? 1 : 2
  expect([go(below, 'below'), go(3 - below, 'above'), go(3 - below, 'below')]).toEqual([3 - below, below, 3 - below])
  expect([go(3, 'first'), neighbour([], places, null, 'on')]).toEqual([0, null])
})

test('a state that leads to itself has a loop, others a line with a tip', () => {
  const places = placed(all.map((one) => one.depth), edgesOf(all))
  const { lines, tips } = edgePaths(places, edgesOf(all))
  expect([lines.split('M').length - 1, lines.split('C').length - 1, tips.split('Z').length - 1]).toEqual([6, 1, 5])
  expect(lines + tips).not.toContain('NaN')
})
