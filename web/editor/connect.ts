// Drawing an arrow, or moving an end of one, with the pointer.
//
// Owns: the gesture from press to release. In: where it began. Out: what is under the pointer meanwhile, and at the end an operation,
// a refusal, or the question what is to be created at the free place.

import { type PointerEvent as ReactPointerEvent, useCallback, useEffect, useRef, useState } from 'react'

import { type Point, hit, sidePoint } from '../diagram/geometry'
import { connect, endOf, freeBranch, mayConnect, redirect } from '../diagram/gestures'
import type { Arrow, Box, Drawing } from '../diagram/protocol'
import { words } from '../words'
import type { Chart } from './chart'
import type { Port } from './ShapeNode'
import type { Studio } from './studio'

export interface Drawn {
  // Where the arrow is fast, and where its loose end is.
  fast: Point
  loose: Point
  // The loose end is the tip.
  tip: boolean
  // The shape under the loose end.
  over: Box | null
  allowed: boolean
  // The arrow that is being moved.
  line: number | null
}

export interface Dropped {
  arrow: Omit<Arrow, 'to'>
  at: Point
  screen: { x: number; y: number }
}

type Held =
  | { kind: 'new'; from: Box; port: Port; fast: Point }
  | { kind: 'end'; index: number; end: 'from' | 'to'; fast: Point }

export interface Connecting {
  drawn: Drawn | null
  begin: (id: string, port: Port, event: ReactPointerEvent) => void
  grip: (index: number, end: 'from' | 'to', event: ReactPointerEvent) => void
}

export function useConnecting(
  studio: Studio,
  chart: Chart,
  toFlow: (at: { x: number; y: number }) => { x: number; y: number },
  dropped: (drop: Dropped) => void,
): Connecting {
  const [drawn, setDrawn] = useState<Drawn | null>(null)
  const held = useRef<Held | null>(null)
  const stop = useRef<() => void>(() => undefined)
  useEffect(() => () => stop.current(), [])

  const arrowTo = (drawing: Drawing, what: Held, box: Box): Arrow | null => {
    if (what.kind === 'new') return { from: endOf(what.from), branch: what.port.branch, to: endOf(box) }
    const line = drawing.picture.lines[what.index]
    const branch = freeBranch(drawing, box)
    const operation = line && redirect(drawing, line, what.end, box, branch)
    return operation?.kind === 'redirect' ? operation.new : null
  }

  const follow = useCallback(
    (what: Held, event: { clientX: number; clientY: number }) => {
      const drawing = chart.drawing
      if (!drawing) return
      const { x, y } = toFlow({ x: event.clientX, y: event.clientY })
      const over = drawing.picture.boxes[hit(drawing.picture.boxes, [x, y], 6)] ?? null
      const arrow = over && arrowTo(drawing, what, over)
      const allowed = arrow ? mayConnect(drawing, arrow) === null : over === null
      const tip = what.kind === 'new' || what.end === 'to'
      setDrawn({ fast: what.fast, loose: [x, y], tip, over, allowed, line: what.kind === 'end' ? what.index : null })
    },
    [chart, toFlow],
  )

  const finish = useCallback(
    (what: Held, event: { clientX: number; clientY: number }) => {
      const drawing = chart.drawing
      setDrawn(null)
      if (!drawing) return
      const screen = { x: event.clientX, y: event.clientY }
      const { x, y } = toFlow(screen)
      const over = drawing.picture.boxes[hit(drawing.picture.boxes, [x, y], 6)]
      if (what.kind === 'new') {
        const { from, port } = what
        if (!over) return dropped({ arrow: { from: endOf(from), branch: port.branch }, at: [x, y], screen })
        const arrow: Arrow = { from: endOf(from), branch: port.branch, to: endOf(over) }
        // A press and release on the port itself is no arrow.
        if (over === from && Math.hypot(x - what.fast[0], y - what.fast[1]) < 12) return
        const refusal = mayConnect(drawing, arrow)
        if (refusal) return studio.tell(words.refused[refusal], 'refused')
        return void chart.operate(connect(arrow), { select: false })
      }
      const line = drawing.picture.lines[what.index]
      if (!line || !over) return
      const operation = redirect(drawing, line, what.end, over, freeBranch(drawing, over))
      if (operation?.kind !== 'redirect') return
      const refusal = mayConnect(drawing, operation.new)
      if (refusal) return studio.tell(words.refused[refusal], 'refused')
      void chart.operate(operation, { select: false })
    },
    [chart, dropped, studio, toFlow],
  )

  const start = useCallback(
    (what: Held, event: ReactPointerEvent) => {
      if (event.button !== 0) return
      event.stopPropagation()
      event.preventDefault()
      held.current = what
      const move = (event: PointerEvent): void => follow(what, event)
      const up = (event: PointerEvent): void => {
        stop.current()
        finish(what, event)
      }
      const key = (event: KeyboardEvent): void => {
        if (event.key !== 'Escape') return
        stop.current()
        setDrawn(null)
      }
      stop.current = () => {
        window.removeEventListener('pointermove', move)
        window.removeEventListener('pointerup', up)
        window.removeEventListener('keydown', key, true)
        held.current = null
      }
      window.addEventListener('pointermove', move)
      window.addEventListener('pointerup', up)
      window.addEventListener('keydown', key, true)
    },
    [finish, follow],
  )

  const begin = useCallback(
    (id: string, port: Port, event: ReactPointerEvent) => {
      const from = chart.drawing?.picture.boxes.find((box) => box.id === id)
      if (from) start({ kind: 'new', from, port, fast: sidePoint(from, port.side) }, event)
    },
    [chart, start],
  )

  const grip = useCallback(
    (index: number, end: 'from' | 'to', event: ReactPointerEvent) => {
      const points = chart.drawing?.picture.lines[index]?.points
      const fast = end === 'to' ? points?.[0] : points?.at(-1)
      if (fast) start({ kind: 'end', index, end, fast }, event)
    },
    [chart, start],
  )

  return { drawn, begin, grip }
}
