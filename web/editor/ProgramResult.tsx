// A program that was built and runs: what is being done, what it does now, and how it compares with the model.
//
// In: the lines of its job. Out: nothing. INVARIANT: the verdict is the command's own sentence; a program that was stopped has none.

import { type ReactNode } from 'react'

import type { State } from '../diagram/light'
import { besideOf } from '../diagram/outcome'
import type { Followed } from '../diagram/protocol'
import { words } from '../words'
import { Icon } from './icons'
import type { Job } from './jobs'

interface Line {
  type?: unknown
}

interface Conformance {
  verdict: 'conforms' | 'parts' | 'unknown'
  words: string
}

const ofType = <Told,>(job: Job, type: string): Told | null => {
  const found = job.lines.filter((line) => typeof line === 'object' && (line as Line).type === type)
  return (found.at(-1) as Told | undefined) ?? null
}

export const stageOf = (job: Job): string | null => ofType<{ stage: string }>(job, 'stage')?.stage ?? null

// What the tasks do, as the model's state has it.
export function statesOf(followed: Followed): State {
  return new Map(followed.phases.flatMap(([task, phase]) => (phase === null ? [] : [[`scheduler_currentPhase(${task})`, phase] as const])))
}

// Kinds of lines that are told here.
export const PROGRAM_LINES = ['stage', 'followed', 'conformance']

// What a job wrote since its last stage: of a program that runs not what its compiler said.
export const latest = (job: Job): Job['lines'] => job.lines.slice(job.lines.findLastIndex((line) => typeof line === 'object' && line['type'] === 'stage') + 1)

function toneOf(verdict: Conformance | null): [tone: string, icon: string] {
  if (verdict?.verdict === 'parts') return ['bad', 'cross']
  if (verdict?.verdict !== 'conforms') return ['unknown', 'question']
  return besideOf(verdict.words) === null ? ['good', 'check'] : ['unknown', 'warning']
}

export function ProgramResult({ job }: { job: Job }): ReactNode {
  const stage = stageOf(job)
  const verdict = job.running || job.code === null ? null : ofType<Conformance>(job, 'conformance')
  const [tone, icon] = toneOf(verdict)
  // What a run that conforms has all the same, line by line, is not as good as its verdict: it stands below, in no colour.
  const [said, ...beside] = verdict?.verdict === 'conforms' ? verdict.words.split('\n') : [verdict?.words]
  return (
    <section className="program" aria-label={words.jobs.program}>
      {job.running && stage !== null && <p className="faint-note doing">{words.program.stages[stage] ?? stage}</p>}
      {job.running && job.followed && (
        <p className="program-now">
          {job.followed.words}
          <span className="faint">{job.followed.phases.map(([task, phase]) => `${task}: ${phase ?? words.program.rests}`).join(' · ')}</span>
        </p>
      )}
      {!job.running && job.code === null && <p className="faint-note">{words.program.stopped}</p>}
      {verdict && (
        <p className={`outcome ${tone} program-verdict`} role="status">
          <Icon name={icon} size={14} />
          <span>{said}</span>
        </p>
      )}
      {beside.length > 0 && <p className="program-beside">{beside.join('\n')}</p>}
    </section>
  )
}
