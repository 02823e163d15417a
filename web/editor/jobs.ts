// Jobs of the server: verification, tests, building, checking, generating; their output and their end.
//
// Owns: the list of jobs, newest first, and what their lines say: verdicts with counterexamples, results of scenarios, faults.
// In: `studio/line` and `studio/done`. Out: a store.

import type { Looked } from '../diagram/currency'
import type { RunStep } from '../diagram/light'
import { type Loads, type Outcome, outcomeOf } from '../diagram/outcome'
import type { Fault } from '../diagram/pick'
import type { File, Followed, JobKind } from '../diagram/protocol'
import { words } from '../words'
import { Store } from './store'
import type { Studio } from './studio'

export interface Verdict {
  check: string
  kind: string
  verdict: 'holds' | 'violated' | 'unknown'
  states?: number
  by?: string
  reasons?: string[]
  at?: LinePlace
  trace?: RunStep[]
  again_from?: number
  // The counterexample as a scenario beside the model.
  scenario?: string
  // What a counterexample lacks here because it is too long.
  omitted?: { trace?: { after: number; steps: number }; scenario?: true }
}

// Lines and columns from 1, as the command line counts.
export interface LinePlace {
  file: string
  line: number
  column: number
  end_line?: number
  end_column?: number
}

export interface Job {
  id: number
  job: JobKind
  file: File
  running: boolean
  code: number | null
  began: number
  options: object
  lines: (string | Record<string, unknown>)[]
  progress: string | null
  // What a program that runs does now.
  followed: Followed | null
  // The texts that it looks at, as they were when it began.
  texts: Looked[]
  // The chart in front when it was started, if the job is of its model; and whether that is known not to be the chart's.
  chart: File | null
  isOlder: boolean
  // The model that each scenario of a test loads.
  loads: Loads[]
  // Where C++ is written.
  folder: string | null
}

// What the server answers when a job begins; an exported project tells its number alone.
interface Begun {
  job: number
  texts?: { path: string; hash: string | null }[]
  loads?: Loads[]
  folder?: string | null
}

export interface JobsState {
  jobs: Job[]
  // The job that is shown.
  shown: number | null
  // The counterexample that is played, and at which step.
  playing: { job: number; check: string; at: number } | null
  // The state of a state graph that is picked.
  picked: { job: number; state: number } | null
}

export interface JobOptions {
  time?: number
  first?: boolean
  seconds?: number
  pace?: string
  where?: string[]
  coverage?: boolean
}

// LIMIT: of a job with endless output, the last lines are kept, and what it found.
const KEPT = 5000

function kept(lines: Job['lines']): Job['lines'] {
  if (lines.length <= KEPT) return lines
  const first = Math.max(0, lines.findIndex((line) => typeof line === 'string'))
  return lines.filter((_, index) => index !== first)
}

export class Jobs {
  readonly store = new Store<JobsState>({ jobs: [], shown: null, playing: null, picked: null })
  private early = new Map<number, (string | Record<string, unknown>)[]>()
  private ended = new Map<number, number | null>()

  // How many jobs ended with a connection.
  private past = 0

  constructor(private readonly studio: Studio) {
    studio.server.on<{ job: number; line: string | Record<string, unknown> }>('studio/line', ({ job, line }) => this.line(job, line))
    studio.server.on<{ job: number; code: number | null }>('studio/done', ({ job, code }) => this.done(job, code))
  }

  // Of the model of a chart, the chart is named, too.
  async start(job: JobKind, file: File, options: JobOptions = job === 'test' ? { coverage: true } : {}, of: { chart: File; isOlder: boolean } | null = null): Promise<void> {
    await this.studio.saveAll()
    try {
      const params = { job, path: file.path, options, ...(of === null ? {} : { chart: of.chart.path }) }
      const begun = await this.studio.server.request<Begun>('studio/job', params)
      const { job: id } = begun
      const lines = this.early.get(id) ?? []
      this.early.delete(id)
      const code = this.ended.get(id)
      this.ended.delete(id)
      const fresh: Job = {
        id,
        job,
        file,
        running: code === undefined,
        code: code ?? null,
        began: Date.now(),
        lines,
        progress: null,
        followed: null,
        options,
        texts: this.studio.currency.looked(begun.texts ?? []),
        chart: of?.chart ?? null,
        isOlder: of?.isOlder ?? false,
        loads: begun.loads ?? [],
        folder: begun.folder ?? null,
      }
      this.store.set((state) => ({ jobs: [fresh, ...state.jobs].slice(0, 30), shown: id, playing: null, picked: null }))
      this.studio.store.set({ panel: job === 'graph' ? 'graph' : 'check' })
      if (code !== undefined) this.after(fresh)
    } catch (error) {
      this.studio.tell((error as Error).message, 'refused')
    }
  }

  private update(id: number, change: (job: Job) => Partial<Job>): Job | null {
    let changed: Job | null = null
    this.store.set((state) => ({
      jobs: state.jobs.map((job) => {
        if (job.id !== id) return job
        changed = { ...job, ...change(job) }
        return changed
      }),
    }))
    return changed
  }

  private line(id: number, line: string | Record<string, unknown>): void {
    const known = this.store.get().jobs.some((job) => job.id === id)
    if (!known) {
      this.early.set(id, [...(this.early.get(id) ?? []), line])
      return
    }
    const progress = typeof line === 'object' && line['type'] === 'progress' ? told(line) : null
    if (typeof line === 'object' && line['type'] === 'followed') return void this.update(id, () => ({ followed: line as unknown as Followed }))
    this.update(id, (job) => (progress === null ? { lines: kept([...job.lines, line]) } : { progress }))
  }

  private done(id: number, code: number | null): void {
    if (!this.store.get().jobs.some((job) => job.id === id)) {
      this.ended.set(id, code)
      return
    }
    const job = this.update(id, () => ({ running: false, code, progress: null }))
    if (job) this.after(job)
  }

  private after(job: Job): void {
    const told = this.findings(job)
    // Two runs side by side: too much for a low panel.
    if (job.job === 'refine' && job.code === 1) this.studio.store.set({ tall: true })
    const marks = this.studio.marks.texts(job)
    const all = (found: Map<string, Fault[]>): void => {
      for (const [uri, faults] of marks) found.set(uri, [...(found.get(uri) ?? []), ...faults])
      this.studio.find(found)
    }
    all(new Map(told))
    if (job.job === 'test') this.studio.marks.clear()
    if (marks.size > 0 || job.lines.some((line) => typeof line === 'object' && line['type'] === 'coverage')) {
      void this.studio.marks.charts(job).then(
        (charts) => {
          const newest = this.store.get().jobs.find((other) => !other.running && other.job !== 'graph')
          if (newest?.id === job.id && charts.size > 0) all(new Map([...told, ...charts]))
        },
        (error: Error) => this.studio.tell(error.message, 'refused'),
      )
    }
    if (job.job === 'build' || job.job === 'generate' || job.job === 'program') this.studio.redraw()
    this.waiting.get(job.id)?.(job)
    this.waiting.delete(job.id)
  }

  // The faults that a job told, by the files that they are in.
  private findings(job: Job): Map<string, Fault[]> {
    const out = new Map<string, Fault[]>()
    for (const fault of faultsOf(job)) {
      const file = this.studio.named(fault.file)
      if (!file) continue
      const start = { line: fault.line - 1, character: fault.column - 1 }
      const end = { line: (fault.end_line ?? fault.line) - 1, character: (fault.end_column ?? fault.column) - 1 }
      const severity = fault.severity === 'warning' || fault.severity === 'note' ? 'warning' : 'error'
      const message = fault.help ? `${fault.message}\n${words.check.help(fault.help)}` : fault.message
      out.set(file.uri, [...(out.get(file.uri) ?? []), { uri: file.uri, range: { start, end }, severity, message, code: fault.id }])
    }
    return out
  }

  private waiting = new Map<number, (job: Job) => void>()

  // Resolves when the job that was started last is done.
  async run(job: JobKind, file: File): Promise<Job | null> {
    const before = this.store.get().shown
    await this.start(job, file)
    const { shown, jobs } = this.store.get()
    const begun = jobs.find((job) => job.id === shown)
    if (!begun || shown === before) return null
    if (!begun.running) return begun
    return new Promise((resolve) => this.waiting.set(begun.id, resolve))
  }

  async stop(id: number): Promise<void> {
    try {
      await this.studio.server.request('studio/stop', { job: id })
    } catch (error) {
      this.studio.tell((error as Error).message, 'refused')
    }
  }

  show(id: number): void {
    this.store.set({ shown: id })
  }

  play(job: number, check: string, at: number): void {
    this.store.set({ playing: { job, check, at } })
  }

  // Picks a state of a state graph; charts show it.
  pick(job: number, state: number | null): void {
    this.store.set({ picked: state === null ? null : { job, state }, playing: null })
  }

  leave(): void {
    this.store.set({ playing: null })
  }

  // What runs ends with the connection. A studio that was started anew counts from 1 again: what is known gets numbers below.
  lost(): void {
    const open = this.store.get().jobs.filter(({ id }) => id > 0)
    const below = new Map(open.map(({ id }, index) => [id, -(this.past + index + 1)]))
    this.past += open.length
    const before = (id: number): number => below.get(id) ?? id
    this.store.set(({ jobs, shown, playing, picked }) => ({
      jobs: jobs.map((job) => ({ ...job, id: before(job.id), ...(job.running ? { running: false, code: null } : {}) })),
      shown: shown === null ? null : before(shown),
      playing: playing && { ...playing, job: before(playing.job) },
      picked: picked && { ...picked, job: before(picked.job) },
    }))
    this.early.clear()
    this.ended.clear()
    this.waiting.clear()
  }
}

const told = (line: Record<string, unknown>): string =>
  Object.entries(line)
    .filter(([key, value]) => key !== 'type' && typeof value !== 'object')
    .map(([key, value]) => `${key} ${String(value)}`)
    .join(' · ')

export const verdicts = (job: Job): Verdict[] =>
  job.lines.filter((line) => typeof line === 'object' && line['type'] === 'verdict') as unknown as Verdict[]

export interface ToldFault extends LinePlace {
  id: string
  severity: string
  message: string
  reason?: string
  help?: string | null
  labels?: (LinePlace & { text: string })[]
}

export interface ScenarioResult {
  name: string
  file: string
  result: string
  steps: number
  checks: number
  failed_checks: number
  faults: ToldFault[]
}

export interface TaskTimes {
  name: string
  priority: number
  period_ns: number | null
  execution_ns: [number, number]
  load: number | null
  blocking_ns: number | null
  response_ns: number | null
  deadline_ns: number | null
  verdict: string | null
  reason: string | null
  missed: { allowed: number; cycles: number; most: number | null; within: boolean | null; reason: string | null } | null
}

export interface FreshTimes {
  reader: string
  channel: string
  limit_ns: number
  most_ns: number | null
  within: boolean | null
  reason: string | null
}

export interface AgeTimes {
  from: string
  to: string
  limit_ns: number
  most_ns: number | null
  within: boolean | null
  reason: string | null
}

// What the analysis of a system's times says; docs/json.md.
export interface SystemTimes {
  system: string
  processors: number
  load: number
  tasks: TaskTimes[]
  ages: AgeTimes[]
  fresh: FreshTimes[]
  // What cannot hold on one processor, while a chart does not say how many there are.
  told?: string[]
}

export const timesOf = (job: Job): SystemTimes[] =>
  job.lines.filter((line) => typeof line === 'object' && line['type'] === 'times') as unknown as SystemTimes[]

const isFault = (line: unknown): line is ToldFault =>
  typeof line === 'object' && line !== null && (line as { type?: unknown }).type === 'fault' && typeof (line as ToldFault).file === 'string'

export const scenarios = (job: Job): ScenarioResult[] =>
  job.lines.filter((line) => typeof line === 'object' && line['type'] === 'scenario') as unknown as ScenarioResult[]

// The faults that a job told: what several of its commands tell alike, once.
export function faultLines(job: Job): ToldFault[] {
  const told = (job.lines as unknown[]).filter(isFault)
  const key = ({ id, file, line, column, message }: ToldFault): string => [id, file, line, column, message].join('\n')
  return [...new Map(told.map((fault) => [key(fault), fault])).values()]
}

export const outcome = (job: Job): Outcome => outcomeOf({ ...job, path: job.file.path })

const faultsOf = (job: Job): ToldFault[] => [...faultLines(job), ...scenarios(job).flatMap((scenario) => scenario.faults.filter(isFault))]
