// The run: controls, inputs by their domains, the table of the state, what changed, faults, breakpoints.
//
// In: the runner's store. Out: its methods. It computes nothing of the model.

import { type FormEvent, type ReactNode, useCallback, useMemo, useState, useSyncExternalStore } from 'react'

import { rows, stateOf } from '../diagram/light'
import type { File, SessionState } from '../diagram/protocol'
import { words } from '../words'
import { Icon } from './icons'
import { buildFirst, lastName, runOf, withModel } from './ofChart'
import type { RecordedInputs, Runner, RunState } from './run'
import { Script } from './Script'
import { AskedNumber, RecordedStart, SLIDES, Slider, slides } from './inputs'
import { useStore } from './store'
import type { Studio } from './studio'

// What runs when a file is in front: itself, or a chart's model.
export function runnable(studio: Studio, uri: string | null): { file: File | null; missing: string | null } {
  const file = uri === null ? undefined : studio.file(uri)
  if (!file) return { file: null, missing: null }
  if (file.kind === 'model' || file.kind === 'scenario') return { file, missing: null }
  if (file.kind !== 'chart') return { file: null, missing: null }
  const model = studio.sibling(file, 'asm')
  return model ? { file: model, missing: null } : { file: null, missing: file.path.replace(/\.chart$/, '.asm') }
}

// Whether what is in front is what runs; another file that could run means a new run.
export function runsInFront(studio: Studio): boolean {
  const { session, file } = studio.runner.store.get()
  const front = runnable(studio, studio.store.get().active)
  return session !== null && (front.file === null ? front.missing === null : front.file.uri === file?.uri)
}

export async function startRun(studio: Studio, seed: number | null = null, recorded: RecordedInputs | null = null): Promise<void> {
  const { active } = studio.store.get()
  const { file, missing } = runnable(studio, active)
  const front = active === null ? undefined : studio.file(active)
  if (file && front?.kind === 'chart') await withModel(studio, runOf(studio, front, seed, recorded))
  else if (file) await studio.runner.open(file, seed, recorded)
  else if (missing !== null && active !== null) studio.store.set({ panel: 'run' })
  else studio.tell(words.run.notRunnable, 'refused')
}

export function RunPanel({ studio }: { studio: Studio }): ReactNode {
  const run = useStore(studio.runner.store, (state) => state)
  const active = useStore(studio.store, (state) => state.active)
  useStore(studio.store, (state) => state.files)
  if (!run.session || !run.file) return <Start studio={studio} active={active} busy={run.busy} />
  return <Running studio={studio} run={run} session={run.session} file={run.file} />
}

function Start({ studio, active, busy }: { studio: Studio; active: string | null; busy: boolean }): ReactNode {
  const { file, missing } = runnable(studio, active)
  const front = active === null ? undefined : studio.file(active)
  return (
    <div className="panel-empty tall">
      <h3>{words.run.none}</h3>
      <p>{missing !== null ? words.run.noModel(missing) : file ? words.run.noneHint : words.run.notRunnable}</p>
      <div className="row">
        {file && (
          <button className="primary" disabled={busy} onClick={() => void startRun(studio)}>
            <Icon name="play" />
            {words.run.startModel(file.path.split('/').at(-1) ?? file.path)}
          </button>
        )}
        {file?.kind === 'model' && <RecordedStart studio={studio} file={file} busy={busy} begin={(inputs) => void startRun(studio, null, inputs)} />}
        {file?.kind === 'model' && !studio.hello.readOnly && (
          <button disabled={busy} onClick={() => void startRun(studio, 1)}>
            {words.run.random}
          </button>
        )}
        {missing !== null && front && (
          <button className="primary" disabled={busy} onClick={() => void buildFirst(studio, runOf(studio, front))}>
            <Icon name="hammer" />
            {words.run.build}
          </button>
        )}
      </div>
    </div>
  )
}

// Whether the chart is another one than when the run of its model began.
function useChartChanged(studio: Studio, run: RunState): boolean {
  const chart = studio.doc(run.of?.chart.uri ?? null)
  const subscribe = useCallback((told: () => void) => chart?.store.subscribe(told) ?? (() => undefined), [chart])
  const text = useSyncExternalStore(subscribe, () => chart?.store.get().sync.text ?? null)
  const begun = run.of?.text ?? null
  return begun !== null && text !== null && text !== begun
}

function Running({ studio, run, session, file }: { studio: Studio; run: RunState; session: SessionState; file: File }): ReactNode {
  const { runner } = studio
  const chartChanged = useChartChanged(studio, run)
  return (
    <div className="run">
      <div className="run-control">
        <Controls studio={studio} run={run} session={session} />
        <p className="run-what">
          <button className="link-button" onClick={() => void studio.open(file.uri)}>
            {file.path.split('/').at(-1)}
          </button>
          {run.of?.isOlder && <span className="outcome unknown">{words.older.model}</span>}
          <span className="run-step">{words.run.stepNumber(session.step)}</span>
          <span className={`run-wait ${session.waiting}`}>
            {session.waiting === 'nothing' && session.word ? session.word : words.run.waits[session.waiting]}
          </span>
        </p>
        {(session.stale || chartChanged) && (
          <p className="note warning">
            {session.stale ? words.run.stale : words.run.chartStale(lastName(run.of?.chart.path ?? ''))}{' '}
            <button className="link-button" onClick={() => void runner.restart()}>
              {words.run.again}
            </button>
          </p>
        )}
        {run.recorded !== null && <p className="note">{words.run.recordedFrom(run.recorded.name.split('/').at(-1) ?? '')}</p>}
        {run.broke !== null && <p className="note">{words.run.broke(run.broke)}</p>}
        {run.script !== null && <Script text={run.script} uri={run.scriptUri} session={session} />}
        <Asked runner={runner} run={run} session={session} />
        <Inputs runner={runner} run={run} />
        <Breaks runner={runner} run={run} />
      </div>
      <Table session={session} />
      <Changes studio={studio} session={session} />
    </div>
  )
}

function Controls({ studio, run, session }: { studio: Studio; run: RunState; session: SessionState }): ReactNode {
  const { runner } = studio
  const can = session.waiting === 'step' && !run.playing
  const button = (icon: string, title: string, act: () => void, enabled: boolean, main = false): ReactNode => (
    <button className={main ? 'primary square' : 'square'} title={title} aria-label={title} disabled={!enabled} onClick={act}>
      <Icon name={icon} />
    </button>
  )
  return (
    <div className="row controls" role="toolbar" aria-label={words.run.title}>
      {run.playing
        ? button('pause', words.run.pause, () => runner.pause(), true, true)
        : button('play', words.run.play, () => runner.play(), session.waiting === 'step', true)}
      {button('step', words.run.step, () => void runner.step(), can)}
      {button('back', words.run.back, () => void runner.back(), session.step > 0 || session.waiting !== 'step' || session.next !== null)}
      {button('restart', words.run.restart, () => void runner.restart(), true)}
      <select aria-label={words.run.speed} title={words.run.speed} value={run.speed} onChange={(event) => runner.setSpeed(Number(event.target.value))}>
        {[1, 4, 15, 0].map((speed) => (
          <option key={speed} value={speed}>
            {words.run.speeds[speed]}
          </option>
        ))}
      </select>
      <span className="grow" />
      {button('record', run.script === null ? words.run.record : words.run.keepScript, () => void runner.record(), (session.step > 0 || run.script !== null) && run.file?.kind === 'model' && !studio.hello.readOnly)}
      {button('close', words.run.close, () => void runner.close(), true)}
    </div>
  )
}

function Asked({ runner, run, session }: { runner: Runner; run: RunState; session: SessionState }): ReactNode {
  const [keep, setKeep] = useState(true)
  const [text, setText] = useState('')
  if (session.waiting !== 'input' && session.waiting !== 'choice') return null
  const location = session.word ?? ''
  const give = (value: string): void => {
    setText('')
    if (keep) void runner.set(location, value)
    else void runner.answer(value)
  }
  const submit = (event: FormEvent): void => {
    event.preventDefault()
    if (text.trim() !== '') give(text.trim())
  }
  if (session.waiting === 'choice') {
    return (
      <fieldset className="asked" disabled={run.busy}>
        <legend>{location ? words.run.chooses(location) : words.run.chooseAny}</legend>
        <div className="offers">
          {session.offered.map((offer, index) => (
            <button key={index} onClick={() => void runner.choose(index)}>
              {offer}
            </button>
          ))}
        </div>
      </fieldset>
    )
  }
  return (
    <fieldset className="asked" disabled={run.busy}>
      <legend>{words.run.asks(location)}</legend>
      {session.bounds && session.bounds[1] - session.bounds[0] >= SLIDES && <AskedNumber location={location} bounds={session.bounds} give={give} />}
      {slides(session.bounds) ? null : session.offered.length > 0 && session.offered.length <= 12 && (
        <div className="offers">
          {session.offered.map((offer) => (
            <button key={offer} onClick={() => give(offer)}>
              {offer}
            </button>
          ))}
        </div>
      )}
      {!slides(session.bounds) && session.offered.length > 12 && (
        <select aria-label={location} value="" onChange={(event) => give(event.target.value)}>
          <option value="" disabled>
            {words.run.value}
          </option>
          {session.offered.map((offer) => (
            <option key={offer}>{offer}</option>
          ))}
        </select>
      )}
      {session.offered.length === 0 && (
        <form className="row" onSubmit={submit}>
          <input className="mono" aria-label={location} value={text} placeholder={words.run.value} onChange={(event) => setText(event.target.value)} />
          <button type="submit">{words.run.give}</button>
        </form>
      )}
      <label className="tick">
        <input type="checkbox" checked={keep} onChange={(event) => setKeep(event.target.checked)} />
        {words.run.keep}
      </label>
    </fieldset>
  )
}

// Inputs that keep their values: switches for truth values, fields for the rest.
function Inputs({ runner, run }: { runner: Runner; run: RunState }): ReactNode {
  if (run.sets.size === 0) return null
  return (
    <section className="inputs" aria-label={words.run.inputs}>
      <h3>{words.run.inputs}</h3>
      {[...run.sets].map(([location, value]) => (
        <div key={location} className="input-row">
          <code>{location}</code>
          <InputControl location={location} value={value} offers={runner.offers(location)} bounds={runner.bounds(location)} set={(next) => void runner.set(location, next)} />
          <button className="quiet" title={words.run.askAgain} aria-label={words.run.askAgain} onClick={() => void runner.set(location, null)}>
            <Icon name="question" size={14} />
          </button>
        </div>
      ))}
    </section>
  )
}

function InputControl({ location, value, offers, bounds, set }: { location: string; value: string; offers: string[]; bounds: [number, number] | null; set: (value: string) => void }): ReactNode {
  if (bounds && slides(bounds) && /^-?\d+$/.test(value)) return <Slider location={location} value={Number(value)} bounds={bounds} done={(next) => set(String(next))} />
  if (value === 'true' || value === 'false') {
    return (
      <button role="switch" aria-checked={value === 'true'} aria-label={location} className="switch bare" onClick={() => set(value === 'true' ? 'false' : 'true')}>
        <span className="switch-value">{value}</span>
        <span className="track" aria-hidden="true">
          <span className="thumb" />
        </span>
      </button>
    )
  }
  if (offers.length > 1) {
    return (
      <select aria-label={location} value={value} onChange={(event) => set(event.target.value)}>
        {(offers.includes(value) ? offers : [value, ...offers]).map((offer) => (
          <option key={offer}>{offer}</option>
        ))}
      </select>
    )
  }
  return (
    <input
      className="mono"
      aria-label={location}
      key={value}
      defaultValue={value}
      onKeyDown={(event) => event.key === 'Enter' && event.currentTarget.blur()}
      onBlur={(event) => event.target.value.trim() !== value && event.target.value.trim() !== '' && set(event.target.value.trim())}
    />
  )
}

function Breaks({ runner, run }: { runner: Runner; run: RunState }): ReactNode {
  const [text, setText] = useState('')
  return (
    <section className="inputs breaks" aria-label={words.run.breakpoints}>
      <h3>{words.run.breakpoints}</h3>
      {run.breaks.map((term) => (
        <div key={term} className={`input-row${run.broke === term ? ' hit' : ''}`}>
          <span className="break-dot" aria-hidden="true" />
          <code>{term}</code>
          <button className="quiet" aria-label={words.shell.dismiss} onClick={() => runner.toggleBreak(term)}>
            <Icon name="close" size={14} />
          </button>
        </div>
      ))}
      <form
        onSubmit={(event) => {
          event.preventDefault()
          const term = text.trim()
          if (term !== '' && !run.breaks.includes(term)) runner.toggleBreak(term)
          setText('')
        }}
      >
        <input className="mono" aria-label={words.run.addBreak} placeholder={words.run.breakHint} value={text} onChange={(event) => setText(event.target.value)} />
      </form>
    </section>
  )
}

const ROWS = 400

function Table({ session }: { session: SessionState }): ReactNode {
  const [filter, setFilter] = useState('')
  const all = useMemo(() => rows(stateOf(session), session.updates, filter), [session, filter])
  return (
    <section className="state-table" aria-label={words.run.state}>
      <header className="row">
        <h3>{words.run.state}</h3>
        <input type="search" aria-label={words.run.filter} placeholder={words.run.filter} value={filter} onChange={(event) => setFilter(event.target.value)} />
      </header>
      <div className="scroll" tabIndex={0}>
        <table>
          <tbody>
            {all.slice(0, ROWS).map((row) => (
              <tr key={`${row.location}${row.before === null ? '' : session.step}`} className={row.before === null ? undefined : 'changed'}>
                <th scope="row" title={row.location}>
                  {row.location}
                </th>
                <td title={row.value}>{row.value}</td>
                <td className="before" title={row.before ?? undefined}>{row.before !== null && row.before !== row.value ? `${words.run.was} ${row.before}` : ''}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  )
}

function Changes({ studio, session }: { studio: Studio; session: SessionState }): ReactNode {
  return (
    <section className="changes" aria-label={words.run.changed}>
      {session.faults.length > 0 && (
        <>
          <h3>{words.run.faults}</h3>
          <ul>
            {session.faults.map((fault, index) => (
              <li key={index}>
                <button className="problem fault-line" onClick={() => void studio.show(fault.at)}>
                  <Icon name="warning" size={14} />
                  <span className="message">{fault.message}</span>
                </button>
              </li>
            ))}
          </ul>
        </>
      )}
      <h3>{words.run.changed}</h3>
      <div className="scroll" tabIndex={0}>
        {session.updates.length === 0 && <p className="faint-note">{session.step === 0 ? words.run.noStep : words.run.noChange}</p>}
        <ul>
          {session.updates.map((update) => (
            <li key={update.location}>
              <button className="change" onClick={() => void studio.show(update.at, false)}>
                <code>{update.location}</code>
                <span className="before">{update.before}</span>
                <Icon name="chevron" size={12} />
                <span className="after">{update.after}</span>
              </button>
            </li>
          ))}
        </ul>
      </div>
    </section>
  )
}
