// The first tour, a minute long: five cards. It comes once, and again when it is asked for.

import { type ReactNode, useEffect, useState } from 'react'

import { words } from '../words'

const KEY = 'groundstate-toured'

export function Tour(): ReactNode {
  const [at, setAt] = useState(-1)
  useEffect(() => {
    const begin = (): void => setAt(0)
    window.addEventListener('groundstate-tour', begin)
    return () => window.removeEventListener('groundstate-tour', begin)
  }, [])
  const step = words.tour.steps[at]
  if (!step) return null
  const end = (): void => {
    localStorage.setItem(KEY, 'yes')
    setAt(-1)
  }
  const last = at === words.tour.steps.length - 1
  return (
    <div className="tour" role="dialog" aria-label={step[0]} onKeyDown={(event) => event.key === 'Escape' && end()}>
      <h2>{step[0]}</h2>
      <p>{step[1]}</p>
      <footer className="row">
        <span className="dots" aria-hidden="true">
          {words.tour.steps.map((_, index) => (
            <i key={index} className={index === at ? 'on' : undefined} />
          ))}
        </span>
        <span className="grow" />
        <button className="quiet wide" onClick={end}>
          {words.tour.skip}
        </button>
        <button key={at} autoFocus className="primary" onClick={() => (last ? end() : setAt(at + 1))}>
          {last ? words.tour.done : words.tour.next}
        </button>
      </footer>
    </div>
  )
}
