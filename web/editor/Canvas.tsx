// The canvas: a drawing that can be looked at, edited, and that shows a run.
//
// Owns: what the pointer and the keys do there. In: a chart and what runs. Out: operations and selections. INVARIANT: what it shows
// ahead of the text (shapes in the hand) lasts until the next picture, which is the server's.

import { MiniMap, type Node, type NodeChange, PanOnScrollMode, ReactFlow, ReactFlowProvider, SelectionMode, ViewportPortal, useReactFlow } from '@xyflow/react'
import { type KeyboardEvent, type PointerEvent, type ReactNode, useCallback, useEffect, useMemo, useRef, useState } from 'react'

import { GRID, snappedCorner } from '../diagram/arrange'
import { type Point, arrowPath, border } from '../diagram/geometry'
import { move, moveInto } from '../diagram/gestures'
import type { Fault } from '../diagram/pick'
import { NOTHING } from '../diagram/pick'
import type { Drawing, Line, Shape as ShapeKind } from '../diagram/protocol'
import { words } from '../words'
import { CanvasBar } from './CanvasBar'
import { useBeyond, useClear, useDetail, useFit, useGoTo, useKeptWhole, useLitInView, useSee } from './fit'
import type { Chart } from './chart'
import { type Dropped, useConnecting } from './connect'
import { Icon } from './icons'
import { canvasKey } from './keys'
import { Holds, Lines } from './Lines'
import { useLinking } from './linking'
import { Menu } from './Menu'
import { useNodes } from './nodes'
import { Palette, useTool } from './Palette'
import { Halo } from './Shape'
import { type Acts, ActsContext, ShapeNode, type ShapeNodeType } from './ShapeNode'
import { useShownRun } from './shown'
import { useStore } from './store'
import type { Studio } from './studio'

const NODE_TYPES = { shape: ShapeNode }
// With one of these, a click adds to what is selected.
const ADD_KEYS = ['Control', 'Meta', 'Shift']
const SNAP: [number, number] = [GRID, GRID]
const miniClass = (node: Node): string => `mini ${(node as ShapeNodeType).data.box.figure}`
const NO_FAULTS: Fault[] = []
const NO_OFFSETS: ReadonlyMap<string, Point> = new Map()

// Where each drawing was looked at last.
const viewports = new Map<string, { x: number; y: number; zoom: number }>()

interface Moving {
  drawing: Drawing
  refusals: number
  offsets: ReadonlyMap<string, Point>
}

export function Canvas({ studio, chart }: { studio: Studio; chart: Chart }): ReactNode {
  const drawing = useStore(chart.store, () => chart.drawing)
  if (!drawing) return <Nothing studio={studio} chart={chart} />
  return (
    <ReactFlowProvider>
      <Shown studio={studio} chart={chart} drawing={drawing} />
    </ReactFlowProvider>
  )
}

function Nothing({ studio, chart }: { studio: Studio; chart: Chart }): ReactNode {
  const { pictures, stale } = useStore(chart.store, (state) => state)
  if (!pictures && !stale) return <div className="canvas empty" aria-busy="true" />
  return (
    <div className="canvas empty">
      <div className="empty-card">
        <Icon name="chart" size={28} />
        <h2>{stale ? words.canvas.broken : words.canvas.empty}</h2>
        <p>{stale ? words.canvas.brokenHint : words.canvas.emptyHint}</p>
        {!stale && !chart.doc.readOnly && (
          <button className="primary" onClick={() => studio.store.set({ dialog: { kind: 'machine', uri: chart.doc.file.uri } })}>
            <Icon name="plus" />
            {words.canvas.newMachine}
          </button>
        )}
      </div>
    </div>
  )
}

function Shown({ studio, chart, drawing }: { studio: Studio; chart: Chart; drawing: Drawing }): ReactNode {
  const flow = useReactFlow()
  const uri = chart.doc.file.uri
  const place = `${uri}#${drawing.name}`
  const readOnly = chart.doc.readOnly
  const selection = useStore(chart.store, (state) => state.selection)
  const revealed = useStore(chart.store, (state) => state.revealed)
  const refusals = useStore(chart.store, (state) => state.refusals)
  const stale = useStore(chart.store, (state) => state.stale)
  const guess = useStore(chart.store, (state) => state.pictures?.guess === true)
  const faults = useStore(studio.store, (state) => state.faults.get(uri) ?? NO_FAULTS)
  const run = useShownRun(studio, drawing, uri)
  const [moving, setMoving] = useState<Moving | null>(null)
  const [editing, setEditing] = useState<string | null>(null)
  const [drop, setDrop] = useState<Dropped | null>(null)
  const [context, setContext] = useState<{ x: number; y: number } | null>(null)
  const canvas = useRef<HTMLDivElement>(null)
  const free = useRef(false)
  const pointer = useRef<Point | null>(null)

  const offsets = moving && moving.drawing === drawing && moving.refusals === refusals ? moving.offsets : NO_OFFSETS
  const selected = useMemo(() => new Set(selection.boxes), [selection.boxes])
  const nodes = useNodes({
    drawing,
    offsets,
    selected,
    lit: run.lit,
    values: run.values,
    faults,
    breaks: run.breaks,
    covered: run.covered,
    editing,
    readOnly,
  })

  const toFlow = useCallback((at: { x: number; y: number }) => flow.screenToFlowPosition(at, { snapToGrid: false }), [flow])
  const fit = useFit(chart)
  const beyond = useBeyond(drawing)
  useKeptWhole(beyond, fit)
  useLitInView(drawing, run.lit)
  useClear(selection.boxes)
  const detail = useDetail()
  const connecting = useConnecting(studio, chart, toFlow, setDrop)
  const { begin, grip } = connecting
  const tool = useTool(studio, chart, drawing, toFlow)
  const see = useSee(drawing)
  const linking = useLinking(studio, chart, drawing, see)
  const drawn = connecting.drawn ?? linking.drawn
  const goTo = useGoTo(drawing, see)

  const acts = useMemo<Acts>(
    () => ({
      connect: (id, port, event) => {
        // As a shape does that is clicked: keys are meant for the picture from now on.
        canvas.current?.focus({ preventScroll: true })
        begin(id, port, event)
      },
      commit: (id, text) => {
        setEditing(null)
        void chart.operate({ kind: 'text', id, text }, { select: false })
        canvas.current?.focus()
      },
      cancel: () => {
        setEditing(null)
        canvas.current?.focus()
      },
    }),
    [begin, chart],
  )

  // Each drawing is looked at where it was; the first time, all of it.
  useEffect(() => {
    const known = viewports.get(place)
    if (known) void flow.setViewport(known)
    else requestAnimationFrame(() => fit())
    setEditing(null)
    // Another picture of the same drawing is looked at as before.
  }, [place, fit])

  // What was selected in the text is brought into view.
  useEffect(() => {
    const id = selection.boxes[0] ?? (selection.lines[0] !== undefined ? drawing.picture.boxes[drawing.picture.lines[selection.lines[0]]?.from ?? -1]?.id : undefined)
    if (revealed > 0 && id !== undefined) see(id)
    // Only a new place in the text moves the canvas.
  }, [revealed])

  useEffect(() => {
    const alt = (event: globalThis.KeyboardEvent): void => void (free.current = event.altKey)
    window.addEventListener('keydown', alt)
    window.addEventListener('keyup', alt)
    return () => {
      window.removeEventListener('keydown', alt)
      window.removeEventListener('keyup', alt)
    }
  }, [])

  const changed = useCallback(
    (changes: NodeChange<ShapeNodeType>[]) => {
      const picks = changes.filter((change) => change.type === 'select')
      if (picks.length > 0) {
        const boxes = new Set(chart.store.get().selection.boxes)
        for (const { id, selected } of picks) selected ? boxes.add(id) : boxes.delete(id)
        const lines = boxes.size > 0 ? [] : chart.store.get().selection.lines
        chart.select({ boxes: [...boxes], lines: picks.some(({ selected }) => selected) ? [] : lines })
      }
      const moves = changes.filter((change) => change.type === 'position' && change.position)
      const first = moves[0]
      if (!first || first.type !== 'position' || !first.position) return
      const box = drawing.picture.boxes.find((box) => box.id === first.id)
      if (!box) return
      const corner: Point = free.current
        ? [Math.round(first.position.x), Math.round(first.position.y)]
        : snappedCorner({ ...box, x: first.position.x, y: first.position.y })
      const by: Point = [corner[0] - box.x, corner[1] - box.y]
      setMoving((old) => {
        const known = old && old.drawing === drawing && old.refusals === refusals ? old.offsets : NO_OFFSETS
        const next = new Map(known)
        for (const change of moves) if (change.type === 'position') next.set(change.id, by)
        return { drawing, refusals, offsets: next }
      })
    },
    [chart, drawing, refusals],
  )

  const commit = useCallback(
    (by: ReadonlyMap<string, Point>, dropped?: { ctrlKey: boolean; metaKey: boolean }) => {
      const operation = dropped ? moveInto(drawing, by, dropped.ctrlKey || dropped.metaKey) : move(drawing, by)
      if (operation) void chart.operate(operation)
      else setMoving(null)
    },
    [chart, drawing],
  )

  // Arrow keys move at once; the text follows when they rest.
  const nudging = useRef<ReturnType<typeof setTimeout> | undefined>(undefined)
  const nudge = useCallback(
    (dx: number, dy: number) => {
      const next = new Map(offsets)
      for (const id of selection.boxes) {
        const [x, y] = next.get(id) ?? [0, 0]
        next.set(id, [x + dx, y + dy])
      }
      setMoving({ drawing, refusals, offsets: next })
      clearTimeout(nudging.current)
      nudging.current = setTimeout(() => commit(next), 350)
    },
    [commit, drawing, offsets, refusals, selection.boxes],
  )

  const open = useCallback(
    (id: string) => {
      const box = drawing.picture.boxes.find((box) => box.id === id)
      if (!box) return
      if (box.opens) void studio.enter(box.opens.uri, box.opens.name)
      else if (!readOnly && box.figure !== 'enter' && box.figure !== 'exit') setEditing(id)
    },
    [drawing, readOnly, studio],
  )

  const pickLine = useCallback(
    (index: number, event: PointerEvent) => {
      if (event.button !== 0) return
      event.stopPropagation()
      canvas.current?.focus({ preventScroll: true })
      const { selection } = chart.store.get()
      chart.select({ boxes: [], lines: event.shiftKey ? [...new Set([...selection.lines, index])] : [index] })
    },
    [chart],
  )

  const lineName = useCallback(
    (line: Line) => {
      const said = (index: number): string => saidOf(drawing, drawing.picture.boxes[index]?.id)
      return words.canvas.arrow(said(line.from), line.branch, said(line.to))
    },
    [drawing],
  )

  const keys = (event: KeyboardEvent): void => {
    if ((event.target as HTMLElement).closest('textarea, input, .cm-editor')) return
    canvasKey(event, { studio, chart, drawing, tool, linking, goTo, nudge, edit: (id) => setEditing(id), open, fit: () => fit(180), at: pointer.current, zoom: (by) => void (by > 0 ? flow.zoomIn({ duration: 120 }) : flow.zoomOut({ duration: 120 })) })
  }

  return (
    <ActsContext value={acts}>
      <div
        ref={canvas}
        className={`canvas ${detail}${tool.shape ? ' placing' : ''}${drawn ? ' connecting' : ''}${stale ? ' stale' : ''}`}
        tabIndex={-1}
        onKeyDown={keys}
        onPointerMove={(event) => {
          const { x, y } = toFlow({ x: event.clientX, y: event.clientY })
          pointer.current = [x, y]
        }}
        onPointerLeave={() => (pointer.current = null)}
        onPointerDown={(event) => {
          linking.leave()
          if (!(event.target as HTMLElement).closest('button, textarea, input, .react-flow__node')) canvas.current?.focus({ preventScroll: true })
        }}
      >
        <ReactFlow
          nodes={nodes}
          nodeTypes={NODE_TYPES}
          onNodesChange={changed}
          onNodeDragStop={(event) => commit(offsets, event)}
          onSelectionDragStop={(event) => commit(offsets, event)}
          onNodeDoubleClick={(_, node) => open(node.id)}
          onNodeContextMenu={(event, node) => {
            event.preventDefault()
            if (!selected.has(node.id)) chart.select({ boxes: [node.id], lines: [] })
            setContext({ x: event.clientX, y: event.clientY })
          }}
          onPaneClick={(event) => {
            if (tool.shape) tool.place({ x: event.clientX, y: event.clientY })
            else chart.select(NOTHING)
          }}
          onMoveEnd={(_, viewport) => viewports.set(place, viewport)}
          nodesConnectable={false}
          nodesDraggable={!tool.shape}
          elementsSelectable={!tool.shape}
          disableKeyboardA11y
          snapToGrid={false}
          snapGrid={SNAP}
          deleteKeyCode={null}
          multiSelectionKeyCode={ADD_KEYS}
          selectionKeyCode={null}
          selectionOnDrag={!tool.shape}
          selectionMode={SelectionMode.Partial}
          panOnDrag={[1, 2]}
          panOnScroll
          panOnScrollMode={PanOnScrollMode.Free}
          zoomOnDoubleClick={false}
          nodeDragThreshold={3}
          elevateNodesOnSelect={false}
          minZoom={0.1}
          maxZoom={3}
          proOptions={{ hideAttribution: true }}
          aria-label={words.canvas.label(drawing.title || drawing.name)}
        >
          <ViewportPortal>
            <Lines
              drawing={drawing}
              offsets={offsets}
              selected={selection.lines}
              lit={run.lines}
              held={drawn?.line ?? null}
              name={lineName}
              onPick={pickLine}
            />
            {!readOnly && <Holds drawing={drawing} selected={selection.lines} onGrip={grip} />}
            {drawn && <Loose drawn={drawn} />}
          </ViewportPortal>
          {tool.ghost}
          {beyond && <MiniMap className="minimap" pannable zoomable ariaLabel={words.canvas.minimap} nodeClassName={miniClass} nodeBorderRadius={4} offsetScale={8} />}
        </ReactFlow>
        {!readOnly && <Palette tool={tool} drawing={drawing} />}
        <CanvasBar studio={studio} chart={chart} drawing={drawing} />
        <div className={`stale-note${stale ? '' : ' guess'}`} role="status">
          {(stale || guess) && (
            <>
              <Icon name="warning" size={14} />
              {stale ? words.canvas.stale : words.canvas.guess}
            </>
          )}
        </div>
        <p className="hand-note" role="status">
          {linking.note ?? (tool.shape && words.palette.inHand(words.shapes[tool.shape], selection.boxes.length === 1 ? saidOf(drawing, selection.boxes[0]) : null))}
        </p>
        {drop && (
          <Menu
            at={drop.screen}
            label={words.canvas.grow}
            close={() => setDrop(null)}
            items={growItems(drawing, (shape, of) => {
              const at: [number, number] = [Math.round(drop.at[0] / GRID) * GRID, Math.round(drop.at[1] / GRID) * GRID]
              void chart.grow({ kind: 'add', shape, at, ...(of === undefined ? {} : { of }) }, (to) => ({ ...drop.arrow, to }))
            }, (to) => void chart.operate({ kind: 'connect', ...drop.arrow, to }, { select: false }), tool.patterns)}
          />
        )}
        {context && <Menu at={context} label={words.canvas.context} close={() => setContext(null)} items={tool.contextItems(() => setEditing(selection.boxes[0] ?? null), open)} />}
      </div>
    </ActsContext>
  )
}

const saidOf = (drawing: Drawing, id: string | undefined): string => drawing.picture.boxes.find((box) => box.id === id)?.lines.join(' ') || (id ?? '')

function growItems(drawing: Drawing, add: (shape: ShapeKind, of?: string) => void, exit: (to: string) => void, patterns: string[]) {
  if (drawing.kind === 'system') return [{ name: words.shapes.component, icon: <Icon name="component" />, act: () => add('component') }]
  return [
    { name: words.shapes.state, icon: <Icon name="state" />, key: 'S', act: () => add('state') },
    { name: words.shapes.guard, icon: <Icon name="guard" />, key: 'G', act: () => add('guard') },
    { name: words.shapes.action, icon: <Icon name="action" />, key: 'A', act: () => add('action') },
    ...patterns.slice(0, 6).map((of) => ({ name: words.palette.instanceOf(of), icon: <Icon name="instance" />, act: () => add('instance', of) })),
    ...(drawing.kind === 'pattern'
      ? [null, ...(['exit', 'exit yes', 'exit no'] as const).map((to) => ({ name: `${words.shapes.exit}${to.slice(4)}`, icon: <Icon name="flag" />, act: () => exit(to) }))]
      : []),
  ]
}

// The arrow that is being drawn.
function Loose({ drawn }: { drawn: NonNullable<ReturnType<typeof useConnecting>['drawn']> }): ReactNode {
  const over = drawn.allowed && drawn.over ? drawn.over : null
  const end: Point = over ? border(over.figure, over, drawn.fast) : drawn.loose
  const { line, tip } = arrowPath(drawn.tip ? [drawn.fast, end] : [end, drawn.fast])
  return (
    <svg className={`lines loose${drawn.allowed ? '' : ' forbidden'}`} width="1" height="1">
      <path className="stroke" d={line} />
      <path className="tip" d={tip} />
      {drawn.over && (
        <g className="target" transform={`translate(${drawn.over.x} ${drawn.over.y})`}>
          <Halo box={drawn.over} by={5} />
        </g>
      )}
    </svg>
  )
}
