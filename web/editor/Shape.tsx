// One shape of a drawing, as the command line draws it: circle, hexagon, rectangle, block, component, channel, device.
//
// In: a box and its labels in the picture's coordinates. Out: SVG around the box's upper left corner.
// SYNC(notation): crates/draw/src/svg.rs has the same numbers.

import { Fragment, type ReactNode, memo } from 'react'

import { hexagon } from '../diagram/geometry'
import type { Box, Label } from '../diagram/protocol'

const TEXT = 13
const LEADING = 16
const SMALL_LEADING = 14
const RULE = 8

const CLASSES = {
  circle: 'state',
  composite: 'composite',
  hexagon: 'guard',
  rectangle: 'action',
  block: 'instance',
  component: 'component',
  channel: 'channel',
  device: 'device',
  enter: 'end',
  exit: 'end',
} as const

const ROUND = { composite: 14, block: 8, component: 4, channel: 1e9, device: 4 } as Record<string, number>

function Outline({ box }: { box: Box }): ReactNode {
  const { width, height } = box
  const name = `shape ${CLASSES[box.figure]}${box.dashed ? ' refine' : ''}`
  switch (box.figure) {
    case 'circle':
      return (
        <>
          <circle className={name} cx={width / 2} cy={height / 2} r={width / 2} />
          {box.initial && <circle className="shape state inner" cx={width / 2} cy={height / 2} r={width / 2 - 3.5} />}
        </>
      )
    case 'hexagon': {
      const corners = hexagon({ x: 0, y: 0, width, height })
      return <polygon className={name} points={corners.map(([x, y]) => `${x},${y}`).join(' ')} />
    }
    case 'composite':
      return (
        <>
          <rect className={name} width={width} height={height} rx={14} />
          {box.initial && (
            <rect className="shape composite inner" x={3.5} y={3.5} width={width - 7} height={height - 7} rx={11} />
          )}
        </>
      )
    case 'enter':
    case 'exit':
      return <circle className="grip" cx={width / 2} cy={height / 2} r={5} />
    default: {
      const round = Math.min(ROUND[box.figure] ?? 3, height / 2)
      return (
        <>
          <rect className={name} width={width} height={height} rx={round} />
          {box.figure === 'block' &&
            [9, width - 9].map((x) => <path key={x} className="shape instance inner" d={`M${x} 0V${height}`} />)}
          {box.figure === 'component' && <Sign right={width - 9} top={8} />}
        </>
      )
    }
  }
}

// The sign of a component, as UML has it.
function Sign({ right, top }: { right: number; top: number }): ReactNode {
  const rect = (x: number, y: number, w: number, h: number): string => `M${x} ${y}h${w}v${h}h${-w}Z`
  const d = rect(right - 9, top, 9, 11) + rect(right - 11.5, top + 2, 5, 2.4) + rect(right - 11.5, top + 6.4, 5, 2.4)
  return <path className="shape component sign" d={d} />
}

function Words({ box, row }: { box: Box; row: string | null }): ReactNode {
  const { width, height } = box
  const cx = width / 2
  const ruled = box.details.some((detail) => detail.right !== null)
  const rest = box.details.length * SMALL_LEADING + (ruled ? RULE : 0)
  const first = height / 2 - ((box.lines.length - 1) * LEADING + rest) / 2 + TEXT * 0.35
  const named = box.figure === 'component' || box.figure === 'channel' || box.figure === 'device'
  let y = first + box.lines.length * LEADING - 2
  let above = true
  const details = box.details.map((detail, index) => {
    if (detail.right === null) {
      const at = y
      y += SMALL_LEADING
      return (
        <text key={index} className="small faint" x={cx} y={at}>
          {detail.text}
        </text>
      )
    }
    const rule = above ? y - 7 : null
    if (above) y += RULE
    above = false
    const at = y
    y += SMALL_LEADING
    return (
      <Fragment key={index}>
        {rule !== null && <path className={`shape ${CLASSES[box.figure]} inner sign`} d={`M0 ${rule}H${width}`} />}
        <g className={row !== null && detail.id === row ? 'row-lit' : undefined}>
          <rect className="row" x={6} y={at - 10.5} width={width - 12} height={14} rx={3} />
          <text className="small start" x={12} y={at}>
            {detail.text}
          </text>
          <text className="small end" x={width - 12} y={at}>
            {detail.right}
          </text>
        </g>
      </Fragment>
    )
  })
  return (
    <>
      {box.lines.map((line, index) => (
        <text key={index} className={named ? 'name' : undefined} x={cx} y={first + index * LEADING}>
          {line}
        </text>
      ))}
      {details}
    </>
  )
}

// The words of a composite state stand at the top of its frame.
function FrameWords({ box }: { box: Box }): ReactNode {
  const details = box.lines.length
  return (
    <>
      {box.lines.map((line, index) => (
        <text key={index} className="name start" x={16} y={20 + index * SMALL_LEADING}>
          {line}
        </text>
      ))}
      {box.details.map((detail, index) => (
        <text key={`detail ${index}`} className="small faint start" x={16} y={20 + (details + index) * SMALL_LEADING}>
          {detail.text}
        </text>
      ))}
    </>
  )
}

export const Shape = memo(function Shape({ box, labels, row = null }: { box: Box; labels: Label[]; row?: string | null }): ReactNode {
  return (
    <svg className="figure" width={box.width} height={box.height} aria-hidden="true">
      <Outline box={box} />
      {box.figure === 'composite' ? <FrameWords box={box} /> : <Words box={box} row={row} />}
      {labels.map((label, index) => {
        const x = (label.isLink ? label.x : label.x + label.width / 2) - box.x
        const y = label.y + label.height - 3.5 - box.y
        return (
          <text key={index} className={label.isLink ? 'link' : 'branch'} x={x} y={y}>
            {label.text}
          </text>
        )
      })}
    </svg>
  )
})

// The outline alone, larger by a margin: what shows that a shape is selected or at fault.
export function Halo({ box, by }: { box: Box; by: number }): ReactNode {
  const { width, height } = box
  if (box.figure === 'circle') return <circle cx={width / 2} cy={height / 2} r={width / 2 + by} />
  if (box.figure === 'hexagon') {
    const corners = hexagon({ x: -by * 1.15, y: -by, width: width + 2.3 * by, height: height + 2 * by })
    return <polygon points={corners.map(([x, y]) => `${x},${y}`).join(' ')} />
  }
  if (box.figure === 'enter' || box.figure === 'exit') return <circle cx={width / 2} cy={height / 2} r={9} />
  const round = Math.min(ROUND[box.figure] ?? 3, height / 2) + by
  return <rect x={-by} y={-by} width={width + 2 * by} height={height + 2 * by} rx={round} />
}
