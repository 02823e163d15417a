// What a run or a counterexample shows on a drawing: lit states, values of guards, breakpoints.

import { useMemo } from 'react'

import { controlOf, frames, lit, stateOf } from '../diagram/light'
import { listing } from '../diagram/stategraph'
import type { Drawing, Followed } from '../diagram/protocol'
import { type JobsState, verdicts } from './jobs'
import type { Coverage } from './marks'
import { statesOf } from './ProgramResult'
import { guardTerms } from './run'
import { useStore } from './store'
import type { Studio } from './studio'

const NOT_COVERED: ReadonlyMap<string, Coverage> = new Map()

export interface ShownRun {
  covered: ReadonlyMap<string, Coverage>
  lit: ReadonlyMap<string, string[]>
  values: ReadonlyMap<string, string>
  breaks: ReadonlySet<string>
  lines: ReadonlySet<number>
}

const NO_LINES: ReadonlySet<number> = new Set()

// The breakpoint that a shape stands for, as a term; null if it has none.
export function breakTerm(drawing: Drawing, id: string): string | null {
  const box = drawing.picture.boxes.find((box) => box.id === id)
  const control = controlOf(drawing)
  if (!box) return null
  if (box.figure === 'hexagon') return box.link && !box.link.includes('$') ? box.link : box.link ? null : box.id
  if (box.figure !== 'circle' || control === null || control.includes('$')) return null
  const value = drawing.lights[0]?.shapes.find(({ shape }) => shape === id)?.value
  return value === undefined ? null : `${control} = ${value}`
}

export function useFrame(studio: Studio) {
  const playing = useStore(studio.jobs.store, (state) => state.playing)
  const jobs = useStore(studio.jobs.store, (state) => state.jobs)
  return useMemo(() => {
    if (!playing) return null
    const job = jobs.find((job) => job.id === playing.job)
    const verdict = job && verdicts(job).find((verdict) => verdict.check === playing.check)
    const all = frames(verdict?.trace ?? [])
    const frame = all[Math.min(playing.at, all.length - 1)]
    return frame && verdict ? { frame, count: all.length, end: all.at(-1)?.step ?? 0, verdict, playing } : null
  }, [jobs, playing])
}

// The state of a state graph that is picked, as long as its panel is open.
export function usePickedState(studio: Studio): ReadonlyMap<string, string> | null {
  const picked = useStore(studio.jobs.store, (state) => state.picked)
  const job = useStore(studio.jobs.store, (state) => state.jobs.find((job) => job.id === state.picked?.job) ?? null)
  const open = useStore(studio.store, (state) => state.panel === 'graph')
  return useMemo(() => {
    const state = job && picked && open ? listing(job.lines).states[picked.state] : undefined
    return state ? new Map(state.values) : null
  }, [job, picked, open])
}

// What the program that runs does, if one does.
const runningProgram = (state: JobsState): Followed | null => state.jobs.find((job) => job.running && job.followed)?.followed ?? null

export function useShownRun(studio: Studio, drawing: Drawing, uri: string): ShownRun {
  const covered = useStore(studio.marks.covered, (state) => state.of.get(uri)?.get(drawing.name) ?? NOT_COVERED)
  const session = useStore(studio.runner.store, (state) => state.session)
  const values = useStore(studio.runner.store, (state) => state.values)
  const breaks = useStore(studio.runner.store, (state) => state.breaks)
  const played = useFrame(studio)
  const followed = useStore(studio.jobs.store, runningProgram)
  const picked = usePickedState(studio)
  return useMemo(() => {
    const state = followed ? statesOf(followed) : picked ? picked : played ? played.frame.state : session ? stateOf(session) : new Map<string, string>()
    const guards = new Map<string, string>()
    const broken = new Set<string>()
    for (const box of drawing.picture.boxes) {
      const term = breakTerm(drawing, box.id)
      if (term !== null && breaks.includes(term)) broken.add(box.id)
      if (!session || played || followed || picked) continue
      const known = guardTerms(drawing, box, session)
        .map(({ term }) => values.get(term))
        .filter((value) => value !== undefined && value !== null)
      const first = known[0]
      if (first !== undefined) guards.set(box.id, known.every((value) => value === first) ? first : 'mixed')
    }
    return { lit: lit(drawing, state), values: guards, breaks: broken, lines: NO_LINES, covered }
  }, [breaks, covered, drawing, followed, picked, played, session, values])
}
