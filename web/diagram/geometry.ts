// Points, rectangles and arrows of a picture: the same lines that the command line draws.
//
// Owns: paths of arrows with rounded corners and tips, outlines of figures, where a straight line meets an outline, what lies
// under a point. In: boxes and points in the picture's coordinates. Out: numbers and SVG path data.
// SYNC(notation): crates/draw/src/svg.rs rounds corners and draws tips by the same numbers.

import type { Box, Figure, Line } from './protocol'

export type Point = readonly [number, number]

export interface Rect {
  x: number
  y: number
  width: number
  height: number
}

const RADIUS = 7
const TIP_LENGTH = 9
const TIP_HALF = 3.8

const n = (value: number): string => String(Math.round(value * 10) / 10)

export const centre = (box: Rect): Point => [box.x + box.width / 2, box.y + box.height / 2]

// Ends of floating arrows have no outline of their own.
export const floats = (figure: Figure): boolean => figure === 'enter' || figure === 'exit'

export function bounds(rects: readonly Rect[]): Rect | null {
  if (rects.length === 0) return null
  const left = Math.min(...rects.map((r) => r.x))
  const top = Math.min(...rects.map((r) => r.y))
  const right = Math.max(...rects.map((r) => r.x + r.width))
  const bottom = Math.max(...rects.map((r) => r.y + r.height))
  return { x: left, y: top, width: right - left, height: bottom - top }
}

function towards(from: Point, to: Point, part: number): Point {
  const length = Math.max(Math.hypot(to[0] - from[0], to[1] - from[1]), 0.001)
  const share = Math.min(part, length / 2) / length
  return [from[0] + (to[0] - from[0]) * share, from[1] + (to[1] - from[1]) * share]
}

// The line and the tip of an arrow along these corners; the tip points at the last.
export function arrowPath(points: readonly Point[]): { line: string; tip: string } {
  const end = points.at(-1)
  const before = points.at(-2)
  if (!end || !before) return { line: '', tip: '' }
  const length = Math.max(Math.hypot(end[0] - before[0], end[1] - before[1]), 0.001)
  const dx = (end[0] - before[0]) / length
  const dy = (end[1] - before[1]) / length
  const back: Point = [end[0] - dx * TIP_LENGTH, end[1] - dy * TIP_LENGTH]
  let line = ''
  points.forEach((point, index) => {
    const next = points[index + 1]
    const previous = points[index - 1]
    if (!previous) line += `M${n(point[0])} ${n(point[1])}`
    else if (!next) line += `L${n(back[0])} ${n(back[1])}`
    else {
      const a = towards(point, previous, RADIUS)
      const b = towards(point, next, RADIUS)
      line += `L${n(a[0])} ${n(a[1])}Q${n(point[0])} ${n(point[1])} ${n(b[0])} ${n(b[1])}`
    }
  })
  const [sx, sy] = [-dy * TIP_HALF, dx * TIP_HALF]
  const tip =
    `M${n(end[0])} ${n(end[1])}L${n(back[0] + sx)} ${n(back[1] + sy)}` + `L${n(back[0] - sx)} ${n(back[1] - sy)}Z`
  return { line, tip }
}

// How far the two corners of a hexagon reach out.
export const hexagonCorner = (height: number): number => Math.round(height * 0.34)

// A hexagon's corners, from its left one clockwise.
export function hexagon(rect: Rect): Point[] {
  const { x, y, width, height } = rect
  const c = hexagonCorner(height)
  const cy = y + height / 2
  return [
    [x, cy],
    [x + c, y],
    [x + width - c, y],
    [x + width, cy],
    [x + width - c, y + height],
    [x + c, y + height],
  ]
}

// Where the ray from a shape's centre towards a point leaves the shape.
export function border(figure: Figure, rect: Rect, to: Point): Point {
  const [cx, cy] = centre(rect)
  const [dx, dy] = [to[0] - cx, to[1] - cy]
  if (floats(figure) || (dx === 0 && dy === 0)) return [cx, cy]
  if (figure === 'circle') {
    const length = Math.hypot(dx, dy)
    return [cx + (dx / length) * (rect.width / 2), cy + (dy / length) * (rect.width / 2)]
  }
  if (figure === 'hexagon') {
    const corners = hexagon(rect)
    let best = 1
    corners.forEach((a, index) => {
      const b = corners[(index + 1) % corners.length] ?? a
      const t = crossing([cx, cy], [dx, dy], a, b)
      if (t !== null) best = Math.min(best, t)
    })
    return [cx + dx * best, cy + dy * best]
  }
  const t = Math.min(rect.width / 2 / Math.abs(dx || 1e-9), rect.height / 2 / Math.abs(dy || 1e-9))
  return [cx + dx * t, cy + dy * t]
}

// How far along a ray it crosses a stretch, in lengths of the ray; null if it does not.
function crossing(from: Point, ray: Point, a: Point, b: Point): number | null {
  const [sx, sy] = [b[0] - a[0], b[1] - a[1]]
  const cross = ray[0] * sy - ray[1] * sx
  if (Math.abs(cross) < 1e-9) return null
  const t = ((a[0] - from[0]) * sy - (a[1] - from[1]) * sx) / cross
  const u = ((a[0] - from[0]) * ray[1] - (a[1] - from[1]) * ray[0]) / cross
  return t >= 0 && u >= -1e-9 && u <= 1 + 1e-9 ? t : null
}

export interface Figured extends Rect {
  figure: Figure
}

// The arrow between two shapes while the server's route is not there: straight, from outline to outline; to itself, a loop.
export function plainArrow(from: Figured, to: Figured): Point[] {
  const [a, b] = [centre(from), centre(to)]
  if (from === to || (a[0] === b[0] && a[1] === b[1])) {
    const right = from.x + from.width
    const [, y] = a
    return [
      [right, y],
      [right + 26, y],
      [right + 26, from.y - 18],
      [a[0], from.y - 18],
      [a[0], from.y],
    ]
  }
  return [border(from.figure, from, b), border(to.figure, to, a)]
}

// The corners of an arrow whose ends were moved by so much since it was routed.
export function followed(line: Line, boxes: readonly Box[], from: Point, to: Point): readonly Point[] {
  if (from[0] === to[0] && from[1] === to[1]) {
    return from[0] === 0 && from[1] === 0 ? line.points : line.points.map(([x, y]) => [x + from[0], y + from[1]] as const)
  }
  const a = boxes[line.from]
  const b = boxes[line.to]
  if (!a || !b) return line.points
  return plainArrow({ ...a, x: a.x + from[0], y: a.y + from[1] }, { ...b, x: b.x + to[0], y: b.y + to[1] })
}

// The index of the uppermost shape under a point, or with its middle near it if it floats; -1 if there is none.
export function hit(boxes: readonly Box[], at: Point, reach = 0): number {
  let found = -1
  boxes.forEach((box, index) => {
    const around = floats(box.figure) ? Math.max(reach, 14) : reach
    const inside =
      at[0] >= box.x - around &&
      at[0] <= box.x + box.width + around &&
      at[1] >= box.y - around &&
      at[1] <= box.y + box.height + around
    if (inside) found = index
  })
  return found
}

export type Side = 'top' | 'right' | 'bottom' | 'left'

const SIDES: Side[] = ['bottom', 'right', 'left', 'top']

export function sidePoint(rect: Rect, side: Side): Point {
  const [cx, cy] = centre(rect)
  switch (side) {
    case 'top':
      return [cx, rect.y]
    case 'right':
      return [rect.x + rect.width, cy]
    case 'bottom':
      return [cx, rect.y + rect.height]
    case 'left':
      return [rect.x, cy]
  }
}

function nearestSide(rect: Rect, point: Point): Side {
  let best: Side = 'bottom'
  let least = Infinity
  for (const side of SIDES) {
    const [x, y] = sidePoint(rect, side)
    const distance = Math.hypot(point[0] - x, point[1] - y)
    if (distance < least) [best, least] = [side, distance]
  }
  return best
}

// The sides at which a guard's exits are taken hold of: where its arrows leave, else where none arrives.
export function guardSides(index: number, boxes: readonly Box[], lines: readonly Line[]): { yes: Side; no: Side } {
  const box = boxes[index]
  if (!box) return { yes: 'bottom', no: 'right' }
  const leaving = (branch: 'yes' | 'no'): Side | null => {
    const point = lines.find((line) => line.from === index && line.branch === branch)?.points[0]
    return point ? nearestSide(box, point) : null
  }
  const arriving = new Set(
    lines.filter((line) => line.to === index).map((line) => nearestSide(box, line.points.at(-1) ?? centre(box))),
  )
  const free = (taken: Side | null): Side =>
    SIDES.find((side) => side !== taken && !arriving.has(side)) ?? SIDES.find((side) => side !== taken) ?? 'bottom'
  let yes = leaving('yes')
  let no = leaving('no')
  yes ??= free(no)
  no ??= free(yes)
  if (no === yes) no = SIDES.find((side) => side !== yes && !arriving.has(side)) ?? 'left'
  return { yes, no }
}
