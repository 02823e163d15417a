// Marks in the text that the text itself does not have: what is selected on the canvas, what a step of a run wrote.
//
// Owns: a state field of line and stretch decorations, replaced by effects and carried along by edits.

import { type Extension, StateEffect, StateField } from '@codemirror/state'
import { Decoration, type DecorationSet, EditorView } from '@codemirror/view'

export interface Mark {
  from: number
  to: number
  kind: 'picked' | 'changed' | 'same' | 'fault' | 'next' | 'break'
}

export const setPicked = StateEffect.define<Mark[]>()
export const setRan = StateEffect.define<Mark[]>()

function decorations(marks: readonly Mark[], length: number): DecorationSet {
  const ranges = marks
    .filter((mark) => mark.from <= length)
    .map((mark) => {
      const to = Math.min(mark.to, length)
      return mark.kind === 'picked' && to > mark.from
        ? Decoration.mark({ class: 'cm-picked' }).range(mark.from, to)
        : null
    })
    .filter((range) => range !== null)
  return Decoration.set(ranges, true)
}

const picked = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(value, transaction) {
    let next = value.map(transaction.changes)
    for (const effect of transaction.effects)
      if (effect.is(setPicked)) next = decorations(effect.value, transaction.newDoc.length)
    return next
  },
  provide: (field) => EditorView.decorations.from(field),
})

const ran = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(value, transaction) {
    let next = value.map(transaction.changes)
    for (const effect of transaction.effects) {
      if (!effect.is(setRan)) continue
      const lines = new Map<number, string>()
      for (const mark of effect.value) {
        if (mark.from > transaction.newDoc.length) continue
        const line = transaction.newDoc.lineAt(mark.from)
        // A fault counts more than what is next, that more than what changed.
        const known = lines.get(line.from)
        if (!known || known === 'same' || mark.kind === 'fault') lines.set(line.from, mark.kind)
      }
      next = Decoration.set(
        [...lines].map(([from, kind]) => Decoration.line({ class: `cm-ran cm-ran-${kind}` }).range(from)),
        true,
      )
    }
    return next
  },
  provide: (field) => EditorView.decorations.from(field),
})

export const marks: Extension = [picked, ran]
