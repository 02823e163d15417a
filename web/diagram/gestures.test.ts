// Tests of gestures, the clipboard and putting shapes in order.

import { expect, test } from 'vitest'

import { align, distribute, snappedCorner } from './arrange'
import { copied, pasted } from './clipboard'
import { endOf, freeBranch, kept, mayConnect, move, redirect, remove } from './gestures'
import { box, drawing, line } from './testing'

const shapes = () => [
  box('off', 'circle', 0, 0, 80, 80),
  box('pressed', 'hexagon', 0, 120, 80, 40),
  box('on', 'circle', 0, 200, 80, 80),
  box('enter', 'enter', 40, -40, 2, 2),
  box('exit 1', 'exit', 40, 400, 2, 2),
]

test('only what was moved gets a new place; a drawing without places keeps all of them', () => {
  const by = new Map([['off', [10, 0] as const], ['exit 1', [10, 0] as const]])
  const operation = move(drawing(shapes()), by)
  expect(operation).toEqual({ kind: 'move', places: { off: [50, 40] } })
  expect(move(drawing(shapes()), new Map([['off', [0, 0] as const]]))).toBeNull()
  const places = { off: [40, 40], pressed: [40, 140], on: [40, 240], enter: [41, -39] }
  expect(kept(drawing(shapes(), [], 'pattern', false), operation!)).toEqual({ places })
  expect(kept(drawing(shapes()), operation!)).toEqual({})
  expect(kept(drawing(shapes(), [], 'pattern', false), { kind: 'layout' })).toEqual({})
})

test('what no chart has is refused at once', () => {
  const pattern = drawing(shapes(), [line(0, 1)], 'pattern')
  expect(mayConnect(pattern, { from: 'off', branch: null, to: 'enter' })).toBe('into-enter')
  expect(mayConnect(pattern, { from: 'exit', branch: null, to: 'off' })).toBe('out-of-exit')
  expect(mayConnect(pattern, { from: 'off', branch: null, to: 'pressed' })).toBe('there-already')
  expect(mayConnect(pattern, { from: 'off', branch: null, to: 'exit' })).toBeNull()
  expect(mayConnect(drawing(shapes()), { from: 'off', branch: null, to: 'exit' })).toBe('no-exit-here')
})

test('an end of an arrow moves', () => {
  const machine = drawing(shapes(), [line(1, 2, 'yes')])
  const [arrow] = machine.picture.lines
  const [off, pressed] = machine.picture.boxes
  expect(redirect(machine, arrow!, 'to', off!, null)).toEqual({
    kind: 'redirect',
    from: 'pressed',
    branch: 'yes',
    to: 'on',
    new: { from: 'pressed', branch: 'yes', to: 'off' },
  })
  expect(redirect(machine, arrow!, 'from', off!, null)).toMatchObject({ new: { from: 'off', branch: null, to: 'on' } })
  expect(redirect(machine, arrow!, 'from', pressed!, 'yes')).toBeNull()
  expect(freeBranch(machine, pressed!)).toBe('no')
})

test('a pattern that answers is left with yes or no, and its block has two exits', () => {
  const pattern = drawing([...shapes(), box('exit yes 2', 'exit', 90, 400, 28, 14)], [line(1, 5, 'yes')], 'pattern')
  expect(pattern.picture.boxes.slice(4).map(endOf)).toEqual(['exit', 'exit yes'])
  expect(mayConnect(pattern, { from: 'pressed', branch: 'yes', to: 'exit yes' })).toBe('there-already')
  expect(mayConnect(pattern, { from: 'pressed', branch: 'yes', to: 'exit no' })).toBeNull()
  expect(mayConnect(drawing(shapes()), { from: 'off', branch: null, to: 'exit no' })).toBe('no-exit-here')
  const block = { ...box('look', 'block', 0, 0, 80, 40), answers: true }
  const machine = drawing([block, ...shapes()], [line(0, 1, 'yes')])
  expect(freeBranch(machine, block)).toBe('no')
  expect(freeBranch(machine, { ...block, answers: false })).toBeNull()
  expect(redirect(machine, line(2, 3, 'no'), 'from', block, null)).toMatchObject({ new: { from: 'look', branch: 'no' } })
})

test('shapes go with their arrows, floating ends with theirs', () => {
  const pattern = drawing(shapes(), [line(0, 1), line(1, 4, 'no')], 'pattern')
  expect(remove(pattern, { boxes: ['off', 'enter'], lines: [0] })).toEqual([{ kind: 'delete', ids: ['off'] }])
  expect(remove(pattern, { boxes: ['exit 1'], lines: [] })).toEqual([
    { kind: 'disconnect', from: 'pressed', branch: 'no', to: 'exit' },
  ])
})

test('what is copied is pasted with the arrows between', () => {
  const machine = drawing(shapes(), [line(0, 1), line(1, 2, 'yes')])
  const text = copied(machine, ['off', 'pressed'])
  const operation = pasted(text!, null)
  expect(operation).toMatchObject({
    kind: 'paste',
    shapes: [
      { id: 'off', shape: 'state', at: [80, 80] },
      { id: 'pressed', shape: 'guard', at: [80, 180] },
    ],
    arrows: [{ from: 'off', branch: null, to: 'pressed' }],
  })
  expect(pasted('some text', null)).toBeNull()
  expect(pasted('{"kind":"other"}', null)).toBeNull()
  expect(copied(machine, ['enter'])).toBeNull()
})

test('a copy never lies on what is there', () => {
  const machine = drawing(shapes())
  const text = copied(machine, ['off'])!
  const at = (drawing: ReturnType<typeof shapes>, place: readonly [number, number]) => pasted(text, place, { ...machine, picture: { ...machine.picture, boxes: drawing } })
  const [off] = shapes()
  const [x, y] = [off!.x + off!.width / 2, off!.y + off!.height / 2]
  expect(at(shapes(), [x, y])).toMatchObject({ shapes: [{ id: 'off', at: [x + 20, y + 20] }] })
  const second = { ...off!, id: 'off2', x: off!.x + 20, y: off!.y + 20 }
  expect(at([...shapes(), second], [x, y])).toMatchObject({ shapes: [{ id: 'off', at: [x + 40, y + 40] }] })
  expect(at(shapes(), [x + 300, y])).toMatchObject({ shapes: [{ id: 'off', at: [x + 300, y] }] })
})

test('a composite state is copied with what it holds', () => {
  const composite = { history: null, doings: [], source: 'composite state working ...' }
  const frame = { ...box('working', 'composite', 0, 0, 300, 300), composite }
  const inner = { ...box('inner', 'composite', 20, 100, 100, 100), composite: { ...composite, source: '...' }, within: 'working' }
  const deep = { ...box('deep', 'circle', 40, 120, 40, 40), within: 'inner' }
  const begun = { ...box('begun', 'circle', 200, 100, 40, 40), within: 'working' }
  const free = box('free', 'circle', 400, 100, 40, 40)
  const machine = drawing([frame, inner, deep, begun, free], [line(0, 4), line(2, 3), line(3, 1)])
  const operation = pasted(copied(machine, ['working', 'deep'])!, [1120, 1130])
  expect(operation).toEqual({
    kind: 'paste',
    shapes: [],
    composites: [{ id: 'working', source: composite.source, places: { deep: [1040, 1140], begun: [1200, 1120] } }],
    arrows: [
      { from: 'deep', branch: null, to: 'begun' },
      { from: 'begun', branch: null, to: 'inner' },
    ],
  })
  const whole = pasted(copied(machine, ['free', 'inner'])!, null)
  expect(whole).toMatchObject({ shapes: [{ id: 'free', at: [980, 120] }], composites: [{ id: 'inner', places: { deep: [620, 140] } }], arrows: [] })
})

test('shapes are aligned and distributed', () => {
  const rects = new Map([
    ['a', { x: 0, y: 0, width: 10, height: 10 }],
    ['b', { x: 7, y: 30, width: 20, height: 10 }],
    ['c', { x: 3, y: 100, width: 10, height: 10 }],
  ])
  expect([...align(rects, 'left')]).toEqual([
    ['b', [-7, 0]],
    ['c', [-3, 0]],
  ])
  expect([...distribute(rects, 'y')]).toEqual([['b', [0, 20]]])
  expect(align(new Map(), 'top').size).toBe(0)
  expect(snappedCorner({ x: 3, y: 4, width: 30, height: 30 })).toEqual([5, 5])
})
