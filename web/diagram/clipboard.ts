// Copying parts of a drawing: shapes, composite states with what they hold, and the arrows between, as text for the system's clipboard.
//
// In: a drawing and what is selected; later a text and a place. Out: a text, or a `paste` operation. Fresh names are the
// server's business.

import { type Point, bounds, centre } from './geometry'
import { arrowOf, holders, shapeOf } from './gestures'
import type { Arrow, Drawing, Operation, PastedComposite, PastedShape } from './protocol'

const MARK = 'groundstate-shapes'

interface Clip {
  kind: typeof MARK
  version: 1
  shapes: PastedShape[]
  composites: PastedComposite[]
  arrows: Arrow[]
}

export function copied(drawing: Drawing, ids: readonly string[]): string | null {
  const shapes: PastedShape[] = []
  const composites: PastedComposite[] = []
  const inside = new Set<string>()
  for (const box of drawing.picture.boxes) {
    const shape = shapeOf(box)
    // A channel comes with the arrow that is drawn between components, and what stands in a composite state with that.
    if (!ids.includes(box.id) || !shape || shape === 'channel' || holders(drawing, box.id).some((around) => ids.includes(around))) continue
    inside.add(box.id)
    const middle = (of: typeof box): [number, number] => [Math.round(centre(of)[0]), Math.round(centre(of)[1])]
    if (box.composite) {
      const held = drawing.picture.boxes.filter((other) => holders(drawing, other.id).includes(box.id))
      held.forEach((other) => inside.add(other.id))
      const places = Object.fromEntries(held.filter((other) => !other.composite).map((other) => [other.id, middle(other)]))
      composites.push({ id: box.id, source: box.composite.source, places })
      continue
    }
    const link = box.link === '' ? null : box.link
    shapes.push({ id: box.id, shape, text: box.label, link, of: box.of, at: middle(box) })
  }
  if (inside.size === 0) return null
  const arrows = drawing.picture.lines
    .map((line) => arrowOf(drawing, line))
    .filter((arrow): arrow is Arrow => arrow !== null && inside.has(arrow.from) && inside.has(arrow.to))
  const clip: Clip = { kind: MARK, version: 1, shapes, composites, arrows }
  return JSON.stringify(clip)
}

function isClip(value: unknown): value is Clip {
  const clip = value as Partial<Clip> | null
  return clip?.kind === MARK && Array.isArray(clip.shapes) && Array.isArray(clip.arrows)
}

const STEP = 20

// The operation that pastes a text with its middle at a place, or beside where it was copied; null if it holds no shapes. Where one of them
// would lie on a shape that is there, all go on by a step.
export function pasted(text: string, at: Point | null, drawing: Drawing | null = null): Operation | null {
  let clip: unknown
  try {
    clip = JSON.parse(text)
  } catch {
    return null
  }
  if (!isClip(clip)) return null
  // Clips of former windows have none.
  const composites = Array.isArray(clip.composites) ? clip.composites : []
  const places = [...clip.shapes.map(({ at }) => at), ...composites.flatMap((one) => Object.values(one.places))]
  const box = bounds(places.map(([x, y]) => ({ x, y, width: 0, height: 0 })))
  if (!box) return null
  const [cx, cy] = centre(box)
  // The frame of a composite state would lie over the one that it was copied from.
  const beside: Point = composites.length > 0 ? [Math.round(box.width) + 200, 0] : [40, 40]
  const by: Point = at ? [Math.round((at[0] - cx) / 10) * 10, Math.round((at[1] - cy) / 10) * 10] : beside
  const taken = new Set((drawing?.picture.boxes ?? []).map((box) => centre(box).map(Math.round).join()))
  let shift = 0
  const moved = (at: Point): [number, number] => [at[0] + by[0] + shift, at[1] + by[1] + shift]
  while (places.some((place) => taken.has(moved(place).join()))) shift += STEP
  const shapes = clip.shapes.map((shape): PastedShape => ({ ...shape, at: moved(shape.at) }))
  const held = composites.map((one): PastedComposite => ({
    ...one,
    places: Object.fromEntries(Object.entries(one.places).map(([id, at]) => [id, moved(at)])),
  }))
  return { kind: 'paste', shapes, composites: held, arrows: clip.arrows }
}
