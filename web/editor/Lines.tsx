// The arrows of a drawing: the server's routes; while a shape is moved, straight lines that follow it.
//
// In: the drawing, how far shapes have been moved since, what is selected. Out: an SVG below the shapes, in which arrows
// are selected, and one above, by which their ends are taken hold of.

import { type PointerEvent, type ReactNode, memo } from 'react'

import { type Point, arrowPath, followed } from '../diagram/geometry'
import type { Box, Drawing, Line } from '../diagram/protocol'

const STILL: Point = [0, 0]

export interface LinesProps {
  drawing: Drawing
  offsets: ReadonlyMap<string, Point>
  selected: readonly number[]
  lit: ReadonlySet<number>
  // The arrow whose end is in the hand.
  held: number | null
  name: (line: Line) => string
  onPick: (index: number, event: PointerEvent) => void
}

export function Lines(props: LinesProps): ReactNode {
  const { drawing, offsets, selected, lit, held } = props
  const { boxes, lines } = drawing.picture
  const at = (index: number): Point => {
    const id = boxes[index]?.id
    return (id !== undefined && offsets.get(id)) || STILL
  }
  return (
    <svg className="lines" width="1" height="1">
      {lines.map((line, index) => {
        const [from, to] = [at(line.from), at(line.to)]
        return (
          <Arrow
            key={index}
            line={line}
            index={index}
            boxes={boxes}
            fx={from[0]}
            fy={from[1]}
            tx={to[0]}
            ty={to[1]}
            selected={selected.includes(index)}
            lit={lit.has(index)}
            held={held === index}
            label={props.name}
            onPick={props.onPick}
          />
        )
      })}
    </svg>
  )
}

interface ArrowProps {
  line: Line
  index: number
  boxes: Box[]
  fx: number
  fy: number
  tx: number
  ty: number
  selected: boolean
  lit: boolean
  held: boolean
  label: (line: Line) => string
  onPick: LinesProps['onPick']
}

const Arrow = memo(function Arrow(props: ArrowProps): ReactNode {
  const { line, index, boxes, selected } = props
  const points = followed(line, boxes, [props.fx, props.fy], [props.tx, props.ty])
  const { line: path, tip } = arrowPath(points)
  const name = `arrow${selected ? ' selected' : ''}${props.lit ? ' lit' : ''}${props.held ? ' held' : ''}`
  return (
    <g className={name} onPointerDown={(event) => props.onPick(index, event)} aria-label={props.label(line)} role="img">
      <path className="reach" d={path} />
      <path className="stroke" d={path} />
      <path className="tip" d={tip} />
    </g>
  )
})

// The ends of the selected arrows, above the shapes: there they are taken hold of.
export function Holds({ drawing, selected, onGrip }: { drawing: Drawing; selected: readonly number[]; onGrip: (index: number, end: 'from' | 'to', event: PointerEvent) => void }): ReactNode {
  return (
    <svg className="lines holds" width="1" height="1">
      {selected.map((index) => {
        const points = drawing.picture.lines[index]?.points ?? []
        const [start, end] = [points[0], points.at(-1)]
        return (
          start &&
          end && (
            <g key={index}>
              <circle className="hold nodrag nopan" cx={start[0]} cy={start[1]} r={5} onPointerDown={(event) => onGrip(index, 'from', event)} />
              <circle className="hold nodrag nopan" cx={end[0]} cy={end[1]} r={5} onPointerDown={(event) => onGrip(index, 'to', event)} />
            </g>
          )
        )
      })}
    </svg>
  )
}
