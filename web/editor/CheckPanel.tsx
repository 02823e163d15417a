// What jobs found: verdicts with counterexamples that play, results of scenarios, differences, output; whether it still holds of the texts.

import { type ReactNode, useEffect, useState } from 'react'

import { type Outcome, hasPassed } from '../diagram/outcome'
import { words } from '../words'
import { changedSince } from './currency'
import { Icon } from './icons'
import { MARKED, Marked } from './Marked'
import { Player } from './Player'
import { PROGRAM_LINES, ProgramResult, latest } from './ProgramResult'
import { REFINEMENT, Refined, refinementOf } from './Refined'
import { TimesTables } from './TimesTable'
import { type Job, type LinePlace, type ScenarioResult, type ToldFault, type Verdict, faultLines, outcome, scenarios, timesOf, verdicts } from './jobs'
import { again, lastName, runOf, withModel } from './ofChart'
import { useFrame } from './shown'
import { useStore } from './store'
import type { Studio } from './studio'

export async function goTo(studio: Studio, place: LinePlace | undefined): Promise<void> {
  if (!place) return
  const file = studio.named(place.file)
  if (!file) return
  const start = { line: place.line - 1, character: place.column - 1 }
  const end = { line: (place.end_line ?? place.line) - 1, character: (place.end_column ?? place.column) - 1 }
  await studio.show({ uri: file.uri, range: { start, end } })
}

export function CheckPanel({ studio }: { studio: Studio }): ReactNode {
  const { jobs, shown } = useStore(studio.jobs.store, (state) => state)
  const job = jobs.find((job) => job.id === shown) ?? jobs[0]
  const changed = useStore(studio.currency.store, (state) => state.changed)
  const played = useFrame(studio)
  if (!job) {
    return (
      <div className="panel-empty tall">
        <h3>{words.check.none}</h3>
        <p>{words.check.noneHint}</p>
      </div>
    )
  }
  const isFormer = changed.has(job.id)
  return (
    <div className="check">
      <ul className="job-list" aria-label={words.check.jobs}>
        {jobs.map((other) => (
          <li key={other.id}>
            <button className={other.id === job.id ? 'on' : undefined} aria-current={other.id === job.id} onClick={() => studio.jobs.show(other.id)}>
              <OutcomeWord job={other} isFormer={changed.has(other.id)} />
              <span className="job-name">{words.jobs[other.job]}</span>
              <span className="job-file">{lastName(other.file.path)}</span>
              <time className="job-time" title={words.check.began(clock(other.began))}>
                {clock(other.began)}
              </time>
            </button>
          </li>
        ))}
      </ul>
      <div className={`job${isFormer ? ' former' : ''}`} aria-live="polite">
        <header className="row wrap">
          <h3>
            {words.jobs[job.job]} <span className="faint">{job.file.path}</span>
          </h3>
          <OutcomeWord job={job} isFormer={isFormer} named />
          <Currency studio={studio} job={job} />
          {job.progress !== null && <span className="faint progress">{job.progress}</span>}
          <span className="grow" />
          {job.running && <Elapsed since={job.began} />}
          {job.running ? (
            <button className="small" onClick={() => void studio.jobs.stop(job.id)}>
              <Icon name="stop" size={13} />
              {words.check.stop}
            </button>
          ) : (
            <button className={`small${isFormer ? ' primary' : ''}`} onClick={() => again(studio, job)}>
              <Icon name="restart" size={13} />
              {words.check.again}
            </button>
          )}
        </header>
        <div className="scroll" tabIndex={0}>
          <Findings studio={studio} job={job} />
        </div>
      </div>
      {played && played.playing.job === job.id && <Player studio={studio} played={played} />}
    </div>
  )
}

function Elapsed({ since }: { since: number }): ReactNode {
  const [, tick] = useState(0)
  useEffect(() => {
    const timer = setInterval(() => tick((count) => count + 1), 1000)
    return () => clearInterval(timer)
  }, [])
  return <span className="faint">{words.check.elapsed(Math.round((Date.now() - since) / 1000))}</span>
}

const clock = (time: number): string => new Date(time).toLocaleTimeString('en-GB', { hour: '2-digit', minute: '2-digit' })

const OUTCOMES: Record<Outcome['kind'], [tone: string, icon: string, word: string]> = {
  running: ['running', 'restart', words.check.running],
  good: ['good', 'check', words.check.good],
  bad: ['bad', 'cross', words.check.bad],
  unknown: ['unknown', 'question', words.check.unknown],
  stopped: ['unknown', 'stop', words.check.stopped],
  world: ['bad', 'warning', words.check.world],
  elsewhere: ['neutral', 'question', words.check.nothingOfIt],
  conforms: ['unknown', 'warning', ''],
}

// What was found of other texts is told, but not in its colour.
function OutcomeWord({ job, isFormer, named = false }: { job: Job; isFormer: boolean; named?: boolean }): ReactNode {
  const found = outcome(job)
  const [tone, icon, known] = OUTCOMES[found.kind]
  const word = found.kind === 'conforms' ? words.check.conforms(found.beside) : known
  return (
    <span className={`outcome ${isFormer ? 'neutral' : tone}`} title={word}>
      <Icon name={icon} size={13} />
      {named ? word : <span className="unseen">{word}</span>}
    </span>
  )
}

// That a result is of texts that are others now, or of a model that is not the chart's.
export function Currency({ studio, job }: { studio: Studio; job: Job }): ReactNode {
  const changed = useStore(studio.currency.store, (state) => changedSince(state.changed, job))
  return (
    <>
      {job.isOlder && <span className="outcome unknown currency">{words.older.model}</span>}
      {changed.length > 0 && (
        <span className="outcome unknown currency" role="status">
          <Icon name="warning" size={13} />
          {words.older.changed(changed.map(lastName))}
        </span>
      )}
    </>
  )
}

function Findings({ studio, job }: { studio: Studio; job: Job }): ReactNode {
  const found = verdicts(job)
  const played = scenarios(job)
  const faults = faultLines(job)
  const times = timesOf(job)
  const refined = refinementOf(job)
  const rest = latest(job).filter((line) => typeof line === 'string' || !['verdict', 'scenario', 'summary', 'progress', 'fault', 'times', 'graph-state', REFINEMENT, ...MARKED, ...PROGRAM_LINES].includes(String(line['type'])))
  return (
    <>
      <Done studio={studio} job={job} />
      {job.running && job.job !== 'program' && <p className="faint-note doing">{words.check.doing[job.job]}</p>}
      {found.length > 0 && (
        <ul className="verdicts">
          {found.map((verdict) => (
            <VerdictLine key={verdict.check} studio={studio} job={job} verdict={verdict} />
          ))}
        </ul>
      )}
      {played.length > 0 && (
        <ul className="verdicts">
          {played.map((scenario) => (
            <ScenarioLine key={scenario.file} studio={studio} scenario={scenario} />
          ))}
        </ul>
      )}
      {refined && <Refined found={refined} />}
      <Marked studio={studio} job={job} />
      {times.length > 0 && <TimesTables all={times} />}
      {job.job === 'program' && <ProgramResult job={job} />}
      {faults.length > 0 && (
        <ul className="verdicts">
          {faults.map((fault, index) => (
            <FaultLine key={index} studio={studio} fault={fault} />
          ))}
        </ul>
      )}
      {rest.length > 0 && <Output studio={studio} lines={rest} />}
    </>
  )
}

// What a job did that writes or compares, and which scenarios a test had: its lines do not say it.
function Done({ studio, job }: { studio: Studio; job: Job }): ReactNode {
  const found = outcome(job)
  const name = lastName(job.file.path)
  if (found.kind === 'elsewhere') return <p className="note">{words.check.elsewhere(name, found.of.map(lastName), found.passed, found.played)}</p>
  if (found.kind !== 'good') return null
  switch (job.job) {
    case 'check':
      return <p className="note">{words.check.agrees}</p>
    case 'build':
      return <p className="note">{words.check.builtFrom(name.replace(/\.chart$/, '.asm'), name)}</p>
    case 'generate':
      return (
        <p className="note">
          {words.check.written(job.folder ?? '')}{' '}
          <button className="link-button" onClick={() => studio.store.set({ panel: 'code' })}>
            {words.check.showCode}
          </button>
        </p>
      )
    default:
      return null
  }
}

// A counterexample as a run of its model: of a system, the model that is built from the chart.
async function runCounterexample(studio: Studio, job: Job, scenario: string): Promise<void> {
  studio.jobs.leave()
  const { file, chart, isOlder } = job
  if (file.kind === 'chart') return withModel(studio, runOf(studio, file, null, null, scenario))
  await studio.runner.open(file, null, null, scenario, chart && { chart, text: studio.doc(chart.uri)?.text ?? null, isOlder })
}

const MARK = { holds: ['good', 'check'], violated: ['bad', 'cross'], unknown: ['unknown', 'question'] } as const

function VerdictLine({ studio, job, verdict }: { studio: Studio; job: Job; verdict: Verdict }): ReactNode {
  const [tone, icon] = MARK[verdict.verdict]
  const steps = verdict.trace?.length ?? 0
  const left = verdict.omitted?.trace
  const said = verdict.verdict === 'unknown' ? words.check.unknownVerdict : words.check[verdict.verdict]
  return (
    <li className="verdict">
      <span className={`outcome ${tone}`}>
        <Icon name={icon} size={13} />
        {said}
      </span>
      {verdict.at && studio.named(verdict.at.file) ? (
        <button className="link-button mono" onClick={() => void goTo(studio, verdict.at)}>
          {verdict.check}
        </button>
      ) : verdict.kind === 'builtin' ? (
        <span>{words.check.builtin[verdict.check] ?? verdict.check}</span>
      ) : (
        <code title={words.systemRun.claim(verdict.check) ?? undefined}>{verdict.check}</code>
      )}
      <span className="faint">{verdict.by ?? (verdict.states !== undefined ? words.check.states(verdict.states) : (verdict.reasons ?? []).join(' '))}</span>
      {left && <span className="faint left-out">{leftOut(steps, left)}</span>}
      <span className="grow" />
      {steps > 0 && (
        <button className="small" onClick={() => studio.jobs.play(job.id, verdict.check, 0)}>
          <Icon name="play" size={12} />
          {words.check.trace(steps + (left?.steps ?? 0) - 1)}
        </button>
      )}
      {verdict.scenario !== undefined && (
        <button className="small" title={words.check.runItHint} onClick={() => void runCounterexample(studio, job, verdict.scenario ?? '')}>
          <Icon name="timeline" size={12} />
          {words.check.runIt}
        </button>
      )}
    </li>
  )
}

// Which steps of a counterexample are here.
function leftOut(steps: number, { after, steps: left }: { after: number; steps: number }): string {
  return steps === 0 ? words.check.noSteps(left) : words.check.omitted(after, steps - after, steps + left)
}

// A fault with the other places that it speaks of.
function FaultLine({ studio, fault }: { studio: Studio; fault: ToldFault }): ReactNode {
  return (
    <li className="verdict fault-told">
      <span className={`outcome ${fault.severity === 'warning' ? 'unknown' : 'bad'}`}>
        <Icon name="warning" size={13} />
        {fault.severity}
      </span>
      <div>
        <button className="link-button" onClick={() => void goTo(studio, fault)}>
          {fault.message}
        </button>
        {fault.help && <p className="help">{words.check.help(fault.help)}</p>}
        {(fault.labels ?? []).map((label, index) => (
          <button key={index} className="link-button label" onClick={() => void goTo(studio, label)}>
            {label.text}
          </button>
        ))}
      </div>
    </li>
  )
}

function ScenarioLine({ studio, scenario }: { studio: Studio; scenario: ScenarioResult }): ReactNode {
  const good = hasPassed(scenario)
  const fault = scenario.faults[0]
  return (
    <li className="verdict">
      <span className={`outcome ${good ? 'good' : 'bad'}`}>
        <Icon name={good ? 'check' : 'cross'} size={13} />
        {scenario.result}
      </span>
      <button className="link-button mono" onClick={() => void goTo(studio, fault ?? { file: scenario.file, line: 1, column: 1 })}>
        {scenario.name}
      </button>
      <span className="faint">
        {words.check.steps(scenario.steps)}, {words.check.checks(scenario.checks, scenario.failed_checks)}
      </span>
      {fault?.message && <span className="message bad">{fault.message}</span>}
    </li>
  )
}

function Output({ studio, lines }: { studio: Studio; lines: (string | Record<string, unknown>)[] }): ReactNode {
  return (
    <ul className="output">
      {lines.slice(-600).map((line, index) => {
        if (typeof line === 'string') return <li key={index}>{line}</li>
        const at = (line['at'] ?? line['place']) as LinePlace | undefined
        if (line['type'] === 'graph') {
          return <li key={index}>{words.graph.size(Number(line['states']), Number(line['steps']), line['complete'] === true, typeof line['reason'] === 'string' ? line['reason'] : '')}</li>
        }
        if (line['type'] === 'explored') return <li key={index}>{words.check.explored(Number(line['states']), line['complete'] === true)}</li>
        const message = line['message'] ?? line['text'] ?? null
        const told =
          typeof message === 'string'
            ? message
            : Object.entries(line)
                .filter(([key, value]) => key !== 'at' && value !== null && typeof value !== 'object')
                .map(([key, value]) => (key === 'type' ? String(value) : `${key.replaceAll('_', ' ')} ${String(value)}`))
                .join(' · ')
        return (
          <li key={index} className={line['severity'] === 'error' ? 'bad' : undefined}>
            {at?.file ? (
              <button className="link-button" onClick={() => void goTo(studio, at)}>
                {told}
              </button>
            ) : (
              told
            )}
          </li>
        )
      })}
    </ul>
  )
}
