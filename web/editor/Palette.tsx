// The palette of shapes: click one and then a place, or drag it there, or press its key.
//
// Owns: which shape is in the hand, its ghost under the pointer, and what patterns an instance can be of.

import { ViewportPortal } from '@xyflow/react'
import { type PointerEvent as ReactPointerEvent, type ReactNode, useEffect, useMemo, useRef, useState } from 'react'

import { GRID, snapped } from '../diagram/arrange'
import { toolsFor } from '../diagram/gestures'
import { arrowBehind, mayBegin, roomBehind } from '../diagram/behind'
import type { Box, Drawing, Figure, Operation, Shape as ShapeKind } from '../diagram/protocol'
import { words } from '../words'
import type { Chart } from './chart'
import { Icon } from './icons'
import { copy, deleteSelected, duplicate, paste } from './keys'
import { type Item, Menu } from './Menu'
import { Shape } from './Shape'
import { breakTerm } from './shown'
import { useStore } from './store'
import type { Studio } from './studio'

export interface Tool {
  shape: ShapeKind | null
  patterns: string[]
  ghost: ReactNode
  arm: (shape: ShapeKind | null) => void
  take: (shape: ShapeKind, event: ReactPointerEvent) => void
  place: (at: { x: number; y: number }) => void
  // Places it behind a shape, joined by an arrow; without one, where there is room.
  placeBehind: (from: Box | null) => Promise<string | null>
  contextItems: (edit: () => void, open: (id: string) => void) => (Item | null)[]
}

const FIGURES: Record<ShapeKind, [Figure, number, number]> = {
  state: ['circle', 68, 68],
  composite: ['composite', 130, 110],
  guard: ['hexagon', 120, 44],
  action: ['rectangle', 110, 40],
  instance: ['block', 130, 48],
  component: ['component', 150, 64],
  channel: ['channel', 120, 36],
  sensor: ['device', 96, 40],
  actuator: ['device', 96, 40],
}

function ghostBox(shape: ShapeKind): Box {
  const [figure, width, height] = FIGURES[shape]
  return {
    id: shape,
    figure,
    dashed: false,
    initial: false,
    lines: [words.shapes[shape]],
    details: [],
    x: 0,
    y: 0,
    width,
    height,
    label: '',
    link: null,
    refine: null,
    of: null,
    opens: null,
    range: null,
    nameRange: null,
  }
}

export function useTool(
  studio: Studio,
  chart: Chart,
  drawing: Drawing,
  toFlow: (at: { x: number; y: number }) => { x: number; y: number },
): Tool {
  const [shape, setShape] = useState<ShapeKind | null>(null)
  const [at, setAt] = useState<{ x: number; y: number } | null>(null)
  const [asking, setAsking] = useState<{ screen: { x: number; y: number }; choose: (of: string) => void } | null>(null)
  const pictures = useStore(chart.store, (state) => state.pictures)
  const pressed = useRef<{ x: number; y: number } | null>(null)

  const patterns = useMemo(() => {
    const own = (pictures?.drawings ?? []).filter((other) => other.kind === 'pattern' && other.name !== drawing.name).map((other) => other.name)
    const used = (pictures?.drawings ?? []).flatMap((other) => other.picture.boxes.flatMap((box) => (box.of === null ? [] : [box.of])))
    return [...new Set([...own, ...used])].filter((name) => name !== drawing.name)
  }, [drawing, pictures])

  useEffect(() => setShape(null), [drawing.name])

  const add = (shape: ShapeKind, place: [number, number], of?: string): void => {
    void chart.operate({ kind: 'add', shape, at: place, ...(of === undefined ? {} : { of }) })
  }

  // Of which pattern an instance is to be; null if there is none.
  const which = (screen: { x: number; y: number }): Promise<string | null> => {
    const [only] = patterns
    if (only === undefined) studio.tell(words.palette.noPattern, 'refused')
    if (only === undefined || patterns.length === 1) return Promise.resolve(only ?? null)
    return new Promise((choose) => setAsking({ screen, choose }))
  }

  const place = (screen: { x: number; y: number }): void => {
    if (!shape) return
    const { x, y } = toFlow(screen)
    const where: [number, number] = [snapped(x, GRID), snapped(y, GRID)]
    setShape(null)
    setAt(null)
    if (shape !== 'instance') return add(shape, where)
    void which(screen).then((of) => of !== null && add('instance', where, of))
  }

  const placeBehind = async (from: Box | null): Promise<string | null> => {
    if (!shape) return null
    setShape(null)
    setAt(null)
    const rect = document.querySelector('.canvas')?.getBoundingClientRect()
    const of = shape === 'instance' ? await which({ x: (rect?.left ?? 0) + 80, y: (rect?.top ?? 0) + 80 }) : undefined
    if (of === null) return null
    const [, width, height] = FIGURES[shape]
    const [x, y] = roomBehind(drawing, from, [width, height])
    const operation: Operation = { kind: 'add', shape, at: [x, y], ...(of === undefined ? {} : { of }) }
    if (from && mayBegin(from)) return chart.grow(operation, (id) => arrowBehind(drawing, from, shape, id))
    return (await chart.operate(operation))?.[0] ?? null
  }

  // The ghost follows the pointer; letting go over the canvas after a drag places the shape.
  const placing = useRef(place)
  placing.current = place
  useEffect(() => {
    if (!shape) return
    const follow = (event: PointerEvent): void => setAt(toFlow({ x: event.clientX, y: event.clientY }))
    const up = (event: PointerEvent): void => {
      const from = pressed.current
      pressed.current = null
      if (!from || Math.hypot(event.clientX - from.x, event.clientY - from.y) < 8) return
      const over = document.elementFromPoint(event.clientX, event.clientY)
      if (over?.closest('.canvas') && !over.closest('.palette')) placing.current({ x: event.clientX, y: event.clientY })
      else setShape(null)
    }
    window.addEventListener('pointermove', follow)
    window.addEventListener('pointerup', up)
    return () => {
      window.removeEventListener('pointermove', follow)
      window.removeEventListener('pointerup', up)
    }
  }, [shape, toFlow])

  const box = shape && ghostBox(shape)
  const ghost = (
    <>
      {box && at && (
        <ViewportPortal>
          <div className="ghost" style={{ transform: `translate(${snapped(at.x) - box.width / 2}px, ${snapped(at.y) - box.height / 2}px)` }}>
            <Shape box={box} labels={[]} />
          </div>
        </ViewportPortal>
      )}
      {asking && (
        <Menu
          at={asking.screen}
          label={words.palette.which}
          close={() => setAsking(null)}
          items={patterns.map((name) => ({ name, icon: <Icon name="instance" />, act: () => asking.choose(name) }))}
        />
      )}
    </>
  )

  const contextItems = (edit: () => void, open: (id: string) => void): (Item | null)[] => {
    const { selection } = chart.store.get()
    const id = selection.boxes.length === 1 ? selection.boxes[0] : undefined
    const box = drawing.picture.boxes.find((box) => box.id === id)
    const term = id === undefined ? null : breakTerm(drawing, id)
    const items: (Item | null)[] = []
    if (box?.opens) items.push({ name: words.canvas.open, icon: <Icon name="chevron" />, act: () => open(box.id) })
    if (box?.range) {
      const { range } = box
      items.push({ name: words.canvas.showText, icon: <Icon name="text" />, act: () => void studio.open(chart.doc.file.uri, { range }) })
    }
    if (term !== null) items.push({ name: words.run.breakpoint, icon: <Icon name="record" />, act: () => studio.runner.toggleBreak(term) })
    if (chart.doc.readOnly) return [...items, { name: words.canvas.copy, key: 'Ctrl C', act: () => void copy(studio, chart) }]
    if (box) items.push({ name: words.canvas.edit, key: 'Enter', act: edit })
    if (box?.figure === 'circle' && !box.initial)
      items.push({ name: words.inspector.makeInitial, act: () => void chart.operate({ kind: 'initial', id: box.id }, { select: false }) })
    items.push(
      null,
      { name: words.canvas.copy, key: 'Ctrl C', act: () => void copy(studio, chart) },
      { name: words.canvas.paste, key: 'Ctrl V', act: () => void paste(studio, chart, null) },
      { name: words.canvas.duplicate, key: 'Ctrl D', act: () => duplicate(chart) },
      null,
      { name: words.canvas.delete, key: 'Del', danger: true, icon: <Icon name="trash" />, act: () => deleteSelected(chart) },
    )
    return items
  }

  return {
    shape,
    patterns,
    ghost,
    arm: (next) => {
      setShape(next)
      setAt(null)
    },
    take: (next, event) => {
      pressed.current = { x: event.clientX, y: event.clientY }
      setShape(next)
      setAt(null)
    },
    place,
    placeBehind,
    contextItems,
  }
}

export function Palette({ tool, drawing }: { tool: Tool; drawing: Drawing }): ReactNode {
  return (
    <div className="palette" role="toolbar" aria-label={words.palette.label}>
      <button
        className={tool.shape === null ? 'on' : undefined}
        aria-pressed={tool.shape === null}
        title={words.palette.select}
        aria-label={words.palette.select}
        onClick={() => tool.arm(null)}
      >
        <Icon name="cursor" size={18} />
      </button>
      <span className="divider" />
      {toolsFor(drawing.kind).map(({ shape, key }) => (
        <button
          key={shape}
          className={`tool-${shape}${tool.shape === shape ? ' on' : ''}`}
          aria-pressed={tool.shape === shape}
          title={words.palette.place(words.shapes[shape], key.toUpperCase())}
          aria-label={words.shapes[shape]}
          onPointerDown={(event) => event.button === 0 && tool.take(shape, event)}
          onClick={(event) => {
            if (event.detail !== 0) return
            tool.arm(shape)
            // By the keyboard: what comes next is meant for the picture.
            event.currentTarget.closest<HTMLElement>('.canvas')?.focus()
          }}
        >
          <Icon name={shape} size={20} />
          <kbd>{key.toUpperCase()}</kbd>
        </button>
      ))}
    </div>
  )
}
