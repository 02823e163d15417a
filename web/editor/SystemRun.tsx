// The run of a system that a check found: lanes of its tasks, what happens in the step that is shown, and what has which value, by part.
//
// In: the drawing of the system, the states of the run, which one is shown. Out: which one is to be shown.

import { type MouseEvent, type ReactNode, useMemo, useState } from 'react'

import type { Frame } from '../diagram/light'
import type { Drawing } from '../diagram/protocol'
import { type Happened, happened, lanesOf, marksOf, partsOf, timeAfter, varying } from '../diagram/systemrun'
import { words } from '../words'
import type { ChartState } from './chart'
import type { Played } from './shown'
import { Read, Row } from './StateRows'
import { Store, useStore } from './store'
import type { Studio } from './studio'

const NO_CHART = new Store<Pick<ChartState, 'pictures'>>({ pictures: null })

// The system whose run is played, as its chart is drawn; null of a model's run, and of a chart that is not open any more.
export function useDrawn(studio: Studio, { job }: Played): Drawing | null {
  useStore(studio.store, (state) => state.opened)
  const chart = job.file.kind === 'chart' ? studio.chart(job.file.uri) : undefined
  return useStore<Pick<ChartState, 'pictures'>, Drawing | null>(chart?.store ?? NO_CHART, (state) => state.pictures?.drawings.find((drawing) => drawing.kind === 'system') ?? null)
}

interface SystemRunProps {
  drawing: Drawing
  frames: readonly Frame[]
  at: number
  go: (at: number) => void
}

export function SystemRun({ drawing, frames, at, go }: SystemRunProps): ReactNode {
  const [first, frame] = [frames[0], frames[at]]
  if (!first || !frame) return null
  return (
    <>
      <Lanes drawing={drawing} frames={frames} at={at} go={go} />
      <Events drawing={drawing} first={first} frame={frame} />
      <Read frame={frame} />
      <Values drawing={drawing} frames={frames} frame={frame} />
    </>
  )
}

const TONES = ['work', 'read', 'write', 'wait'] as const

const percent = (share: number): string => `${(share * 100).toFixed(3)}%`

// A step lasts from the state before it to its own.
function Lanes({ drawing, frames, at, go }: SystemRunProps): ReactNode {
  const lanes = useMemo(() => lanesOf(drawing, frames), [drawing, frames])
  const steps = Math.max(1, frames.length - 1)
  const tick = drawing.system?.tick?.text ?? null
  const picked = (event: MouseEvent<HTMLElement>): void => {
    const { left, width } = event.currentTarget.getBoundingClientRect()
    go(Math.min(steps, Math.max(1, Math.ceil(((event.clientX - left) / width) * steps))))
  }
  return (
    <div className="lanes" role="group" aria-label={words.systemRun.lanes}>
      <div className="lane axis" aria-hidden="true">
        <span />
        <div className="lane-track">
          {marksOf(steps).map((mark) => (
            <span key={mark} style={{ left: percent(mark / steps) }}>
              {timeAfter(frames[mark]?.step ?? mark, tick)}
            </span>
          ))}
        </div>
      </div>
      {lanes.map((lane) => {
        const now = lane.spans.find(({ from, to }) => from <= at && at < to)
        return (
          <div key={lane.id} className="lane">
            <span className="lane-name" title={lane.title}>
              {lane.title}
            </span>
            <div className="lane-track" role="img" aria-label={words.systemRun.lane(lane.title, now?.text ?? null, now?.tone === 'wait')} onClick={picked}>
              {lane.spans.map(({ from, to, tone, text }) => (
                <i key={from} className={tone} style={{ left: percent((from - 1) / steps), width: percent((to - from) / steps) }} title={words.systemRun.span(text, tone === 'wait', timeAfter(frames[from - 1]?.step ?? 0, tick), timeAfter(frames[to - 1]?.step ?? 0, tick))}>
                  <span>{tone === 'wait' ? words.systemRun.tones.wait : text}</span>
                </i>
              ))}
              <b className="now" style={at === 0 ? { left: 0, width: 0 } : { left: percent((at - 1) / steps), width: percent(1 / steps) }} />
            </div>
          </div>
        )
      })}
      <p className="legend" aria-hidden="true">
        {TONES.filter((tone) => lanes.some(({ spans }) => spans.some((span) => span.tone === tone))).map((tone) => (
          <span key={tone}>
            <i className={tone} />
            {words.systemRun.tones[tone]}
          </span>
        ))}
      </p>
    </div>
  )
}

function Events({ drawing, first, frame }: { drawing: Drawing; first: Frame; frame: Frame }): ReactNode {
  const all = useMemo(() => happened(drawing, first, frame), [drawing, first, frame])
  const title = (id: string): string => drawing.picture.boxes.find((box) => box.id === id)?.lines.join(' ') ?? ''
  const isBad = ({ kind }: Happened): boolean => kind === 'misses' || kind === 'too-old' || kind === 'gives-up'
  if (frame === first) return <p className="faint-note">{words.systemRun.begins}</p>
  if (all.length === 0) return <p className="faint-note">{words.systemRun.nothing}</p>
  return (
    <ul className="happened" aria-label={words.systemRun.happens}>
      {all.map((one, index) => (
        <li key={index} className={isBad(one) ? 'bad' : undefined}>
          <b>{title(one.part)}</b> {words.systemRun.kinds[one.kind](one.what)}
        </li>
      ))}
    </ul>
  )
}

function Values({ drawing, frames, frame }: { drawing: Drawing; frames: readonly Frame[]; frame: Frame }): ReactNode {
  const [whole, setWhole] = useState(false)
  const moving = useMemo(() => varying(frames), [frames])
  const [first] = frames
  const parts = useMemo(() => {
    const known = [...(frames.at(-1)?.state.keys() ?? [])].filter((location) => whole || moving.has(location))
    return first ? partsOf(drawing, first, known) : []
  }, [drawing, frames, first, moving, whole])
  return (
    <>
      <table>
        {parts.map((part) => (
          <tbody key={part.id ?? ''}>
            <tr className="part">
              <th colSpan={3} scope="rowgroup">
                {part.title || words.systemRun.rest}
              </th>
            </tr>
            {part.locations.filter((location) => frame.state.has(location)).map((location) => (
              <Row key={location} frame={frame} location={location} />
            ))}
          </tbody>
        ))}
      </table>
      <label className="tick">
        <input type="checkbox" checked={whole} onChange={(event) => setWhole(event.target.checked)} />
        {words.systemRun.whole}
      </label>
    </>
  )
}
