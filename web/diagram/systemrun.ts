// The run of a system that a check found: what its tasks do and when, in the words of the chart, and which part each location belongs to.
//
// In: the drawing of the system, and the states of the run. Out: a lane for each component, what happens in a step, the locations that
// change, by part. A step of the run lasts a tick. Which location is a lock's or a task's, the state itself says; which phase a component is
// in, the drawing's lights say. INVARIANT: nothing of the run is left out; what no part has stands among the rest.

import { type Frame, functionOf, isControl } from './light'
import type { Drawing } from './protocol'

export type Tone = 'work' | 'read' | 'write' | 'wait'

// What a component does from a state of the run on, until before another one; these are indices of states.
export interface Span {
  from: number
  to: number
  tone: Tone
  text: string
}

export interface Lane {
  id: string
  title: string
  spans: Span[]
}

export interface Happened {
  part: string
  kind: 'begins' | 'rests' | 'asks' | 'enters' | 'leaves' | 'gives-up' | 'misses' | 'too-old'
  // A phase, or a channel.
  what: string
}

export interface Part {
  id: string | null
  title: string
  locations: string[]
}

const argumentsOf = (location: string): string[] => (/\((.*)\)\s*$/.exec(location)?.[1] ?? '').split(',').map((argument) => argument.trim())

const titleOf = (drawing: Drawing, id: string): string => drawing.picture.boxes.find((box) => box.id === id)?.lines.join(' ') || id

const TONES: Record<string, Tone> = { read: 'read', write: 'write', elaborate: 'work' }

// Names of the run, by the parts of the chart that they belong to.
interface Owners {
  // Of a component's task, and of a channel's lock.
  components: ReadonlyMap<string, string>
  channels: ReadonlyMap<string, string>
}

function ownersOf(drawing: Drawing, frame: Frame): Owners {
  const ids = new Set(drawing.picture.boxes.map((box) => box.id))
  const components = new Map<string, string>()
  const channels = new Map<string, string>()
  for (const [location, value] of frame.state) {
    const [of] = argumentsOf(location)
    if (of === undefined || !ids.has(of)) continue
    if (functionOf(location) === 'scheduler_mainThread') components.set(value, of)
    if (functionOf(location) === 'sem') channels.set(value, of)
  }
  return { components, channels }
}

interface Phases {
  id: string
  term: string
  // By the value of the component's phase: what the picture says of it.
  texts: ReadonlyMap<string, string>
}

function phasesOf(drawing: Drawing): Phases[] {
  const boxes = drawing.picture.boxes.filter((box) => box.figure === 'component')
  return boxes.map(({ id, details }) => {
    const own = new Set(details.map((detail) => detail.id))
    const light = drawing.lights.find(({ shapes }) => shapes.some(({ shape }) => own.has(shape)))
    const text = (shape: string): string => details.find((detail) => detail.id === shape)?.text ?? ''
    return { id, term: light?.term ?? '', texts: new Map((light?.shapes ?? []).map(({ value, shape }) => [value, text(shape)])) }
  })
}

function phaseAt(frame: Frame, { term }: Phases): string | null {
  for (const [location, value] of frame.state) if (term !== '' && isControl(location, term)) return value
  return null
}

const waits = (frame: Frame, owners: Owners, component: string): boolean =>
  [...frame.state].some(([location, value]) => value === 'WAITING' && functionOf(location) === 'sem_state' && owners.components.get(argumentsOf(location)[1] ?? '') === component)

// Each state is what its step has made of it: the first one is before all steps, and lasts no time.
export function lanesOf(drawing: Drawing, frames: readonly Frame[]): Lane[] {
  const [first] = frames
  if (!first) return []
  const owners = ownersOf(drawing, first)
  return phasesOf(drawing).map((phases) => {
    const spans: Span[] = []
    frames.forEach((frame, index) => {
      const text = index === 0 ? undefined : phases.texts.get(phaseAt(frame, phases) ?? '')
      if (text === undefined) return
      const tone = waits(frame, owners, phases.id) ? 'wait' : (TONES[text.split(' ')[0] ?? ''] ?? 'work')
      const last = spans.at(-1)
      if (last && last.to === index && last.tone === tone && last.text === text && !begins(frame, phases)) last.to = index + 1
      else spans.push({ from: index, to: index + 1, tone, text })
    })
    return { id: phases.id, title: titleOf(drawing, phases.id), spans }
  })
}

const begins = (frame: Frame, { term }: Phases): boolean => [...frame.changed.keys()].some((location) => isControl(location, term))

const LOCKS: Record<string, Record<string, Happened['kind']>> = {
  READY: { WAITING: 'asks', EXECUTION: 'enters' },
  WAITING: { EXECUTION: 'enters', READY: 'gives-up' },
  EXECUTION: { READY: 'leaves' },
}

const ORDER: Happened['kind'][] = ['leaves', 'gives-up', 'misses', 'too-old', 'rests', 'begins', 'asks', 'enters']

// What a step does, component by component.
export function happened(drawing: Drawing, first: Frame, frame: Frame): Happened[] {
  const owners = ownersOf(drawing, first)
  const out: Happened[] = []
  for (const phases of phasesOf(drawing)) {
    const part = phases.id
    for (const [location, before] of frame.changed) {
      const [of = '', task = ''] = argumentsOf(location)
      const now = frame.state.get(location) ?? ''
      if (functionOf(location) === 'sem_state' && owners.components.get(task) === part) {
        const kind = LOCKS[before]?.[now]
        if (kind) out.push({ part, kind, what: titleOf(drawing, owners.channels.get(of) ?? of) })
      } else if (functionOf(location) === 'task_deadlinesMissed' && owners.components.get(of) === part && Number(now) > Number(before)) {
        out.push({ part, kind: 'misses', what: '' })
      } else if (functionOf(location) === 'way_tooOld' && Number(now) > Number(before) && first.state.get(`way_end(${of})`) === part) {
        out.push({ part, kind: 'too-old', what: '' })
      }
    }
    if (!begins(frame, phases)) continue
    const text = phases.texts.get(phaseAt(frame, phases) ?? '')
    out.push(text === undefined ? { part, kind: 'rests', what: '' } : { part, kind: 'begins', what: text })
  }
  // Within a component: what ends a phase comes before what begins one.
  const parts = [...new Set(out.map(({ part }) => part))]
  return out.sort((a, b) => parts.indexOf(a.part) - parts.indexOf(b.part) || ORDER.indexOf(a.kind) - ORDER.indexOf(b.kind))
}

// The locations that have another value at some time, or none at first.
export function varying(frames: readonly Frame[]): Set<string> {
  const known = new Set<string>()
  const [first] = frames
  for (const frame of frames) for (const location of frame.changed.keys()) known.add(location)
  for (const location of frames.at(-1)?.state.keys() ?? []) if (!first?.state.has(location)) known.add(location)
  return known
}

// Locations by the part that they speak of: the first one that an argument names, else the one whose name they begin with.
export function partsOf(drawing: Drawing, first: Frame, locations: Iterable<string>): Part[] {
  const owners = ownersOf(drawing, first)
  const ids = drawing.picture.boxes.map((box) => box.id)
  const known = new Set(ids)
  const phases = new Map(phasesOf(drawing).flatMap(({ id, texts }) => [...texts.keys()].map((value): [string, string] => [value, id])))
  const ownerOf = (location: string): string | null => {
    for (const name of argumentsOf(location)) {
      const found = known.has(name) ? name : (owners.components.get(name) ?? owners.channels.get(name) ?? phases.get(name) ?? first.state.get(`hop_buffer(${name})`) ?? first.state.get(`way_end(${name})`))
      if (found !== undefined && known.has(found)) return found
    }
    const prefixes = ids.filter((id) => functionOf(location) === id || functionOf(location).startsWith(`${id}_`))
    return prefixes.sort((a, b) => b.length - a.length)[0] ?? null
  }
  const found = new Map<string | null, string[]>()
  for (const location of locations) {
    const owner = ownerOf(location)
    found.set(owner, [...(found.get(owner) ?? []), location])
  }
  const order = [...ids.filter((id) => found.has(id)), ...(found.has(null) ? [null] : [])]
  return order.map((id) => ({ id, title: id === null ? '' : titleOf(drawing, id), locations: found.get(id) ?? [] }))
}

// A time as charts write it, after so many ticks; a tick is a millisecond unless the chart says another length.
export function timeAfter(ticks: number, tick: string | null): string {
  const [, length, unit] = /^\s*(\d+(?:\.\d+)?)\s*(ns|us|ms|s)\s*$/.exec(tick ?? '1 ms') ?? []
  return length === undefined || unit === undefined ? '' : `${Number((ticks * Number(length)).toPrecision(12)).toLocaleString('en', { maximumFractionDigits: 9, useGrouping: false })} ${unit}`
}

// Where an axis of so many steps has numbers: at few round ones.
export function marksOf(steps: number): number[] {
  const power = 10 ** Math.floor(Math.log10(Math.max(1, steps / 5)))
  const apart = [1, 2, 5, 10].map((factor) => factor * power).find((apart) => steps / apart <= 6) ?? steps
  return Array.from({ length: Math.floor(steps / apart) + 1 }, (_, index) => index * apart)
}
