// The times of a system as its text is now: the table beside the picture, made anew with each change.
//
// In: the chart in front. Out: the table of the analysis, and fields for what belongs to the system as a whole. While a text has a fault
// the last table stays, and is called so.

import { type ReactNode, useEffect, useState } from 'react'

import { words } from '../words'
import type { Chart, ChartState } from './chart'
import type { SystemTimes } from './jobs'
import { Store, useStore } from './store'
import type { Studio } from './studio'
import { SystemNumbers } from './SystemFields'
import { TimesTables } from './TimesTable'

type Shown = Pick<ChartState, 'pictures'>
const NO_CHART = new Store<Shown>({ pictures: null })

// The chart in front, if its pictures have a system.
export function useSystem(studio: Studio): Chart | null {
  const active = useStore(studio.store, (state) => state.active)
  useStore(studio.store, (state) => state.opened)
  const chart = studio.chart(active)
  const has = useStore<Shown, boolean>(chart?.store ?? NO_CHART, (state) => (state.pictures?.drawings ?? []).some((drawing) => drawing.kind === 'system'))
  return chart && has ? chart : null
}

interface Known {
  times: SystemTimes | null
  // Why there is no table of the text as it is.
  reason: string | null
}

function useTimes(studio: Studio, chart: Chart): Known {
  const pictures = useStore(chart.store, (state) => state.pictures)
  const stale = useStore(chart.store, (state) => state.stale)
  const [known, setKnown] = useState<Known>({ times: null, reason: null })
  useEffect(() => {
    let gone = false
    const ask = async (): Promise<void> => {
      try {
        const times = await studio.ask<SystemTimes | null>('groundstate/chart/times', { textDocument: { uri: chart.doc.file.uri } })
        if (!gone) setKnown({ times, reason: null })
      } catch (error) {
        if (!gone) setKnown((before) => ({ times: before.times, reason: (error as Error).message }))
      }
    }
    void ask()
    return () => {
      gone = true
    }
  }, [studio, chart, pictures, stale])
  return known
}

export function TimesPanel({ studio, chart }: { studio: Studio; chart: Chart }): ReactNode {
  const { times, reason } = useTimes(studio, chart)
  const drawing = useStore(chart.store, (state) => state.pictures?.drawings.find((drawing) => drawing.kind === 'system') ?? null)
  return (
    <div className="times-panel scroll" tabIndex={0}>
      {drawing?.system && (
        <section aria-label={words.system.numbers}>
          <SystemNumbers studio={studio} chart={chart} id={drawing.name} system={drawing.system} />
        </section>
      )}
      <div className={reason === null ? 'times-now' : 'times-now stale'} tabIndex={0}>
        {reason !== null && (
          <p className="note warning" role="status">
            {times ? words.system.former : words.system.noTimes} {reason}
          </p>
        )}
        {times?.told?.map((sentence) => (
          <p key={sentence} className="note warning">
            {sentence}
          </p>
        ))}
        {times && <TimesTables all={[times]} />}
      </div>
    </div>
  )
}
