// The picture of a state graph: dots and lines, dragged and zoomed; keys go along the steps.
//
// In: a listing and its places. Out: the state that is picked. Lines of one kind are one path, so that many cost little.

import { type KeyboardEvent, type PointerEvent, type ReactNode, useCallback, useEffect, useMemo, useRef, useState } from 'react'

import { DOT, type Key, type ListedState, type Listing, type Places, edgePaths, edgesOf, neighbour } from '../diagram/stategraph'
import { words } from '../words'
import { Icon } from './icons'

interface View {
  x: number
  y: number
  zoom: number
}

const KEYS: Record<string, Key> = { ArrowRight: 'on', ArrowLeft: 'back', ArrowUp: 'above', ArrowDown: 'below', Home: 'first' }
const LEAST = 0.05
const MOST = 4

export function GraphPicture({ all, places, picked, pick, hides }: { all: Listing; places: Places; picked: number | null; pick: (state: number | null) => void; hides: boolean }): ReactNode {
  const host = useRef<HTMLDivElement>(null)
  const [view, setView] = useState<View>({ x: 0, y: 0, zoom: 1 })
  const from = useRef<{ x: number; y: number; view: View; moved: boolean } | null>(null)
  const isOut = useCallback((state: ListedState | undefined): boolean => (state?.holds?.length ?? 0) > 0 && state?.holds?.[0] !== true, [])
  const shows = (state: ListedState | undefined): boolean => !hides || !isOut(state)
  const fit = useCallback((): void => {
    const box = host.current?.getBoundingClientRect()
    if (!box || box.width === 0) return
    const zoom = Math.min(1.6, Math.max(LEAST, Math.min(box.width / places.width, box.height / places.height)))
    setView({ zoom, x: (box.width - places.width * zoom) / 2, y: (box.height - places.height * zoom) / 2 })
  }, [places])
  useEffect(fit, [fit])
  // A wheel that is not passive, so that the page does not scroll.
  useEffect(() => {
    const element = host.current
    if (!element) return
    const wheel = (event: WheelEvent): void => {
      event.preventDefault()
      const box = element.getBoundingClientRect()
      zoomAt(Math.exp(-event.deltaY / 300), event.clientX - box.left, event.clientY - box.top)
    }
    element.addEventListener('wheel', wheel, { passive: false })
    return () => element.removeEventListener('wheel', wheel)
  }, [])
  const zoomAt = (by: number, x: number, y: number): void =>
    setView((view) => {
      const zoom = Math.min(MOST, Math.max(LEAST, view.zoom * by))
      return { zoom, x: x - ((x - view.x) * zoom) / view.zoom, y: y - ((y - view.y) * zoom) / view.zoom }
    })
  const zoomBy = (by: number): void => {
    const box = host.current?.getBoundingClientRect()
    if (box) zoomAt(by, box.width / 2, box.height / 2)
  }
  const edges = useMemo(() => edgesOf(all.states), [all])
  const seen = useMemo(() => edges.filter(([a, b]) => !hides || (!isOut(all.states[a]) && !isOut(all.states[b]))), [edges, hides, all, isOut])
  const lines = useMemo(() => edgePaths(places, seen), [places, seen])
  const own = useMemo(() => edgePaths(places, seen.filter(([a, b]) => a === picked || b === picked)), [places, seen, picked])
  const goTo = (state: number | null): void => {
    pick(state)
    const point = state === null ? undefined : places.points[state]
    const box = host.current?.getBoundingClientRect()
    if (!point || !box) return
    setView((view) => {
      const [x, y] = [view.x + point[0] * view.zoom, view.y + point[1] * view.zoom]
      const inside = x > 20 && y > 20 && x < box.width - 20 && y < box.height - 20
      return inside ? view : { ...view, x: view.x + box.width / 2 - x, y: view.y + box.height / 2 - y }
    })
  }
  const key = (event: KeyboardEvent): void => {
    const wanted = KEYS[event.key]
    if (wanted) goTo(neighbour(all.states, places, picked, wanted))
    else if (event.key === '+' || event.key === '=') zoomBy(1.25)
    else if (event.key === '-') zoomBy(0.8)
    else if (event.key === 'f') fit()
    else if (event.key === 'Escape') pick(null)
    else return
    event.preventDefault()
    event.stopPropagation()
  }
  const down = (event: PointerEvent<HTMLDivElement>): void => {
    if ((event.target as Element).closest('button')) return
    from.current = { x: event.clientX, y: event.clientY, view, moved: false }
    event.currentTarget.setPointerCapture(event.pointerId)
  }
  const move = (event: PointerEvent): void => {
    const begun = from.current
    if (!begun) return
    const [dx, dy] = [event.clientX - begun.x, event.clientY - begun.y]
    if (Math.hypot(dx, dy) > 3) begun.moved = true
    if (begun.moved) setView({ ...begun.view, x: begun.view.x + dx, y: begun.view.y + dy })
  }
  const up = (event: PointerEvent): void => {
    const begun = from.current
    from.current = null
    if (!begun || begun.moved) return
    // The nearest dot under the pointer.
    const box = host.current?.getBoundingClientRect()
    if (!box) return
    const [x, y] = [(event.clientX - box.left - view.x) / view.zoom, (event.clientY - box.top - view.y) / view.zoom]
    let best: [number, number] | null = null
    places.points.forEach((point, state) => {
      const far = Math.hypot(point[0] - x, point[1] - y)
      if (far < Math.max(DOT + 3, 8 / view.zoom) && shows(all.states[state]) && (best === null || far < best[1])) best = [state, far]
    })
    pick(best === null ? null : best[0])
  }
  const near = view.zoom > 0.7
  const state = picked === null ? undefined : all.states[picked]
  return (
    <div
      ref={host}
      className="graph-picture"
      role="application"
      tabIndex={0}
      aria-roledescription={words.graph.title}
      aria-label={words.graph.label(all.states.length)}
      onKeyDown={key}
      onPointerDown={down}
      onPointerMove={move}
      onPointerUp={up}
      onPointerCancel={() => (from.current = null)}
    >
      <svg aria-hidden="true">
        <g transform={`translate(${view.x} ${view.y}) scale(${view.zoom})`}>
          <path className="graph-line" d={lines.lines} />
          {view.zoom > 0.3 && <path className="graph-tip" d={lines.tips} />}
          <path className="graph-line own" d={own.lines} />
          <path className="graph-tip own" d={own.tips} />
          <Dots all={all} places={places} hides={hides} near={near} isOut={isOut} />
          {picked !== null && places.points[picked] && <circle className="graph-picked" cx={places.points[picked][0]} cy={places.points[picked][1]} r={DOT + 4} />}
        </g>
      </svg>
      <p className="unseen" aria-live="polite">
        {state ? words.graph.spoken(state.state, state.values.map(([location, value]) => `${location} ${value}`).join(', ')) : ''}
      </p>
      <div className="graph-zoom row">
        <button className="square" title={words.canvas.zoomOut} aria-label={words.canvas.zoomOut} onClick={() => zoomBy(0.8)}>
          −
        </button>
        <button className="square" title={words.canvas.zoomIn} aria-label={words.canvas.zoomIn} onClick={() => zoomBy(1.25)}>
          +
        </button>
        <button className="square" title={words.graph.fit} aria-label={words.graph.fit} onClick={fit}>
          <Icon name="fit" size={14} />
        </button>
      </div>
    </div>
  )
}

// They are drawn anew only if they are others, not as the view moves.
function Dots({ all, places, hides, near, isOut }: { all: Listing; places: Places; hides: boolean; near: boolean; isOut: (state: ListedState | undefined) => boolean }): ReactNode {
  return useMemo(
    () =>
      all.states.map((state) => {
        const [x, y] = places.points[state.state] ?? [0, 0]
        if (hides && isOut(state)) return null
        const faults = state.steps.some((step) => step.to === null)
        const tone = (state.violated ?? []).length > 0 || faults ? ' bad' : ''
        return (
          <g key={state.state} data-state={state.state} className={`graph-dot${tone}${state.whole ? '' : ' open'}${isOut(state) ? ' out' : ''}`}>
            {state.initial && <circle className="graph-initial" cx={x} cy={y} r={DOT + 3} />}
            <circle cx={x} cy={y} r={DOT} />
            {near && (
              <text x={x} y={y + 3}>
                {state.state}
              </text>
            )}
          </g>
        )
      }),
    [all, places, hides, near, isOut],
  )
}
