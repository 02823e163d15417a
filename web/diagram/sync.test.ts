// A model of the server and of somebody else who writes: whatever comes in what order, no text is lost, and in the end all agree.

import { expect, test } from 'vitest'

import type { Written } from './protocol'
import { type Effect, type Sync, type SyncEvent, isAtRisk, opened, status, turn, writeAfter } from './sync'
import { random } from './testing'
import { applied, difference, rebased } from './text'

class Disk {
  text: string
  private known = new Map<string, string>()

  constructor(text: string) {
    this.text = text
    this.note(text)
  }

  private note(text: string): string {
    const hash = `#${text}`
    this.known.set(hash, text)
    return hash
  }

  get hash(): string {
    return this.note(this.text)
  }

  write(text: string, base: string | null): Written {
    if (base === this.hash || text === this.text) {
      this.text = text
      return { hash: this.hash }
    }
    const from = this.known.get(base ?? '')
    const changes = from === undefined ? null : rebased(difference(from, text), difference(from, this.text))
    if (!changes) return { conflict: { hash: this.hash, theirs: this.text, merged: `<<<${text}|${this.text}>>>` } }
    this.text = applied(this.text, changes)
    return { hash: this.hash, text: this.text }
  }
}

class Editor {
  text: string
  state: Sync
  scheduled = false
  sent: { text: string; base: string | null } | null = null
  reads = 0

  constructor(disk: Disk) {
    this.text = disk.text
    this.state = opened(disk.text, disk.hash)
  }

  event(event: SyncEvent): void {
    const { state, effects } = turn(this.state, event)
    this.state = state
    for (const effect of effects) this.act(effect)
    expect(this.state.text).toBe(this.text)
  }

  private act(effect: Effect): void {
    if (effect.kind === 'schedule') this.scheduled = true
    if (effect.kind === 'write') this.sent = effect
    if (effect.kind === 'read') this.reads++
    if (effect.kind === 'apply') {
      this.text = applied(this.text, effect.changes)
    }
  }

  type(text: string): void {
    this.text = text
    this.event({ kind: 'edited', text })
  }
}

test('what is typed is written', () => {
  const disk = new Disk('a\nb\n')
  const editor = new Editor(disk)
  editor.type('a\nb!\n')
  expect(status(editor.state)).toBe('unsaved')
  editor.event({ kind: 'due' })
  expect(status(editor.state)).toBe('saving')
  editor.event({ kind: 'written', answer: disk.write(editor.sent!.text, editor.sent!.base) })
  expect(status(editor.state)).toBe('saved')
  expect(disk.text).toBe('a\nb!\n')
})

test('a conflict is shown, and the decision is written over what the file holds', () => {
  const disk = new Disk('a\n')
  const editor = new Editor(disk)
  editor.type('mine\n')
  disk.text = 'theirs\n'
  editor.event({ kind: 'due' })
  editor.event({ kind: 'written', answer: disk.write(editor.sent!.text, editor.sent!.base) })
  expect(status(editor.state)).toBe('conflict')
  expect([editor.text, disk.text]).toEqual(['mine\n', 'theirs\n'])
  editor.event({ kind: 'decided', text: 'both\n' })
  editor.event({ kind: 'written', answer: disk.write(editor.sent!.text, editor.sent!.base) })
  expect([editor.text, disk.text, status(editor.state)]).toEqual(['both\n', 'both\n', 'saved'])
})

test('a file that is gone keeps its text, and is written again when asked', () => {
  const disk = new Disk('a\n')
  const editor = new Editor(disk)
  editor.event({ kind: 'gone' })
  expect(status(editor.state)).toBe('gone')
  editor.type('b\n')
  editor.event({ kind: 'due' })
  expect(editor.sent).toBeNull()
  editor.event({ kind: 'decided', text: editor.text })
  expect(editor.sent).toMatchObject({ text: 'b\n', base: null })
})

test('typing puts a write off for a second at most', () => {
  expect([0, 300, 699, 700, 900, 1000, 5000].map(writeAfter)).toEqual([300, 300, 300, 300, 100, 0, 0])
})

test('what an earlier page could not write is written, or shown beside what the file holds now', () => {
  const disk = new Disk('a\n')
  const same = new Editor(disk)
  same.event({ kind: 'kept', text: 'a\nmine\n', base: disk.hash })
  expect([same.text, status(same.state), same.scheduled, isAtRisk(same.state)]).toEqual(['a\nmine\n', 'unsaved', true, true])
  const other = new Editor(disk)
  other.event({ kind: 'kept', text: 'mine\n', base: '#former\n' })
  expect([other.text, other.state.conflict?.theirs, status(other.state)]).toEqual(['mine\n', 'a\n', 'conflict'])
  other.event({ kind: 'decided', text: 'a\n' })
  expect([other.text, status(other.state), isAtRisk(other.state)]).toEqual(['a\n', 'saved', false])
  const written = new Editor(disk)
  written.event({ kind: 'kept', text: 'a\n', base: '#former\n' })
  expect(status(written.state)).toBe('saved')
})

// 10 000 events in random order: typing, writes from outside, answers that come late, connections that break.
test('the file and the editor agree in the end, and nothing is lost', () => {
  const next = random(3)
  const pick = (count: number): number => Math.floor(next() * count)
  for (let round = 0; round < 250; round++) {
    const disk = new Disk('0\n1\n2\n3\n4\n5\n6\n7\n')
    const editor = new Editor(disk)
    const mine = new Set<string>()
    const theirs = new Set<string>()
    let answer: Written | null = null
    let count = 0
    // Lines are added behind fixed ones: the user's behind even ones, those from outside behind odd ones.
    const added = (text: string, half: 0 | 1, mark: string): string => {
      const at = text.indexOf(`${2 * pick(4) + half}\n`) + 2
      return `${text.slice(0, at)}${mark}\n${text.slice(at)}`
    }
    for (let event = 0; event < 40; event++) {
      switch (pick(6)) {
        case 0: {
          const mark = `m${count++}`
          mine.add(mark)
          editor.type(added(editor.text, 0, mark))
          break
        }
        case 1: {
          const mark = `t${count++}`
          theirs.add(mark)
          disk.text = added(disk.text, 1, mark)
          if (pick(2) === 0) editor.event({ kind: 'seen', hash: disk.hash, text: disk.text })
          break
        }
        case 2:
          editor.event({ kind: 'due' })
          break
        case 3:
          if (editor.sent && !answer) answer = disk.write(editor.sent.text, editor.sent.base)
          break
        case 4:
          if (answer) {
            editor.sent = null
            editor.event({ kind: 'written', answer })
            answer = null
          }
          break
        case 5:
          if (pick(6) === 0) {
            editor.event({ kind: 'offline' })
            editor.sent = null
            answer = null
            editor.event({ kind: 'online' })
          }
      }
    }
    for (let rest = 0; rest < 12 && editor.state.conflict === null; rest++) {
      if (editor.sent) {
        const last = answer ?? disk.write(editor.sent.text, editor.sent.base)
        answer = null
        editor.sent = null
        editor.event({ kind: 'written', answer: last })
      }
      editor.event({ kind: 'seen', hash: disk.hash, text: disk.text })
      editor.event({ kind: 'due' })
    }
    if (editor.state.conflict) {
      // Both are still there, one on each side.
      for (const mark of mine) expect(editor.text).toContain(`${mark}\n`)
      for (const mark of theirs) expect(disk.text).toContain(`${mark}\n`)
      continue
    }
    expect(editor.text).toBe(disk.text)
    expect(status(editor.state)).toBe('saved')
    for (const mark of [...mine, ...theirs]) expect(disk.text).toContain(`${mark}\n`)
  }
})
