// What hands do on the canvas → operations of the contract.
//
// In: a drawing and a gesture (shapes were moved by so much, an arrow was drawn, keys). Out: an operation, or a reason why there
// is none. The meaning of an operation for the text is the server's.

import { type Point, centre } from './geometry'
import type { Arrow, Box, Branch, Drawing, Figure, Line, Operation, Shape } from './protocol'
import type { Selection } from './pick'

const rounded = (value: number): number => Math.round(value)

// Moves shapes.
export function move(drawing: Drawing, by: ReadonlyMap<string, Point>): Operation | null {
  const places: Record<string, [number, number]> = {}
  for (const box of drawing.picture.boxes) {
    const [dx, dy] = by.get(box.id) ?? [0, 0]
    // The frame of a composite state follows what lies in it.
    if (box.figure === 'exit' || box.figure === 'composite' || (dx === 0 && dy === 0)) continue
    const [cx, cy] = centre(box)
    places[box.id] = [rounded(cx + dx), rounded(cy + dy)]
  }
  return Object.keys(places).length > 0 ? { kind: 'move', places } : null
}

// The composite states that a shape stands in, from the innermost out.
export function holders(drawing: Drawing, id: string): string[] {
  const out: string[] = []
  for (let at: string | null | undefined = id; at; ) {
    at = drawing.picture.boxes.find((box) => box.id === at)?.within
    if (at) out.push(at)
  }
  return out
}

// Moves shapes, and puts them into the composite state on whose frame they are let go. A frame follows the shapes that it holds, so out of
// it they go only if that is `meant`.
export function moveInto(drawing: Drawing, by: ReadonlyMap<string, Point>, meant: boolean): Operation | null {
  const operation = move(drawing, by)
  if (operation?.kind !== 'move') return operation
  const frames = drawing.picture.boxes.filter((box) => box.figure === 'composite')
  frames.sort((a, b) => a.width * a.height - b.width * b.height)
  const moved = Object.entries(operation.places).filter(([id]) => id !== 'enter')
  const under = ([x, y]: readonly [number, number]): string | null =>
    frames.find((frame) => x > frame.x && x < frame.x + frame.width && y > frame.y && y < frame.y + frame.height)?.id ?? null
  const into = moved[0] ? under(moved[0][1]) : null
  const goes = moved.filter(([id, at]) => {
    const around = holders(drawing, id)
    return under(at) === into && (around[0] ?? null) !== into && (meant || (into !== null && !around.includes(into)))
  })
  return goes.length > 0 ? { kind: 'nest', ids: goes.map(([id]) => id), into, places: operation.places } : operation
}

// The composite states that a shape may be put into.
export const frames = (drawing: Drawing, box: Box): string[] =>
  drawing.picture.boxes.filter((other) => other.figure === 'composite' && other.id !== box.id && !holders(drawing, other.id).includes(box.id)).map((other) => other.id)

// What changes properties leaves the places to the layout, if the text has none.
const UNPLACED: Operation['kind'][] = ['layout', 'machine', 'set', 'addPhase', 'removePhase', 'movePhase', 'addAge']

// Where all shapes are, for an operation on a drawing that has no places in the text: so that nothing else moves.
export function kept(drawing: Drawing, operation: Operation): { places?: Record<string, [number, number]> } {
  if (drawing.placed || UNPLACED.includes(operation.kind)) return {}
  const all = drawing.picture.boxes.filter((box) => box.figure !== 'exit' && box.figure !== 'composite')
  const middle = (box: Box): [number, number] => [rounded(centre(box)[0]), rounded(centre(box)[1])]
  return { places: Object.fromEntries(all.map((box) => [box.id, middle(box)])) }
}

const SHAPES: Record<Figure, Shape | null> = {
  circle: 'state',
  composite: 'composite',
  hexagon: 'guard',
  rectangle: 'action',
  block: 'instance',
  enter: null,
  exit: null,
  component: 'component',
  channel: 'channel',
  device: 'sensor',
}

export const shapeOf = (box: Box): Shape | null => SHAPES[box.figure]

// The name that the contract has for an end: `exit 1` is `exit`, `exit yes 1` is `exit yes`.
export const endOf = (box: Box): string => (box.figure === 'exit' ? box.id.replace(/ \d+$/, '') : box.id)

const isExit = (end: string): boolean => ['exit', 'exit yes', 'exit no'].includes(end)

// Whether the arrows out of a shape say yes or no: it is a guard, or the block of a pattern that answers.
export const forks = (box: Box): boolean => box.figure === 'hexagon' || box.answers === true

export const arrowOf = (drawing: Drawing, line: Line): Arrow | null => {
  const from = drawing.picture.boxes[line.from]
  const to = drawing.picture.boxes[line.to]
  return from && to ? { from: endOf(from), branch: line.branch, to: endOf(to) } : null
}

export type Refusal = 'into-enter' | 'out-of-exit' | 'there-already' | 'no-exit-here' | 'to-itself'

// Whether an arrow may be drawn at all; what is more subtle is the server's to refuse.
export function mayConnect(drawing: Drawing, arrow: Arrow): Refusal | null {
  if (arrow.to === 'enter') return 'into-enter'
  if (isExit(arrow.from)) return 'out-of-exit'
  if (isExit(arrow.to) && drawing.kind !== 'pattern') return 'no-exit-here'
  if (arrow.from === arrow.to && drawing.kind === 'system') return 'to-itself'
  const known = drawing.picture.lines.some((line) => {
    const there = arrowOf(drawing, line)
    return there && there.from === arrow.from && there.branch === arrow.branch && there.to === arrow.to
  })
  return known ? 'there-already' : null
}

export const connect = (arrow: Arrow): Operation => ({ kind: 'connect', ...arrow })

export function redirect(drawing: Drawing, line: Line, end: 'from' | 'to', box: Box, branch: Branch): Operation | null {
  const old = arrowOf(drawing, line)
  if (!old) return null
  const fresh: Arrow =
    end === 'to'
      ? { ...old, to: endOf(box) }
      : { ...old, from: endOf(box), branch: forks(box) ? (branch ?? old.branch ?? 'yes') : null }
  if (fresh.from === old.from && fresh.to === old.to && fresh.branch === old.branch) return null
  return { kind: 'redirect', ...old, new: fresh }
}

// Deletes what is selected: shapes in one operation, else arrows one by one. Floating ends go with their arrows.
export function remove(drawing: Drawing, selection: Selection): Operation[] {
  const ids = selection.boxes.filter((id) => {
    const box = drawing.picture.boxes.find((box) => box.id === id)
    return box && box.figure !== 'enter' && box.figure !== 'exit'
  })
  if (ids.length > 0) return [{ kind: 'delete', ids }]
  const lines = new Set(selection.lines)
  drawing.picture.lines.forEach((line, index) => {
    const to = drawing.picture.boxes[line.to]
    const from = drawing.picture.boxes[line.from]
    if ((to?.figure === 'exit' && selection.boxes.includes(to.id)) || (from?.figure === 'enter' && selection.boxes.includes(from.id)))
      lines.add(index)
  })
  const out: Operation[] = []
  for (const index of lines) {
    const line = drawing.picture.lines[index]
    const arrow = line && arrowOf(drawing, line)
    if (arrow) out.push({ kind: 'disconnect', ...arrow })
  }
  return out
}

// The branch that a new arrow from a shape takes: the first free exit.
export function freeBranch(drawing: Drawing, box: Box): Branch {
  if (!forks(box)) return null
  const index = drawing.picture.boxes.indexOf(box)
  const taken = drawing.picture.lines.filter((line) => line.from === index).map((line) => line.branch)
  return taken.includes('yes') && !taken.includes('no') ? 'no' : 'yes'
}

// Which shapes a kind of drawing can have, in the order of the palette, with their keys.
export interface Tool {
  shape: Shape
  key: string
}

export function toolsFor(kind: Drawing['kind']): Tool[] {
  return kind === 'system'
    ? [
        { shape: 'component', key: 'c' },
        { shape: 'sensor', key: 's' },
        { shape: 'actuator', key: 'a' },
      ]
    : [
        { shape: 'state', key: 's' },
        { shape: 'composite', key: 'c' },
        { shape: 'guard', key: 'g' },
        { shape: 'action', key: 'a' },
        { shape: 'instance', key: 'i' },
      ]
}
