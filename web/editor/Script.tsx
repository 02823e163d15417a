// A scenario that is in no file, line by line; the one that comes next is marked and in view.
//
// In: its text, and where the session is in it. It shows, and does nothing.

import { type ReactNode, useEffect, useRef } from 'react'

import type { SessionState } from '../diagram/protocol'
import { words } from '../words'

export function Script({ text, uri, session }: { text: string; uri: string; session: SessionState }): ReactNode {
  const next = useRef<HTMLLIElement>(null)
  const range = session.next?.range ?? null
  const failed = new Set(session.faults.filter(({ at }) => at.uri === uri).map(({ at }) => at.range.start.line))
  useEffect(() => {
    next.current?.scrollIntoView({ block: 'nearest' })
  }, [range?.start.line])
  return (
    <section className="script" aria-label={words.run.script}>
      <h3>{words.run.script}</h3>
      <ol tabIndex={0}>
        {text.trimEnd().split('\n').map((line, index) => {
          const now = range !== null && range.start.line <= index && index <= range.end.line
          return (
            <li key={index} ref={now ? next : undefined} aria-current={now ? 'step' : undefined} className={now ? 'next' : failed.has(index) ? 'failed' : undefined}>
              {line === '' ? '\u00a0' : line}
            </li>
          )
        })}
      </ol>
    </section>
  )
}
