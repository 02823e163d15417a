// A counterexample, step by step; the charts show its state. Of a system it shows what its tasks do and when.
//
// In: the frame that is played, and all of its run. Out: which one is to be played.

import type { ReactNode } from 'react'

import type { Frame } from '../diagram/light'
import { timeAfter } from '../diagram/systemrun'
import { words } from '../words'
import { Icon } from './icons'
import type { Played } from './shown'
import type { Studio } from './studio'
import { Read, Row } from './StateRows'
import { SystemRun, useDrawn } from './SystemRun'

export function Player({ studio, played }: { studio: Studio; played: Played }): ReactNode {
  const { frame, all, verdict, playing } = played
  const { jobs } = studio
  const drawing = useDrawn(studio, played)
  const last = all.length - 1
  const go = (at: number): void => jobs.play(playing.job, playing.check, Math.max(0, Math.min(at, last)))
  const time = drawing ? timeAfter(frame.step, drawing.system?.tick?.text ?? null) : ''
  const claim = drawing ? words.systemRun.claim(verdict.check) : null
  const violates = verdict.kind === 'property' && playing.at === last && (verdict.again_from ?? null) === null
  return (
    <section className={`player${drawing ? ' of-system' : ''}`} aria-label={words.check.counterexample}>
      <header className="row">
        <button className="square" title={words.check.first} aria-label={words.check.first} disabled={playing.at === 0} onClick={() => go(0)}>
          <Icon name="restart" />
        </button>
        <button className="square" title={words.check.previous} aria-label={words.check.previous} disabled={playing.at === 0} onClick={() => go(playing.at - 1)}>
          <Icon name="back" />
        </button>
        <button className="square" title={words.check.next} aria-label={words.check.next} disabled={playing.at >= last} onClick={() => go(playing.at + 1)}>
          <Icon name="step" />
        </button>
        <input type="range" min={0} max={last} value={playing.at} aria-label={words.check.counterexample} onChange={(event) => go(Number(event.target.value))} />
        <span className="run-step">
          {words.run.stepNumber(frame.step)} / {all.at(-1)?.step ?? 0}
          {time !== '' && <span className="run-time">{time}</span>}
        </span>
        <button className="square" title={words.check.leave} aria-label={words.check.leave} onClick={() => jobs.leave()}>
          <Icon name="close" />
        </button>
      </header>
      <div className="scroll" tabIndex={0}>
        {claim !== null && <p className="claim">{words.systemRun.claimed(claim)}</p>}
        {verdict.again_from !== undefined && verdict.again_from !== null && <p className="note">{words.check.repeats(verdict.again_from)}</p>}
        {verdict.omitted?.trace && playing.at === verdict.omitted.trace.after && <p className="note">{words.check.between(verdict.omitted.trace.steps)}</p>}
        {frame.fault !== null && <p className="note bad">{frame.fault}</p>}
        {drawing && violates && frame.fault === null && <p className="note bad">{words.systemRun.violated}</p>}
        {drawing ? <SystemRun drawing={drawing} frames={all} at={playing.at} go={go} /> : <State frame={frame} />}
      </div>
    </section>
  )
}

function State({ frame }: { frame: Frame }): ReactNode {
  return (
    <>
      <Read frame={frame} />
      <table>
        <tbody>
          {[...frame.state.keys()].map((location) => (
            <Row key={location} frame={frame} location={location} />
          ))}
        </tbody>
      </table>
    </>
  )
}
