// The nodes of the canvas from a drawing and what is known of it.
//
// In: drawing, offsets while dragging, selection, lit states, values, faults. Out: React Flow's nodes. INVARIANT: a node that is as
// it was is the same object, so that React draws only what is new.

import { useRef } from 'react'

import { type Point, type Side, floats, guardSides } from '../diagram/geometry'
import { forks } from '../diagram/gestures'
import { type Fault, faultsOn, spoken } from '../diagram/pick'
import type { Box, Drawing, Label } from '../diagram/protocol'
import { words } from '../words'
import type { Coverage } from './marks'
import type { Port, ShapeNodeType } from './ShapeNode'

export interface Known {
  drawing: Drawing
  offsets: ReadonlyMap<string, Point>
  selected: ReadonlySet<string>
  lit: ReadonlyMap<string, string[]>
  values: ReadonlyMap<string, string>
  faults: readonly Fault[]
  breaks: ReadonlySet<string>
  covered: ReadonlyMap<string, Coverage>
  editing: string | null
  readOnly: boolean
}

const SIDES: Side[] = ['top', 'right', 'bottom', 'left']

function portsOf(drawing: Drawing, index: number): Port[] {
  const box = drawing.picture.boxes[index]
  if (!box || box.figure === 'exit') return []
  if (box.figure === 'enter') return [{ side: 'bottom', branch: null }]
  if (!forks(box)) return SIDES.map((side) => ({ side, branch: null }))
  const { yes, no } = guardSides(index, drawing.picture.boxes, drawing.picture.lines)
  return [
    { side: yes, branch: 'yes' },
    { side: no, branch: 'no' },
  ]
}

interface Kept {
  key: string
  box: Box
  node: ShapeNodeType
}

interface Layered {
  drawing: Drawing
  labels: Label[][]
  ports: Port[][]
  shown: string[]
  names: string[]
}

function layered(drawing: Drawing): Layered {
  const { boxes, labels } = drawing.picture
  const byBox: Label[][] = boxes.map(() => [])
  for (const label of labels) byBox[label.of]?.push(label)
  const names = boxes.map((_, index) => spoken(drawing, index, words.spoken))
  const ports = boxes.map((_, index) => portsOf(drawing, index))
  // All that a figure shows, with its labels, from its own corner: equal texts are equal figures.
  const shown = boxes.map((box, index) => {
    const mine = (byBox[index] ?? []).map((label) => [label.text, label.x - box.x, label.y - box.y])
    return JSON.stringify([{ ...box, x: 0, y: 0, range: null, nameRange: null }, mine, ports[index], names[index]])
  })
  return { drawing, labels: byBox, ports, shown, names }
}

export function useNodes(known: Known): ShapeNodeType[] {
  const kept = useRef(new Map<string, Kept>())
  const layer = useRef<Layered | null>(null)
  if (layer.current?.drawing !== known.drawing) layer.current = layered(known.drawing)
  const { labels, ports, shown, names } = layer.current
  const faults = known.faults.length > 0 ? faultsOn(known.drawing, known.faults) : new Map<string, Fault>()
  const next = new Map<string, Kept>()
  const nodes = known.drawing.picture.boxes.map((box, index): ShapeNodeType => {
    const [dx, dy] = known.offsets.get(box.id) ?? [0, 0]
    const selected = known.selected.has(box.id)
    const lit = known.lit.get(box.id) ?? null
    const row = box.details.find((detail) => detail.id !== null && known.lit.has(detail.id))?.id ?? null
    const value = known.values.get(box.id) ?? null
    const fault = faults.get(box.id) ?? null
    const broken = known.breaks.has(box.id)
    const covered = known.covered.get(box.id) ?? null
    const coverage = covered && { covered: covered.covered, told: covered.covered ? words.marks.covered : words.marks.notCovered(covered.told.join('; ')) }
    const editing = known.editing === box.id
    const [x, y] = [box.x + dx, box.y + dy]
    const key = `${x} ${y} ${selected} ${lit?.join()} ${row} ${value} ${fault?.severity}${fault?.message} ${coverage?.told} ${broken} ${editing} ${known.readOnly}\n${shown[index]}`
    const old = kept.current.get(box.id)
    if (old?.key === key) {
      next.set(box.id, old)
      return old.node
    }
    const frame = box.figure === 'composite'
    const movable = !known.readOnly && box.figure !== 'exit' && !frame
    const node: ShapeNodeType = {
      id: box.id,
      type: 'shape',
      position: { x, y },
      width: box.width,
      height: box.height,
      measured: { width: box.width, height: box.height },
      handles: [],
      selected,
      draggable: movable,
      selectable: true,
      focusable: true,
      connectable: false,
      deletable: false,
      // A frame lies behind arrows and shapes, and is taken at its edge or its words.
      zIndex: frame ? -2 : selected ? 2 : floats(box.figure) ? 0 : 1,
      ...(frame && { style: { pointerEvents: 'none' as const } }),
      ariaLabel: coverage ? `${names[index]}, ${coverage.told}` : names[index],
      data: {
        box,
        labels: labels[index] ?? [],
        ports: ports[index] ?? [],
        lit,
        row,
        value,
        fault: fault && { severity: fault.severity, message: fault.message },
        coverage,
        broken,
        editing,
        readOnly: known.readOnly,
      },
    }
    next.set(box.id, { key, box, node })
    return node
  })
  kept.current = next
  return nodes
}
