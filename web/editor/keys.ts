// What keys do on the canvas.
//
// In: a key and what is there. Out: operations. The keys of the whole studio (search, panels) are `app/shortcuts.ts`.

import type { KeyboardEvent } from 'react'

import { GRID } from '../diagram/arrange'
import { copied, pasted } from '../diagram/clipboard'
import type { Point } from '../diagram/geometry'
import { remove, toolsFor } from '../diagram/gestures'
import { NOTHING } from '../diagram/pick'
import type { Drawing } from '../diagram/protocol'
import { words } from '../words'
import type { Chart } from './chart'
import type { Tool } from './Palette'
import type { Linking } from './linking'
import type { Studio } from './studio'

export interface CanvasActs {
  studio: Studio
  chart: Chart
  drawing: Drawing
  tool: Tool
  linking: Linking
  // Brings a new shape into view, and the keys to it.
  goTo: (id: string) => void
  nudge: (dx: number, dy: number) => void
  edit: (id: string) => void
  open: (id: string) => void
  fit: () => void
  zoom: (by: number) => void
  at: Point | null
}

const STEPS: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }

export async function copy(studio: Studio, chart: Chart): Promise<boolean> {
  const drawing = chart.drawing
  const text = drawing && copied(drawing, chart.store.get().selection.boxes)
  if (!text) return false
  try {
    await navigator.clipboard.writeText(text)
    return true
  } catch {
    // Without the system's clipboard, shapes can still be pasted in this window.
    inner = text
    studio.tell(words.canvas.noClipboard)
    return true
  }
}

let inner: string | null = null

export async function paste(studio: Studio, chart: Chart, at: Point | null): Promise<void> {
  let text = inner
  try {
    text = await navigator.clipboard.readText()
  } catch {
    // As above.
  }
  const operation = text === null ? null : pasted(text, at, chart.drawing)
  if (operation) await chart.operate(operation)
  else studio.tell(words.canvas.nothingToPaste, 'refused')
}

export function deleteSelected(chart: Chart): void {
  const drawing = chart.drawing
  if (!drawing || chart.doc.readOnly) return
  void chart.operateAll(remove(drawing, chart.store.get().selection))
}

export function duplicate(chart: Chart): void {
  const drawing = chart.drawing
  const text = drawing && copied(drawing, chart.store.get().selection.boxes)
  const operation = text ? pasted(text, null, drawing) : null
  if (operation && !chart.doc.readOnly) void chart.operate(operation)
}

export function selectAll(chart: Chart): void {
  const drawing = chart.drawing
  if (drawing) chart.select({ boxes: drawing.picture.boxes.map((box) => box.id), lines: [] })
}

export function canvasKey(event: KeyboardEvent, acts: CanvasActs): void {
  const { studio, chart, drawing, tool, linking } = acts
  const { selection } = chart.store.get()
  const readOnly = chart.doc.readOnly
  const done = (): void => {
    event.preventDefault()
    event.stopPropagation()
  }
  // A shape that has the focus but is not selected is the one that is meant.
  const focused = (event.target as HTMLElement).closest<HTMLElement>('.react-flow__node')?.dataset['id']
  const one = selection.boxes.length === 1 ? selection.boxes[0] : focused
  const control = event.ctrlKey || event.metaKey
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key

  if (!control && !event.altKey && linking.key(event)) return done()
  if (control && !event.altKey) {
    switch (key) {
      case 'a':
        done()
        return selectAll(chart)
      case 'c':
        done()
        return void copy(studio, chart)
      case 'x':
        done()
        return void copy(studio, chart).then((done) => done && deleteSelected(chart))
      case 'v':
        done()
        return readOnly ? undefined : void paste(studio, chart, acts.at)
      case 'd':
        done()
        return duplicate(chart)
    }
    return
  }
  if (event.altKey && !(key in STEPS)) return
  const step = STEPS[key]
  if (step && !readOnly && selection.boxes.length > 0) {
    done()
    const by = event.altKey ? 1 : event.shiftKey ? 5 * GRID : GRID
    return acts.nudge(step[0] * by, step[1] * by)
  }
  switch (key) {
    case 'Delete':
    case 'Backspace':
      done()
      return deleteSelected(chart)
    case 'Escape':
      done()
      if (tool.shape) return tool.arm(null)
      return chart.select(NOTHING)
    case 'Enter':
      if ((event.target as HTMLElement).closest('button')) return
      if (tool.shape) {
        done()
        const from = drawing.picture.boxes.find((box) => box.id === one) ?? null
        return void tool.placeBehind(from).then((id) => id !== null && acts.goTo(id))
      }
      if (one === undefined) return
      done()
      if (event.shiftKey) return acts.open(one)
      chart.select({ boxes: [one], lines: [] })
      return readOnly ? undefined : acts.edit(one)
    case ' ':
      if (focused === undefined) return
      done()
      return chart.select({ boxes: [focused], lines: [] })
    case 'e':
      if (one === undefined || readOnly || event.shiftKey) return
      done()
      return linking.begin(one)
    case 'F2':
      done()
      return void document.querySelector<HTMLInputElement>('.inspector input[name="name"]')?.focus()
    case 'f':
    case '0':
      done()
      return acts.fit()
    case '+':
    case '=':
      done()
      return acts.zoom(1)
    case '-':
      done()
      return acts.zoom(-1)
  }
  const wanted = toolsFor(drawing.kind).find((known) => known.key === key)
  if (wanted && !readOnly && !event.shiftKey) {
    done()
    linking.leave()
    tool.arm(wanted.shape)
  }
}
