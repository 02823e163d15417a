// Drawing an arrow by the keyboard: it begins at the selected shape, keys choose what it leads to.
//
// Owns: the arrow that is being drawn, from its key to Enter or Escape. Out: what the canvas shows of it, what is said of it, and at the
// end an operation. What the keys choose from is `diagram/behind`.

import { useCallback, useEffect, useState } from 'react'

import { type Target, branches, mayBegin, targets, towards } from '../diagram/behind'
import { type Point, border, centre } from '../diagram/geometry'
import { connect, endOf, freeBranch } from '../diagram/gestures'
import type { Branch, Drawing } from '../diagram/protocol'
import { words } from '../words'
import type { Chart } from './chart'
import type { Drawn } from './connect'
import type { Studio } from './studio'

interface Held {
  from: string
  branch: Branch
  to: string | null
}

export interface Linking {
  drawn: Drawn | null
  // What is going on, in words.
  note: string | null
  begin: (id: string) => void
  leave: () => void
  // Whether a key was meant for the arrow.
  key: (event: { key: string; shiftKey: boolean }) => boolean
}

const DIRECTIONS: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }

export function useLinking(studio: Studio, chart: Chart, drawing: Drawing, seen: (id: string) => void): Linking {
  const [held, setHeld] = useState<Held | null>(null)
  useEffect(() => setHeld(null), [drawing.name])
  const from = held && drawing.picture.boxes.find((box) => box.id === held.from)
  const known = from ? targets(drawing, from, held.branch) : []
  const target = known.find(({ to }) => to === held?.to) ?? null
  const said = (id: string): string => drawing.picture.boxes.find((box) => endOf(box) === id || box.id === id)?.lines.join(' ') || id

  const aim = (next: Target | null, branch: Branch): void => {
    if (!from || !next) return
    setHeld({ from: from.id, branch, to: next.to })
    if (next.box) seen(next.box.id)
  }

  const begin = useCallback(
    (id: string) => {
      const box = drawing.picture.boxes.find((box) => box.id === id)
      if (!box || chart.doc.readOnly) return
      if (!mayBegin(box)) return studio.tell(words.refused['out-of-exit'], 'refused')
      setHeld({ from: id, branch: freeBranch(drawing, box), to: null })
    },
    [chart, drawing, studio],
  )

  const key = (event: { key: string; shiftKey: boolean }): boolean => {
    if (!from || !held) return false
    const direction = DIRECTIONS[event.key]
    if (direction) {
      aim(towards(known, target?.box ?? from, direction), held.branch)
      return true
    }
    switch (event.key) {
      case 'Tab': {
        const at = target ? known.indexOf(target) : event.shiftKey ? 0 : -1
        aim(known.at((at + (event.shiftKey ? -1 : 1)) % known.length) ?? null, held.branch)
        return true
      }
      case 'Enter':
        if (!target) return true
        setHeld(null)
        void chart
          .operate(connect({ from: endOf(from), branch: held.branch, to: target.to }), { select: false })
          .then((made) => made && studio.tell(words.canvas.linked(said(held.from), held.branch, said(target.to))))
        return true
      case 'Escape':
        setHeld(null)
        return true
    }
    const branch = branches(from).find((one) => one?.charAt(0) === event.key.toLowerCase())
    if (branch) setHeld({ ...held, branch })
    return branch !== undefined
  }

  const leave = (): void => setHeld(null)
  if (!held || !from) return { drawn: null, note: null, begin, leave, key }
  const end = target?.box ? centre(target.box) : null
  const fast = border(from.figure, from, end ?? [from.x + from.width + 1, centre(from)[1]])
  const loose: Point = end ?? [from.x + from.width + 36, centre(from)[1]]
  const drawn: Drawn = { fast, loose, tip: true, over: target?.box ?? null, allowed: true, line: null }
  const note = words.canvas.linking(said(held.from), held.branch, target ? said(target.to) : null)
  return { drawn, note, begin, leave, key }
}
