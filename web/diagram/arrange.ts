// Putting shapes in order: grid, alignment, equal distances.
//
// In: rectangles by their ids. Out: how far each has to move, for those that have to. Centres snap to the grid, because a
// chart's layout gives centres.

import { type Point, type Rect, centre } from './geometry'

export const GRID = 10

export type Edge = 'left' | 'centre' | 'right' | 'top' | 'middle' | 'bottom'

export type Moves = Map<string, Point>

export const snapped = (value: number, grid = GRID): number => Math.round(value / grid) * grid

// The upper left corner that puts a shape's centre on the grid.
export function snappedCorner(rect: Rect, grid = GRID): Point {
  const [cx, cy] = centre(rect)
  return [rect.x + snapped(cx, grid) - cx, rect.y + snapped(cy, grid) - cy]
}

function moves(rects: ReadonlyMap<string, Rect>, by: (rect: Rect) => Point): Moves {
  const out: Moves = new Map()
  for (const [id, rect] of rects) {
    const [dx, dy] = by(rect)
    if (dx !== 0 || dy !== 0) out.set(id, [dx, dy])
  }
  return out
}

export function align(rects: ReadonlyMap<string, Rect>, edge: Edge): Moves {
  const all = [...rects.values()]
  if (all.length < 2) return new Map()
  const left = Math.min(...all.map((r) => r.x))
  const right = Math.max(...all.map((r) => r.x + r.width))
  const top = Math.min(...all.map((r) => r.y))
  const bottom = Math.max(...all.map((r) => r.y + r.height))
  // The mean of the centres moves shapes least.
  const mean = (axis: 0 | 1): number => Math.round(all.reduce((sum, r) => sum + centre(r)[axis], 0) / all.length)
  const [middleX, middleY] = [mean(0), mean(1)]
  return moves(rects, (r) => {
    switch (edge) {
      case 'left':
        return [left - r.x, 0]
      case 'right':
        return [right - r.x - r.width, 0]
      case 'top':
        return [0, top - r.y]
      case 'bottom':
        return [0, bottom - r.y - r.height]
      case 'centre':
        return [middleX - centre(r)[0], 0]
      case 'middle':
        return [0, middleY - centre(r)[1]]
    }
  })
}

// Equal gaps between neighbours; the first and the last stay.
export function distribute(rects: ReadonlyMap<string, Rect>, axis: 'x' | 'y'): Moves {
  if (rects.size < 3) return new Map()
  const size = axis === 'x' ? 'width' : 'height'
  const sorted = [...rects].sort(([, a], [, b]) => a[axis] + a[size] / 2 - b[axis] - b[size] / 2)
  const first = sorted[0]?.[1]
  const last = sorted.at(-1)?.[1]
  if (!first || !last) return new Map()
  const room = last[axis] + last[size] - first[axis]
  const taken = sorted.reduce((sum, [, rect]) => sum + rect[size], 0)
  const gap = (room - taken) / (sorted.length - 1)
  const out: Moves = new Map()
  let at = first[axis]
  for (const [id, rect] of sorted) {
    const by = Math.round(at - rect[axis])
    if (by !== 0) out.set(id, axis === 'x' ? [by, 0] : [0, by])
    at += rect[size] + gap
  }
  return out
}
