// Copying parts of a drawing: shapes with the arrows between them, as text for the system's clipboard.
//
// In: a drawing and what is selected; later a text and a place. Out: a text, or a `paste` operation. Fresh names are the
// server's business.

import { type Point, bounds, centre } from './geometry'
import { arrowOf, shapeOf } from './gestures'
import type { Arrow, Drawing, Operation, PastedShape } from './protocol'

const MARK = 'groundstate-shapes'

interface Clip {
  kind: typeof MARK
  version: 1
  shapes: PastedShape[]
  arrows: Arrow[]
}

export function copied(drawing: Drawing, ids: readonly string[]): string | null {
  const shapes: PastedShape[] = []
  for (const box of drawing.picture.boxes) {
    const shape = shapeOf(box)
    // A channel comes with the arrow that is drawn between components.
    if (!ids.includes(box.id) || !shape || shape === 'channel') continue
    const [x, y] = centre(box)
    const link = box.link === '' ? null : box.link
    shapes.push({ id: box.id, shape, text: box.label, link, of: box.of, at: [Math.round(x), Math.round(y)] })
  }
  if (shapes.length === 0) return null
  const inside = new Set(shapes.map((shape) => shape.id))
  const arrows = drawing.picture.lines
    .map((line) => arrowOf(drawing, line))
    .filter((arrow): arrow is Arrow => arrow !== null && inside.has(arrow.from) && inside.has(arrow.to))
  const clip: Clip = { kind: MARK, version: 1, shapes, arrows }
  return JSON.stringify(clip)
}

function isClip(value: unknown): value is Clip {
  const clip = value as Partial<Clip> | null
  return clip?.kind === MARK && Array.isArray(clip.shapes) && Array.isArray(clip.arrows)
}

// The operation that pastes a text with its middle at a place, or beside where it was copied; null if it holds no shapes.
export function pasted(text: string, at: Point | null): Operation | null {
  let clip: unknown
  try {
    clip = JSON.parse(text)
  } catch {
    return null
  }
  if (!isClip(clip)) return null
  const box = bounds(clip.shapes.map(({ at: [x, y] }) => ({ x, y, width: 0, height: 0 })))
  if (!box) return null
  const [cx, cy] = centre(box)
  const by: Point = at ? [Math.round((at[0] - cx) / 10) * 10, Math.round((at[1] - cy) / 10) * 10] : [40, 40]
  const shapes = clip.shapes.map((shape): PastedShape => ({ ...shape, at: [shape.at[0] + by[0], shape.at[1] + by[1]] }))
  return { kind: 'paste', shapes, arrows: clip.arrows }
}
