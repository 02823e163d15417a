// Which shape of a chart a place in its model speaks of.
//
// In: the texts around the place, from the innermost out, and the drawings of the chart. Out: an action, a guard and a state, as far as
// the texts name them: a rule that is an action's, a condition that is a guard's, a test of the control variable. INVARIANT: nothing is
// guessed; what no text names has no shape.

import { controlOf, functionOf } from './light'
import type { Box, Drawing } from './protocol'

// A part of the model's text around a place.
export interface Around {
  text: string
  // Where the next part further in begins in it.
  inner: number
}

export interface Shapes {
  drawing: string
  state: string | null
  guard: string | null
  action: string | null
  // The declared rule around the place.
  rule: string | null
}

const compact = (text: string): string => text.replace(/\s+/g, '')

const CONDITION = /^if\b([\s\S]*?)\bthen\b/
const CASE = /^case\b\s*([A-Za-z_]\w*)\s*:/
const SWITCH = /^switch\b\s*([A-Za-z_]\w*)/
const CALL = /^(r_\w+)\s*[[(]/
const RULE = /^(?:main\s+)?(?:macro\s+)?rule\s+(r_\w+)/

const bare = (text: string): string => text.replace(/\/\*[\s\S]*?\*\/|\/\/[^\n]*/g, (comment) => ' '.repeat(comment.length))

// Whether what begins at `inner` lies in the `else` of a conditional.
function inElse(text: string, inner: number): boolean {
  const until = text.slice(0, inner)
  const start = CONDITION.exec(until)?.[0].length
  if (start === undefined) return false
  let depth = 0
  for (const [word] of until.slice(start).matchAll(/\b(?:if|endif|else)\b/g)) {
    if (word === 'if') depth++
    else if (word === 'endif') depth--
    else if (depth === 0) return true
  }
  return false
}

const stateOf = (drawing: Drawing, value: string): string | null => drawing.lights[0]?.shapes.find((shape) => shape.value === value)?.shape ?? null

// The value that one of the conjuncts gives the control variable.
function tested(condition: string, control: string): string | null {
  for (const part of condition.replace(/^\s*\(|\)\s*$/g, '').split(/\band\b/)) {
    const [left, right, more] = part.split('=')
    if (left === undefined || right === undefined || more !== undefined || /[<>!]\s*$/.test(left)) continue
    const value = /^\s*([A-Za-z_]\w*)\s*\)?\s*$/.exec(right)?.[1]
    if (value !== undefined && functionOf(left.replace(/^[\s(]+/, '')) === functionOf(control)) return value
  }
  return null
}

function isGuard(box: Box, condition: string): boolean {
  if (box.figure !== 'hexagon') return false
  const said = compact(condition).replace(/^\((.*)\)$/, '$1')
  return [said, said.replace(/^not\(?(.*?)\)?$/, '$1')].includes(compact(box.link === null || box.link === '' ? box.id : box.link))
}

const isAction = (box: Box, rule: string): boolean => box.figure === 'rectangle' && (box.link === null || box.link === '' ? `r_${box.id}` === rule : new RegExp(`^\\s*${rule}\\b`).test(box.link))

export function shapesAt(drawings: readonly Drawing[], around: readonly Around[]): Shapes | null {
  const bared = around.map(({ text, inner }) => ({ text: bare(text), inner }))
  let best: Shapes | null = null
  for (const drawing of drawings) {
    const control = controlOf(drawing)
    const found: Shapes = { drawing: drawing.name, state: null, guard: null, action: null, rule: null }
    let value: string | null = null
    for (const { text, inner } of bared) {
      const rule = CALL.exec(text)?.[1] ?? RULE.exec(text)?.[1]
      if (rule !== undefined) found.action ??= drawing.picture.boxes.find((box) => isAction(box, rule))?.id ?? null
      found.rule = RULE.exec(text)?.[1] ?? found.rule
      const condition = CONDITION.exec(text)?.[1]
      if (condition !== undefined) {
        found.guard ??= drawing.picture.boxes.find((box) => isGuard(box, condition))?.id ?? null
        const here = control === null || inElse(text, inner) ? null : tested(condition, control)
        if (here !== null) found.state ??= stateOf(drawing, here)
      }
      value = CASE.exec(text)?.[1] ?? value
      const switched = SWITCH.exec(text)?.[1]
      if (switched === undefined) continue
      if (value !== null && control !== null && switched === functionOf(control)) found.state ??= stateOf(drawing, value)
      value = null
    }
    const known = (shapes: Shapes | null): number => (shapes ? (shapes.state ? 2 : 0) + (shapes.guard || shapes.action ? 1 : 0) : 0)
    if (known(found) > known(best)) best = found
  }
  return best
}

// The shape that is meant most of all.
export const meant = (shapes: Shapes): string | null => shapes.action ?? shapes.guard ?? shapes.state
