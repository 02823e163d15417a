// The panel of the timeline: lanes of tasks, channels and values over the steps of the run.
//
// In: the runner's session. Out: nothing; a click on a step goes there.

import { type ReactNode, useEffect, useRef, useState } from 'react'

import { words } from '../words'
import { useStore } from './store'
import type { Studio } from './studio'
import { type Shown, Timeline } from './timeline'

export function TimelinePanel({ studio }: { studio: Studio }): ReactNode {
  const session = useStore(studio.runner.store, (state) => state.session)
  const host = useRef<HTMLDivElement>(null)
  const timeline = useRef<Timeline | null>(null)
  const [shown, setShown] = useState<Shown>('nothing')
  const runs = session !== null
  useEffect(() => {
    if (!runs || !host.current) return
    const made = new Timeline(studio, host.current, setShown)
    timeline.current = made
    return () => {
      made.end()
      timeline.current = null
    }
  }, [studio, runs])
  useEffect(() => {
    if (session) timeline.current?.at(session)
  }, [session])
  const told = !runs ? words.timeline.none : shown === 'nothing' ? words.timeline.noStep : shown === 'empty' ? words.timeline.empty : null
  const message = typeof shown === 'object' ? shown.refused : told
  return (
    <>
      {(message !== null || !runs) && (
        <div className="panel-empty tall">
          <h3>{words.timeline.title}</h3>
          <p>{message}</p>
        </div>
      )}
      <div ref={host} className="timeline" hidden={!runs || message !== null} role="group" aria-label={words.timeline.title} />
    </>
  )
}
