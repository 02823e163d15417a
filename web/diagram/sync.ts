// Keeping a text and its file the same: what to write, when, and what to do when the file was changed by someone else.
//
// In: events (the text was edited, a write was answered, the file changed outside). Out: the next state, and what the shell
// has to do. INVARIANT: no text is dropped that only the file or only the editor holds. A text that is not the file's is
// written with the hash of what it began from, so the server sees each change made outside and merges or refuses.

import type { Conflict, Written } from './protocol'
import { type Change, applied, difference, rebased } from './text'

export interface Sync {
  // The text in the editor.
  text: string
  // What the file held when it was last seen, and its hash; null while the file does not exist.
  base: string | null
  baseText: string
  // What is being written.
  sent: string | null
  // The file changed while a write was on its way.
  passed: boolean
  conflict: Conflict | null
  gone: boolean
  failure: string | null
  online: boolean
}

export type SyncEvent =
  | { kind: 'edited'; text: string }
  | { kind: 'due' }
  | { kind: 'written'; answer: Written }
  | { kind: 'failed'; message: string }
  | { kind: 'seen'; hash: string; text: string }
  | { kind: 'gone' }
  | { kind: 'offline' }
  | { kind: 'online' }
  | { kind: 'decided'; text: string }
  // What an earlier page could not write, and the hash of what it may be written over.
  | { kind: 'kept'; text: string; base: string | null }

export type Effect =
  | { kind: 'write'; text: string; base: string | null }
  | { kind: 'apply'; changes: Change[] }
  | { kind: 'schedule' }
  | { kind: 'read' }

export type Status = 'saved' | 'unsaved' | 'saving' | 'conflict' | 'gone' | 'failed' | 'offline'

export interface Turn {
  state: Sync
  effects: Effect[]
}

export const opened = (text: string, hash: string): Sync => ({
  text,
  base: hash,
  baseText: text,
  sent: null,
  passed: false,
  conflict: null,
  gone: false,
  failure: null,
  online: true,
})

export const isDirty = (state: Sync): boolean => state.gone || state.text !== state.baseText

export function status(state: Sync): Status {
  if (state.conflict) return 'conflict'
  if (state.gone) return 'gone'
  if (state.failure !== null) return 'failed'
  if (!state.online) return 'offline'
  if (state.sent !== null) return 'saving'
  return isDirty(state) ? 'unsaved' : 'saved'
}

const stay = (state: Sync, ...effects: Effect[]): Turn => ({ state, effects })

export function turn(state: Sync, event: SyncEvent): Turn {
  switch (event.kind) {
    case 'edited':
      if (event.text === state.text) return stay(state)
      return stay({ ...state, text: event.text, failure: null }, { kind: 'schedule' })
    case 'due':
      return write(state)
    case 'written':
      return written(state, event.answer)
    case 'failed':
      return stay({ ...state, sent: null, failure: event.message })
    case 'seen':
      return seen(state, event.hash, event.text)
    case 'gone':
      return stay({ ...state, gone: true, base: null })
    case 'offline':
      return stay({ ...state, online: false, sent: null, passed: false })
    case 'online':
      return stay({ ...state, online: true, failure: null }, { kind: 'read' })
    case 'decided':
      return decided(state, event.text)
    case 'kept':
      return restored(state, event.text, event.base)
  }
}

// LIMIT: how long a text rests before it is written, and how long typing may put that off.
const REST_MS = 300
const MOST_MS = 1000

// How long to wait with a write that has waited so long already.
export const writeAfter = (waited: number): number => Math.max(0, Math.min(REST_MS, MOST_MS - waited))

// Whether closing the page could lose something of a text, or of what the file holds instead.
export const isAtRisk = (state: Sync): boolean => state.conflict !== null || isDirty(state)

function write(state: Sync): Turn {
  const idle = state.online && state.sent === null && !state.conflict && !state.gone
  if (!idle || state.text === state.baseText) return stay(state)
  return stay({ ...state, sent: state.text, failure: null }, { kind: 'write', text: state.text, base: state.base })
}

function written(state: Sync, answer: Written): Turn {
  const sent = state.sent
  if (sent === null) return stay(state)
  const next: Sync = { ...state, sent: null, passed: false, failure: null }
  // Whether what passed came before or after the write, only the file tells.
  const look: Effect[] = state.passed ? [{ kind: 'read' }] : []
  if (answer.conflict) return stay({ ...next, conflict: answer.conflict }, ...look)
  next.gone = false
  if (answer.text === undefined || answer.text === sent) {
    next.base = answer.hash
    next.baseText = sent
    if (next.text !== sent) look.push({ kind: 'schedule' })
    return stay(next, ...look)
  }
  const changes = rebased(difference(sent, answer.text), difference(sent, next.text))
  // Typed over what was merged: the text goes on from its old base, and the server merges once more.
  if (!changes) return stay(next, ...look, { kind: 'schedule' })
  next.base = answer.hash
  next.baseText = answer.text
  next.text = applied(next.text, changes)
  const effects: Effect[] = [{ kind: 'apply', changes }, ...look]
  if (next.text !== next.baseText) effects.push({ kind: 'schedule' })
  return stay(next, ...effects)
}

function seen(state: Sync, hash: string, text: string): Turn {
  if (state.sent !== null) return stay({ ...state, passed: true })
  if (hash === state.base && !state.gone) return isDirty(state) ? stay(state, { kind: 'schedule' }) : stay(state)
  if (text === state.text) return stay({ ...state, base: hash, baseText: text, gone: false, conflict: null })
  if (state.text === state.baseText && !state.conflict) {
    const changes = difference(state.text, text)
    return stay({ ...state, text, base: hash, baseText: text, gone: false }, { kind: 'apply', changes })
  }
  if (state.gone) {
    // It came back otherwise than it went: both texts are shown.
    return stay({ ...state, gone: false, conflict: { hash, theirs: text, merged: text } })
  }
  if (state.conflict) return stay({ ...state, conflict: { ...state.conflict, hash, theirs: text } })
  return stay(state, { kind: 'schedule' })
}

function decided(state: Sync, text: string): Turn {
  const base = state.conflict ? state.conflict.hash : state.base
  const baseText = state.conflict ? state.conflict.theirs : state.baseText
  const effects: Effect[] = []
  if (text !== state.text) effects.push({ kind: 'apply', changes: difference(state.text, text) })
  const next: Sync = { ...state, text, base, baseText, conflict: null, failure: null }
  if (text === baseText && !state.gone) return stay(next, ...effects)
  return stay({ ...next, sent: text }, ...effects, { kind: 'write', text, base })
}

function restored(state: Sync, text: string, base: string | null): Turn {
  if (text === state.text || state.base === null) return stay(state)
  const apply: Effect = { kind: 'apply', changes: difference(state.text, text) }
  if (base === state.base) return stay({ ...state, text }, apply, { kind: 'schedule' })
  // The file is another one since: both are shown.
  return stay({ ...state, text, conflict: { hash: state.base, theirs: state.baseText, merged: state.baseText } }, apply)
}
