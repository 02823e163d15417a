// The small bars on the canvas: zoom and layout at the lower left; alignment when several shapes are selected.

import { useReactFlow, useStore as useFlowStore } from '@xyflow/react'
import { type ReactNode } from 'react'

import { type Edge, type Moves, align, distribute } from '../diagram/arrange'
import { move } from '../diagram/gestures'
import type { Drawing } from '../diagram/protocol'
import { words } from '../words'
import type { Chart } from './chart'
import { useFit } from './fit'
import { Icon } from './icons'
import { useStore } from './store'
import type { Studio } from './studio'

export function CanvasBar({ chart, drawing }: { studio: Studio; chart: Chart; drawing: Drawing }): ReactNode {
  const flow = useReactFlow()
  const fit = useFit(chart)
  const zoom = useFlowStore((state) => Math.round(state.transform[2] * 100))
  const boxes = useStore(chart.store, (state) => state.selection.boxes)
  const undos = useStore(chart.doc.store, (state) => state.undos)
  const redos = useStore(chart.doc.store, (state) => state.redos)
  const readOnly = chart.doc.readOnly
  const several = !readOnly && boxes.length > 1
  return (
    <>
      <div className="canvas-bar" role="toolbar" aria-label={words.canvas.view}>
        <button title={words.canvas.zoomOut} aria-label={words.canvas.zoomOut} onClick={() => void flow.zoomOut({ duration: 120 })}>
          −
        </button>
        <button className="zoom" title={words.canvas.zoomReset} onClick={() => void flow.zoomTo(1, { duration: 120 })}>
          {zoom} %
        </button>
        <button title={words.canvas.zoomIn} aria-label={words.canvas.zoomIn} onClick={() => void flow.zoomIn({ duration: 120 })}>
          +
        </button>
        <button title={words.canvas.fit} aria-label={words.canvas.fit} onClick={() => fit(180)}>
          <Icon name="fit" />
        </button>
        {!readOnly && (
          <>
            <span className="divider" />
            <button title={words.canvas.undo} aria-label={words.canvas.undo} disabled={undos === 0} onClick={() => chart.doc.undo()}>
              <Icon name="undo" />
            </button>
            <button title={words.canvas.redo} aria-label={words.canvas.redo} disabled={redos === 0} onClick={() => chart.doc.redo()}>
              <Icon name="redo" />
            </button>
            <button
              title={words.canvas.layout}
              aria-label={words.canvas.layout}
              onClick={() =>
                void chart.operate({ kind: 'layout' }, { select: false }).then(() => {
                  setTimeout(() => fit(180), 150)
                })
              }
            >
              <Icon name="layout" />
            </button>
          </>
        )}
      </div>
      {several && <Arrange chart={chart} drawing={drawing} ids={boxes} />}
    </>
  )
}

const EDGES: Edge[] = ['left', 'centre', 'right', 'top', 'middle', 'bottom']

function Arrange({ chart, drawing, ids }: { chart: Chart; drawing: Drawing; ids: string[] }): ReactNode {
  const rects = () => new Map(drawing.picture.boxes.filter((box) => ids.includes(box.id) && box.figure !== 'exit' && box.figure !== 'composite').map((box) => [box.id, box]))
  const go = (moves: Moves): void => {
    const operation = move(drawing, moves)
    if (operation) void chart.operate(operation)
  }
  return (
    <div className="arrange" role="toolbar" aria-label={words.canvas.arrange}>
      {EDGES.map((edge) => (
        <button key={edge} title={words.align[edge]} aria-label={words.align[edge]} onClick={() => go(align(rects(), edge))}>
          <Icon name={edge} />
        </button>
      ))}
      {ids.length > 2 && (
        <>
          <span className="divider" />
          <button title={words.align.across} aria-label={words.align.across} onClick={() => go(distribute(rects(), 'x'))}>
            <Icon name="across" />
          </button>
          <button title={words.align.down} aria-label={words.align.down} onClick={() => go(distribute(rects(), 'y'))}>
            <Icon name="down" />
          </button>
        </>
      )}
    </div>
  )
}
