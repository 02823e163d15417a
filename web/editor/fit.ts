// Showing all of a drawing: its arrows, too, and beside the bars that lie on the canvas.

import { getViewportForBounds, useReactFlow, useStore, useStoreApi } from '@xyflow/react'
import { useCallback, useEffect, useRef, useState } from 'react'

import { bounds, centre } from '../diagram/geometry'
import type { Drawing } from '../diagram/protocol'
import type { Chart } from './chart'

const ROOM = { left: '68px', right: '36px', top: '28px', bottom: '60px' } as const
const BESIDE = 16
const LARGEST = 1.2
const SMALLEST = 0.1

export function useFit(chart: Chart): (duration?: number) => void {
  const flow = useReactFlow()
  const store = useStoreApi()
  return useCallback(
    (duration = 0) => {
      const drawing = chart.drawing
      const { width, height } = store.getState()
      if (!drawing || width === 0) return
      const corners = drawing.picture.lines.flatMap((line) => line.points.map(([x, y]) => ({ x, y, width: 0, height: 0 })))
      const all = bounds([...drawing.picture.boxes, ...drawing.picture.labels, ...corners])
      if (all) void flow.setViewport(getViewportForBounds(all, width, height, SMALLEST, LARGEST, ROOM), { duration })
    },
    [chart, flow, store],
  )
}

// When another shape is lit, or the canvas gets another size, and no lit shape is in view, the first one is brought there. Who moves
// the canvas away from it is left alone until then.
export function useLitInView(drawing: Drawing, lit: ReadonlyMap<string, unknown>): void {
  const flow = useReactFlow()
  const store = useStoreApi()
  const size = useStore((state) => state.width * 100_000 + state.height)
  const shown = [...lit.keys()].join(' ')
  useEffect(() => {
    const { width, height, transform } = store.getState()
    const [left, top, zoom] = transform
    const middle = (box: Drawing['picture']['boxes'][number]): [number, number] => [box.x + box.width / 2, box.y + box.height / 2]
    const boxes = drawing.picture.boxes.filter((box) => lit.has(box.id) || box.details.some(({ id }) => id !== null && lit.has(id)))
    const inView = boxes.some((box) => {
      const [x, y] = middle(box)
      const [at, down] = [x * zoom + left, y * zoom + top]
      return at > parseInt(ROOM.left) && at < width - parseInt(ROOM.right) && down > parseInt(ROOM.top) && down < height - parseInt(ROOM.bottom)
    })
    const first = boxes[0]
    if (width > 0 && first && !inView) void flow.setCenter(...middle(first), { zoom, duration: 180 })
    // What is lit is told by `shown`; the same is a new map after each step.
  }, [drawing, flow, shown, size, store])
}

// The selected shape does not lie under its own properties: the picture makes way, as far as it must, once the pointer is up.
export function useClear(selected: readonly string[]): void {
  const flow = useReactFlow()
  const store = useStoreApi()
  const id = selected.length === 1 ? selected[0] : undefined
  useEffect(() => {
    if (id === undefined) return
    let timer = 0
    const clear = (): void => {
      const shape = document.querySelector(`.react-flow__node[data-id="${CSS.escape(id)}"]`)?.getBoundingClientRect()
      const pane = store.getState().domNode?.getBoundingClientRect()
      const panel = document.querySelector('.inspector:not(.folded)')?.getBoundingClientRect()
      if (!shape || !pane || !panel) return
      const covered = shape.right > panel.left - BESIDE && shape.left < panel.right + BESIDE && shape.bottom > panel.top - BESIDE && shape.top < panel.bottom
      if (!covered) return
      const { x, y, zoom } = flow.getViewport()
      const up = Math.max(panel.top - BESIDE - shape.bottom, pane.top + BESIDE - shape.top)
      const left = panel.left - BESIDE - shape.right
      const right = panel.right + BESIDE - shape.left
      if (panel.width > pane.width * 0.7) void flow.setViewport({ x, y: y + Math.min(up, 0), zoom }, { duration: 180 })
      else if (panel.left > pane.left + pane.width / 2) void flow.setViewport({ x: x + left, y, zoom }, { duration: 180 })
      else void flow.setViewport({ x: x + right, y, zoom }, { duration: 180 })
    }
    // By then the panel stands where it stays.
    const soon = (): void => void (timer = window.setTimeout(clear, 120))
    const held = store.getState().paneDragging || document.querySelector('.react-flow__node:active') !== null
    if (held) window.addEventListener('pointerup', soon, { once: true })
    else soon()
    return () => {
      clearTimeout(timer)
      window.removeEventListener('pointerup', soon)
    }
  }, [flow, id, store])
}

// Brings a shape into view, if it is not there.
export function useSee(drawing: Drawing): (id: string) => void {
  const flow = useReactFlow()
  const store = useStoreApi()
  return useCallback(
    (id) => {
      const box = drawing.picture.boxes.find((box) => box.id === id)
      const { width, height, transform } = store.getState()
      const [left, top, zoom] = transform
      if (!box || width === 0) return
      const [x, y] = centre(box)
      const [at, down] = [x * zoom + left, y * zoom + top]
      const inside = at > 20 && at < width - 20 && down > 20 && down < height - 20
      if (!inside) void flow.setCenter(x, y, { zoom, duration: 180 })
    },
    [drawing, flow, store],
  )
}

// Brings a shape into view and gives it the focus, as soon as it is drawn.
export function useGoTo(drawing: Drawing, see: (id: string) => void): (id: string) => void {
  const [wanted, setWanted] = useState<string | null>(null)
  useEffect(() => {
    if (wanted === null || !drawing.picture.boxes.some(({ id }) => id === wanted)) return
    see(wanted)
    let frame = 0
    // A new shape is measured before it is there for the eyes.
    const focus = (tries: number): void => {
      const node = document.querySelector<HTMLElement>(`.react-flow__node[data-id="${wanted}"]`)
      node?.focus({ preventScroll: true })
      if (document.activeElement === node || tries === 0) setWanted(null)
      else frame = requestAnimationFrame(() => focus(tries - 1))
    }
    focus(30)
    return () => cancelAnimationFrame(frame)
  }, [drawing, see, wanted])
  return setWanted
}

// Whether some of a drawing lies outside of what is shown: then an overview helps.
export function useBeyond(drawing: Drawing): boolean {
  return useStore(({ transform: [x, y, zoom], width, height }) =>
    drawing.picture.boxes.some(
      (box) =>
        box.x * zoom + x < 0 ||
        box.y * zoom + y < 0 ||
        (box.x + box.width) * zoom + x > width ||
        (box.y + box.height) * zoom + y > height,
    ),
  )
}

// When the canvas gets smaller, a drawing that was seen as a whole stays seen as a whole.
export function useKeptWhole(beyond: boolean, fit: () => void): void {
  const size = useStore((state) => state.width * 100_000 + state.height)
  const last = useRef({ size, beyond })
  useEffect(() => {
    const before = last.current
    last.current = { size, beyond }
    if (before.size !== size && before.size !== 0 && !before.beyond && beyond) fit()
  }, [beyond, fit, size])
}

// What can be read at this distance: everything, the texts of shapes, or outlines alone.
export function useDetail(): 'near' | 'far' | 'farther' {
  return useStore(({ transform: [, , zoom] }) => (zoom < 0.2 ? 'farther' : zoom < 0.3 ? 'far' : 'near'))
}
