// Tests of arrows, outlines and what lies under a point.

import { expect, test } from 'vitest'

import { arrowPath, border, followed, guardSides, hexagon, hit, plainArrow } from './geometry'
import { box, line } from './testing'

// SYNC(notation): the bytes that crates/draw writes for these arrows of VisualServoingComponent.
test('arrows are drawn as the command line draws them', () => {
  const straight = arrowPath([
    [218, 122],
    [218, 152],
  ])
  expect(straight).toEqual({ line: 'M218 122L218 143', tip: 'M218 152L214.2 143L221.8 143Z' })
  const round = arrowPath([
    [218, 702],
    [218, 718],
    [440, 718],
    [440, 20],
    [218, 20],
    [218, 36],
  ])
  expect(round.line).toBe(
    'M218 702L218 711Q218 718 225 718L433 718Q440 718 440 711L440 27Q440 20 433 20L225 20Q218 20 218 27L218 27',
  )
  expect(arrowPath([[1, 1]])).toEqual({ line: '', tip: '' })
})

test('a hexagon has the corners of the notation', () => {
  const corners = hexagon({ x: 147, y: 152, width: 142, height: 44 })
  expect(corners.join(' ')).toBe('147,174 162,152 274,152 289,174 274,196 162,196')
})

test('a ray leaves each figure at its outline', () => {
  const rect = { x: 0, y: 0, width: 100, height: 40 }
  expect(border('rectangle', rect, [200, 20])).toEqual([100, 20])
  expect(border('rectangle', rect, [50, 200])).toEqual([50, 40])
  expect(border('circle', { x: 0, y: 0, width: 80, height: 80 }, [40, 400])).toEqual([40, 80])
  expect(border('hexagon', rect, [500, 20])[0]).toBeCloseTo(100)
  expect(border('hexagon', rect, [50, -90])).toEqual([50, 0])
  expect(border('exit', rect, [500, 20])).toEqual([50, 20])
})

test('arrows follow shapes in the hand', () => {
  const boxes = [box('a', 'rectangle', 0, 0), box('b', 'rectangle', 200, 0)]
  const arrow = { ...line(0, 1), points: [[80, 20], [200, 20]] as [number, number][] }
  expect(followed(arrow, boxes, [0, 0], [0, 0])).toBe(arrow.points)
  expect(followed(arrow, boxes, [5, 7], [5, 7])).toEqual([[85, 27], [205, 27]])
  expect(followed(arrow, boxes, [0, 0], [0, 200])).toHaveLength(2)
  const self = plainArrow(boxes[0]!, boxes[0]!)
  expect(self.at(-1)).toEqual([40, 0])
})

test('the uppermost shape is hit, floating ends nearby', () => {
  const boxes = [box('a', 'rectangle', 0, 0), box('b', 'rectangle', 40, 0), box('exit 1', 'exit', 300, 300, 2, 2)]
  expect(hit(boxes, [60, 10])).toBe(1)
  expect(hit(boxes, [10, 10])).toBe(0)
  expect(hit(boxes, [308, 308])).toBe(2)
  expect(hit(boxes, [200, 200])).toBe(-1)
})

test('exits of a guard are where its arrows leave, else where none arrives', () => {
  const guard = box('g', 'hexagon', 0, 0, 100, 40)
  const boxes = [guard, box('s', 'circle', 0, 200)]
  const yes = { ...line(0, 1, 'yes'), points: [[50, 40], [50, 200]] as [number, number][] }
  expect(guardSides(0, boxes, [yes])).toEqual({ yes: 'bottom', no: 'right' })
  const into = { ...line(1, 0), points: [[200, 20], [100, 20]] as [number, number][] }
  expect(guardSides(0, boxes, [yes, into])).toEqual({ yes: 'bottom', no: 'left' })
})
