// What a run or a counterexample shows on a drawing: lit states, values of guards, breakpoints.

import { useMemo } from 'react'

import { type Frame, controlOf, frames, lit, stateOf } from '../diagram/light'
import { listing } from '../diagram/stategraph'
import type { Drawing, Followed } from '../diagram/protocol'
import { type Job, type JobsState, type Verdict, verdicts } from './jobs'
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

// The counterexample that is played: its run, and the state of it that is shown.
export interface Played {
  frame: Frame
  all: readonly Frame[]
  verdict: Verdict
  job: Job
  playing: NonNullable<JobsState['playing']>
}

export function useFrame(studio: Studio): Played | null {
  const playing = useStore(studio.jobs.store, (state) => state.playing)
  const jobs = useStore(studio.jobs.store, (state) => state.jobs)
  const job = playing ? jobs.find((job) => job.id === playing.job) : undefined
  const verdict = job && verdicts(job).find((verdict) => verdict.check === playing?.check)
  // The states are made once for a run, not for each step of it.
  const trace = verdict?.trace
  const all = useMemo(() => frames(trace ?? []), [trace])
  return useMemo(() => {
    const frame = playing ? all[Math.min(playing.at, all.length - 1)] : undefined
    return frame && verdict && job && playing ? { frame, all, verdict, job, playing } : null
  }, [all, verdict, job, playing])
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
