// Drawing without a pointer: where a new shape finds room behind another one, and which shape an arrow is to lead to.
//
// In: a drawing, a shape, a direction. Out: a centre, a shape, an arrow. INVARIANT: a new shape lies on no other one, and in no composite
// state, since it belongs to none.

import { GRID, snapped } from './arrange'
import { type Point, bounds, centre } from './geometry'
import { endOf, forks, freeBranch, mayConnect } from './gestures'
import type { Arrow, Box, Branch, Drawing, Shape } from './protocol'

const GAP = 60

export type Size = readonly [width: number, height: number]

// Behind is to the right, where pictures go on; else below, above, to the left, or farther away.
export function roomBehind(drawing: Drawing, from: Box | null, [width, height]: Size): Point {
  const all = bounds(drawing.picture.boxes)
  const start = from ?? (all ? { ...all, y: all.y, height } : { x: 0, y: 0, width: 0, height: 0 })
  const [cx, cy] = centre(start)
  const across = (start.width + width) / 2 + GAP
  const down = (start.height + height) / 2 + GAP
  const free = ([x, y]: Point): boolean =>
    drawing.picture.boxes.every((box) => {
      const [otherX, otherY] = centre(box)
      return Math.abs(otherX - x) >= (box.width + width) / 2 + GRID || Math.abs(otherY - y) >= (box.height + height) / 2 + GRID
    })
  for (let ring = 0; ring < 40; ring++) {
    const [farX, farY] = [across + ring * GAP, down + ring * GAP]
    const places: Point[] = [
      [cx + farX, cy],
      [cx + farX, cy + down],
      [cx + farX, cy - down],
      [cx, cy + farY],
      [cx, cy - farY],
      [cx - farX, cy],
    ]
    const found = places.map(([x, y]): Point => [snapped(x), snapped(y)]).find(free)
    if (found) return found
  }
  return [snapped(cx + across), snapped(cy + down)]
}

// The arrow between a shape and the new one behind it: data come from a sensor, everything else is led to.
export function arrowBehind(drawing: Drawing, from: Box, shape: Shape, fresh: string): Arrow {
  if (shape === 'sensor') return { from: fresh, branch: null, to: endOf(from) }
  return { from: endOf(from), branch: freeBranch(drawing, from), to: fresh }
}

// Whether an arrow may begin at a shape.
export const mayBegin = (box: Box): boolean => box.figure !== 'exit'

// What an arrow can lead to: a shape, or an exit that has no arrow yet.
export interface Target {
  to: string
  box: Box | null
}

// All that an arrow from a shape may lead to, in the order of the text.
export function targets(drawing: Drawing, from: Box, branch: Branch): Target[] {
  const boxes = drawing.picture.boxes.map((box): Target => ({ to: endOf(box), box }))
  const exits = drawing.kind === 'pattern' ? ['exit', 'exit yes', 'exit no'].filter((exit) => !boxes.some(({ to }) => to === exit)) : []
  const all = [...boxes, ...exits.map((to): Target => ({ to, box: null }))]
  return all.filter(({ to }, index) => all.findIndex((one) => one.to === to) === index && mayConnect(drawing, { from: endOf(from), branch, to }) === null)
}

// The target that lies next in a direction.
export function towards(known: readonly Target[], at: Box, [dx, dy]: Point): Target | null {
  const [cx, cy] = centre(at)
  let best: { target: Target; cost: number } | null = null
  for (const target of known) {
    if (!target.box || target.box.id === at.id) continue
    const [x, y] = centre(target.box)
    const along = (x - cx) * dx + (y - cy) * dy
    const aside = Math.abs((x - cx) * dy) + Math.abs((y - cy) * dx)
    // Within a right angle around the direction.
    if (along <= 0 || aside > along) continue
    const cost = along + 2 * aside
    if (!best || cost < best.cost) best = { target, cost }
  }
  return best?.target ?? null
}

// The exits that a shape's arrows can begin at: those that say yes and no, or the only one.
export const branches = (box: Box): Branch[] => (forks(box) ? ['yes', 'no'] : [null])
