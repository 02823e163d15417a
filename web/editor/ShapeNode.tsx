// A shape as a node of the canvas: the figure with what the canvas adds to it.
//
// In: the box, and marks (lit, value, fault, breakpoint). Out: the figure, its halo, the ports from which arrows are drawn, the
// field in which its text is edited. The canvas' actions come through a context, so that nodes are drawn again only for data.

import type { Node, NodeProps } from '@xyflow/react'
import { type KeyboardEvent, type PointerEvent, type ReactNode, createContext, memo, useContext, useEffect, useRef, useState } from 'react'

import { type Side, sidePoint } from '../diagram/geometry'
import type { Box, Branch, Label } from '../diagram/protocol'
import { words } from '../words'
import { Halo, Shape } from './Shape'

export interface Port {
  side: Side
  branch: Branch
}

export interface ShapeData extends Record<string, unknown> {
  box: Box
  labels: Label[]
  ports: Port[]
  lit: string[] | null
  // The lit row of a component.
  row: string | null
  value: string | null
  fault: { severity: string; message: string } | null
  coverage: { covered: boolean; told: string } | null
  broken: boolean
  editing: boolean
  readOnly: boolean
}

export interface Acts {
  connect: (id: string, port: Port, event: PointerEvent) => void
  commit: (id: string, text: string | null) => void
  cancel: () => void
}

export const ActsContext = createContext<Acts | null>(null)

export type ShapeNodeType = Node<ShapeData, 'shape'>

export const ShapeNode = memo(function ShapeNode({ data, selected, dragging }: NodeProps<ShapeNodeType>): ReactNode {
  const [hover, setHover] = useState(false)
  const acts = useContext(ActsContext)
  const { box, labels, lit, fault, value } = data
  const ports = hover && !dragging && !data.readOnly && !data.editing ? data.ports : []
  const name =
    `box ${box.figure}${lit ? ' lit' : ''}${selected ? ' selected' : ''}` + (fault ? ` at-fault ${fault.severity}` : '') + (data.coverage ? (data.coverage.covered ? ' covered' : ' uncovered') : '')
  return (
    <div className={name} onPointerEnter={() => setHover(true)} onPointerLeave={() => setHover(false)}>
      {(selected || fault || lit) && (
        <svg className="figure halo" width={box.width} height={box.height} aria-hidden="true">
          {lit && <g className="glow"><Halo box={box} by={7} /></g>}
          {fault && <g className="wrong"><Halo box={box} by={selected ? 7 : 4} /></g>}
          {selected && <g className="ring"><Halo box={box} by={4} /></g>}
        </svg>
      )}
      <Shape box={box} labels={labels} row={data.row} />
      {fault && (
        <span className="fault-badge" title={fault.message} aria-label={fault.message}>
          !
        </span>
      )}
      {value !== null && <span className={`value-badge ${value}`}>{value === 'mixed' ? '±' : value === 'true' ? words.canvas.yes : value === 'false' ? words.canvas.no : value}</span>}
      {data.coverage && (
        <span className={`coverage-badge ${data.coverage.covered ? 'covered' : 'open'}`} title={data.coverage.told} aria-hidden="true">
          {data.coverage.covered ? '✓' : '○'}
        </span>
      )}
      {data.broken && <span className="break-badge" title={words.run.breakpoint} />}
      {lit && lit.some((agent) => agent !== '') && (
        <span className="agents">
          {lit.slice(0, 3).map((agent) => (
            <span key={agent} className="agent">
              {agent}
            </span>
          ))}
          {lit.length > 3 && <span className="agent">+{lit.length - 3}</span>}
        </span>
      )}
      {ports.map((port) => {
        const [x, y] = sidePoint({ x: 0, y: 0, width: box.width, height: box.height }, port.side)
        return (
          <span
            key={port.side + (port.branch ?? '')}
            className={`port nodrag nopan ${port.branch ?? ''} ${port.side}`}
            style={{ left: x, top: y }}
            title={words.canvas.port(port.branch)}
            onPointerDown={(event) => acts?.connect(box.id, port, event)}
          >
            {port.branch && <span className="port-name">{words.canvas[port.branch]}</span>}
          </span>
        )
      })}
      {data.editing && <Field box={box} />}
    </div>
  )
})

function Field({ box }: { box: Box }): ReactNode {
  const acts = useContext(ActsContext)
  const field = useRef<HTMLTextAreaElement>(null)
  const done = useRef(false)
  useEffect(() => {
    field.current?.focus()
    field.current?.select()
  }, [])
  const commit = (): void => {
    if (done.current) return
    done.current = true
    const text = field.current?.value.trim() ?? ''
    if (text === box.label || (box.label === '' && text === box.lines.join(' '))) acts?.cancel()
    else acts?.commit(box.id, text === '' ? null : text)
  }
  const key = (event: KeyboardEvent): void => {
    event.stopPropagation()
    if (event.key === 'Enter' && !event.shiftKey) {
      event.preventDefault()
      commit()
    }
    if (event.key === 'Escape') {
      done.current = true
      acts?.cancel()
    }
  }
  return (
    <textarea
      ref={field}
      className="field-in-shape nodrag nopan nowheel"
      aria-label={words.canvas.editText(box.id)}
      defaultValue={box.label || box.lines.join(' ')}
      rows={Math.max(1, box.lines.length)}
      spellCheck={false}
      onKeyDown={key}
      onBlur={commit}
      onPointerDown={(event) => event.stopPropagation()}
    />
  )
}
