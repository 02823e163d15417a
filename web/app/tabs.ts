// Keys in a row of tabs: arrows go from tab to tab; Enter opens the one that has the focus.

import type { KeyboardEvent } from 'react'

export function tabKey(event: KeyboardEvent<HTMLElement>): void {
  const tabs = [...event.currentTarget.querySelectorAll<HTMLElement>('[role=tab]')]
  const at = tabs.indexOf(document.activeElement as HTMLElement)
  const to = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: tabs.length - 1 }[event.key]
  if (at < 0 || to === undefined) return
  event.preventDefault()
  tabs.at(to % tabs.length)?.focus()
}
