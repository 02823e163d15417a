// Where shapes and arrows go that the keyboard draws: on small drawings, and on random ones.

import { expect, test } from 'vitest'

import { arrowBehind, branches, roomBehind, targets, towards } from './behind'
import { box, drawing, line, random } from './testing'

const door = drawing([box('shut', 'circle', 0, 0, 60, 60), box('pushed', 'hexagon', 120, 10), box('open', 'circle', 260, 0, 60, 60)], [line(0, 1), line(1, 2, 'yes')])
const [shut, pushed, open] = door.picture.boxes as [ReturnType<typeof box>, ReturnType<typeof box>, ReturnType<typeof box>]

test('a new shape finds room behind another one', () => {
  expect(roomBehind(drawing([shut]), shut, [80, 40])).toEqual([160, 30].map((at) => Math.round(at / 10) * 10))
  // The place to the right is taken.
  const [x, y] = roomBehind(door, shut, [80, 40])
  expect(x > 0 && Math.abs(y - 30) > 40).toBe(true)
  expect(roomBehind(drawing([]), null, [80, 40]).every(Number.isFinite)).toBe(true)
})

test('a new shape lies on no other one', () => {
  const next = random(7)
  for (let round = 0; round < 200; round++) {
    const boxes = Array.from({ length: 1 + Math.floor(next() * 30) }, (_, index) => box(`b${index}`, 'rectangle', next() * 600, next() * 400))
    const [x, y] = roomBehind(drawing(boxes), boxes[Math.floor(next() * boxes.length)] ?? null, [110, 40])
    for (const other of boxes) {
      const apart = Math.abs(other.x + other.width / 2 - x) >= (other.width + 110) / 2 || Math.abs(other.y + other.height / 2 - y) >= (other.height + 40) / 2
      expect(apart).toBe(true)
    }
  }
})

test('the arrow to it takes the exit that is free', () => {
  expect(arrowBehind(door, shut, 'state', 'new')).toEqual({ from: 'shut', branch: null, to: 'new' })
  expect(arrowBehind(door, pushed, 'action', 'new')).toEqual({ from: 'pushed', branch: 'no', to: 'new' })
  const system = drawing([box('plan', 'component', 0, 0)], [], 'system')
  const plan = system.picture.boxes[0] ?? shut
  expect(arrowBehind(system, plan, 'sensor', 'new')).toEqual({ from: 'new', branch: null, to: 'plan' })
})

test('an arrow may lead to all but what has it already', () => {
  expect(targets(door, shut, null).map(({ to }) => to)).toEqual(['shut', 'open'])
  expect(targets(door, pushed, 'no').map(({ to }) => to)).toEqual(['shut', 'pushed', 'open'])
  const pattern = { ...door, kind: 'pattern' as const }
  expect(targets(pattern, open, null).map(({ to }) => to)).toEqual(['shut', 'pushed', 'open', 'exit', 'exit yes', 'exit no'])
  expect([branches(shut), branches(pushed)]).toEqual([[null], ['yes', 'no']])
})

test('arrow keys choose the next shape in a direction', () => {
  const known = targets(door, pushed, 'no')
  expect(towards(known, pushed, [1, 0])?.to).toBe('open')
  expect(towards(known, pushed, [-1, 0])?.to).toBe('shut')
  expect(towards(known, pushed, [0, 1])).toBe(null)
})
