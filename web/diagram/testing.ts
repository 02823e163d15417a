// What tests need: small drawings, and numbers that are as random the next time.

import type { Box, Drawing, Figure, Line } from './protocol'

export function box(id: string, figure: Figure, x: number, y: number, width = 80, height = 40): Box {
  return {
    id,
    figure,
    dashed: false,
    initial: false,
    lines: [id],
    details: [],
    x,
    y,
    width,
    height,
    label: '',
    link: null,
    refine: null,
    of: null,
    opens: null,
    range: null,
    nameRange: null,
  }
}

export const line = (from: number, to: number, branch: Line['branch'] = null): Line => ({
  from,
  to,
  branch,
  points: [
    [0, 0],
    [10, 0],
  ],
  range: null,
})

export function drawing(boxes: Box[], lines: Line[] = [], kind: Drawing['kind'] = 'machine', placed = true): Drawing {
  const range = { start: { line: 0, character: 0 }, end: { line: 99, character: 0 } }
  const picture = { left: 0, top: 0, width: 500, height: 500, boxes, lines, labels: [] }
  return { name: 'm', kind, title: 'M', link: null, range, placed, picture, lights: [] }
}

// A small generator, so that a failure comes again.
export function random(seed: number): () => number {
  let state = seed
  return () => {
    state = (state * 1664525 + 1013904223) >>> 0
    return state / 2 ** 32
  }
}
