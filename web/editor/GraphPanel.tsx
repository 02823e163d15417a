// The panel of the state graph: what there is of it, a term that filters it, the picture, and the state that is picked.
//
// In: the newest job that lists states. Out: the picked state, which the charts show, too.

import { type FormEvent, type ReactNode, useEffect, useMemo, useState } from 'react'

import { type ListedState, type Listing, type Places, edgesOf, listing } from '../diagram/stategraph'
import type { File } from '../diagram/protocol'
import { words } from '../words'
import { Currency } from './CheckPanel'
import { GraphPicture } from './GraphPicture'
import { Icon } from './icons'
import type { Job } from './jobs'
import { again as askAgain, withModel } from './ofChart'
import { useStore } from './store'
import type { Studio } from './studio'
import { runnable } from './RunPanel'

// LIMIT: milliseconds that placing may take.
const PATIENCE_MS = 20_000

export function GraphPanel({ studio }: { studio: Studio }): ReactNode {
  const job = useStore(studio.jobs.store, (state) => state.jobs.find((job) => job.job === 'graph') ?? null)
  const active = useStore(studio.store, (state) => state.active)
  const { file } = runnable(studio, active)
  const model = file?.kind === 'model' ? file : null
  if (job) return <Listed key={job.id} studio={studio} job={job} />
  return (
    <div className="panel-empty tall">
      <h3>{words.graph.none}</h3>
      <p>{model ? words.graph.noneHint : words.graph.noModel}</p>
      {model && (
        <button className="primary" onClick={() => draw(studio, model)}>
          <Icon name="states" />
          {words.graph.draw(model.path.split('/').at(-1) ?? model.path)}
        </button>
      )}
    </div>
  )
}

// The states of the model in front, or of that of the chart in front.
function draw(studio: Studio, model: File): void {
  const { active } = studio.store.get()
  const front = active === null ? undefined : studio.file(active)
  if (front?.kind !== 'chart') return void studio.jobs.start('graph', model)
  void withModel(studio, { what: 'graph', chart: front, act: (model, isOlder) => void studio.jobs.start('graph', model, {}, { chart: front, isOlder }) })
}

// The places of a listing that is whole, made by a worker that ends with the panel.
function usePlaces(all: Listing | null): Places | 'slow' | null {
  const [places, setPlaces] = useState<Places | 'slow' | null>(null)
  useEffect(() => {
    if (!all) return
    const worker = new Worker(new URL('./stategraph.worker.ts', import.meta.url), { type: 'module' })
    const timer = setTimeout(() => {
      worker.terminate()
      setPlaces('slow')
    }, PATIENCE_MS)
    worker.onmessage = ({ data }: MessageEvent<Places>) => {
      clearTimeout(timer)
      setPlaces(data)
    }
    worker.postMessage({ depths: all.states.map((state) => state.depth), edges: edgesOf(all.states) })
    return () => {
      clearTimeout(timer)
      worker.terminate()
    }
  }, [all])
  return places
}

function Listed({ studio, job }: { studio: Studio; job: Job }): ReactNode {
  const all = useMemo(() => (job.running ? null : listing(job.lines)), [job.running, job.lines])
  const places = usePlaces(all && all.states.length > 0 ? all : null)
  const picked = useStore(studio.jobs.store, (state) => (state.picked?.job === job.id ? state.picked.state : null))
  const [hides, setHides] = useState(false)
  const pick = (state: number | null): void => studio.jobs.pick(job.id, state)
  const told = job.lines.filter((line) => typeof line === 'string' || line['type'] === 'fault' || line['type'] === 'failure')
  const state = picked === null ? undefined : all?.states[picked]
  return (
    <div className="graph">
      <Head studio={studio} job={job} all={all} hides={hides} setHides={setHides} />
      <div className="graph-body">
        {job.running && <p className="graph-note">{words.graph.listing}</p>}
        {all && all.states.length === 0 && <Told lines={told} />}
        {places === 'slow' && <p className="graph-note">{words.graph.slow}</p>}
        {all && places !== null && places !== 'slow' && <GraphPicture all={all} places={places} picked={picked} pick={pick} hides={hides} />}
        {state && all && <Picked all={all} state={state} pick={pick} />}
      </div>
    </div>
  )
}

function Told({ lines }: { lines: (string | Record<string, unknown>)[] }): ReactNode {
  return (
    <ul className="output">
      {lines.map((line, index) => (
        <li key={index} className="bad">
          {typeof line === 'string' ? line : String(line['message'])}
        </li>
      ))}
    </ul>
  )
}

function Head({ studio, job, all, hides, setHides }: { studio: Studio; job: Job; all: Listing | null; hides: boolean; setHides: (hides: boolean) => void }): ReactNode {
  const asked = ((job.options as { where?: string[] }).where ?? [])[0] ?? ''
  const [term, setTerm] = useState(asked)
  const isFormer = useStore(studio.currency.store, (state) => state.changed.has(job.id))
  const again = (event?: FormEvent): void => {
    event?.preventDefault()
    askAgain(studio, { ...job, options: term.trim() === '' ? {} : { where: [term.trim()] } })
  }
  const count = all?.states.filter((state) => state.holds?.[0] === true).length ?? 0
  return (
    <header className="row graph-head">
      <h3>
        {words.graph.title} <span className="faint">{job.file.path.split('/').at(-1)}</span>
      </h3>
      {all?.end && <span className={all.end.complete ? 'faint' : 'graph-open'}>{words.graph.size(all.end.states, all.end.steps, all.end.complete, all.end.reason ?? '')}</span>}
      {all && all.end === null && all.states.length > 0 && <span className="graph-open">{words.graph.stopped}</span>}
      <Currency studio={studio} job={job} />
      <span className="grow" />
      {asked !== '' && all && <span className="faint">{words.graph.where(count)}</span>}
      <form onSubmit={again}>
        <input className="mono" type="search" aria-label={words.graph.term} placeholder={words.graph.termHint} value={term} onChange={(event) => setTerm(event.target.value)} />
      </form>
      {asked !== '' && (
        <label className="tick">
          <input type="checkbox" checked={hides} onChange={(event) => setHides(event.target.checked)} />
          {words.graph.hide}
        </label>
      )}
      {job.running ? (
        <button className="small" onClick={() => void studio.jobs.stop(job.id)}>
          <Icon name="stop" size={13} />
          {words.check.stop}
        </button>
      ) : (
        <button className={`small${isFormer ? ' primary' : ''}`} onClick={() => again()}>
          <Icon name="restart" size={13} />
          {words.check.again}
        </button>
      )}
    </header>
  )
}

// A state with the steps from it and to it; a click goes there.
function Picked({ all, state, pick }: { all: Listing; state: ListedState; pick: (state: number | null) => void }): ReactNode {
  const before = all.states.filter((other) => other.steps.some((step) => step.to === state.state))
  const how = (step: ListedState['steps'][number]): string =>
    [...(step.inputs ?? []).map(([location, value]) => `${location} = ${value}`), ...(step.choices ?? [])].join(', ')
  return (
    <section className="graph-state" aria-label={words.graph.state(state.state)}>
      <header className="row">
        <h3>{words.graph.state(state.state)}</h3>
        <span className="grow" />
        <button className="quiet" aria-label={words.shell.dismiss} onClick={() => pick(null)}>
          <Icon name="close" size={13} />
        </button>
      </header>
      <div className="scroll" tabIndex={0}>
        {(state.violated ?? []).map((name) => (
          <p key={name} className="note bad">
            {words.graph.violates(name)}
          </p>
        ))}
        {!state.whole && <p className="note warning">{words.graph.notWhole}</p>}
        <table>
          <tbody>
            {state.values.map(([location, value]) => (
              <tr key={location}>
                <th scope="row">{location}</th>
                <td>{value}</td>
              </tr>
            ))}
          </tbody>
        </table>
        <h4>{words.graph.from}</h4>
        <ul>
          {state.steps.map((step, index) => (
            <li key={index}>
              {step.to === null ? <span className="bad">{step.fault}</span> : <button onClick={() => pick(step.to)}>{words.graph.state(step.to)}</button>}
              <code>{how(step)}</code>
              {step.ways > 1 && <span className="faint">{words.graph.ways(step.ways)}</span>}
            </li>
          ))}
        </ul>
        <h4>{words.graph.to}</h4>
        <ul className="graph-before">
          {before.slice(0, 200).map((other) => (
            <li key={other.state}>
              <button onClick={() => pick(other.state)}>{words.graph.state(other.state)}</button>
            </li>
          ))}
        </ul>
      </div>
    </section>
  )
}
