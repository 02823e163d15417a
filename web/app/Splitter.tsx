// A bar between two panes that is dragged, or moved by the arrow keys.

import type { KeyboardEvent, ReactNode, PointerEvent as ReactPointerEvent } from 'react'

import { words } from '../words'

export interface SplitterProps {
  axis: 'x' | 'y'
  // Its place, in hundredths.
  value: number
  // The share of the parent before the bar.
  resize: (share: number, event: PointerEvent) => void
}

export function Splitter({ axis, value, resize }: SplitterProps): ReactNode {
  const drag = (event: ReactPointerEvent<HTMLDivElement>): void => {
    event.preventDefault()
    const parent = event.currentTarget.parentElement?.getBoundingClientRect()
    if (!parent) return
    document.body.classList.add(`resizing-${axis}`)
    const move = (event: PointerEvent): void =>
      resize(axis === 'x' ? (event.clientX - parent.left) / parent.width : (event.clientY - parent.top) / parent.height, event)
    const up = (): void => {
      document.body.classList.remove(`resizing-${axis}`)
      window.removeEventListener('pointermove', move)
      window.removeEventListener('pointerup', up)
    }
    window.addEventListener('pointermove', move)
    window.addEventListener('pointerup', up)
  }
  const key = (event: KeyboardEvent<HTMLDivElement>): void => {
    const by = { ArrowLeft: -24, ArrowRight: 24, ArrowUp: -24, ArrowDown: 24 }[event.key]
    const parent = event.currentTarget.parentElement?.getBoundingClientRect()
    const own = event.currentTarget.getBoundingClientRect()
    if (by === undefined || !parent) return
    event.preventDefault()
    const [x, y] = [own.left + by, own.top + by]
    resize((x - parent.left) / parent.width, new PointerEvent('pointermove', { clientX: x, clientY: y }))
  }
  return (
    <div
      className={`splitter ${axis}`}
      role="separator"
      tabIndex={0}
      aria-label={words.shell.resize}
      aria-orientation={axis === 'x' ? 'vertical' : 'horizontal'}
      aria-valuenow={value}
      onPointerDown={drag}
      onKeyDown={key}
    />
  )
}
