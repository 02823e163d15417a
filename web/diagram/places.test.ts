// Tests of places in a model and the shapes that they speak of.

import { expect, test } from 'vitest'

import { type Around, meant, shapesAt } from './places'
import type { Drawing } from './protocol'
import { box, drawing } from './testing'

const lamp: Drawing = {
  ...drawing([box('off', 'circle', 0, 0), box('on', 'circle', 0, 0), box('pressed', 'hexagon', 0, 0), { ...box('late', 'hexagon', 0, 0), link: 'timer > 5' }, box('count', 'rectangle', 0, 0)], []),
  name: 'lamp',
  lights: [{ name: 'lamp', term: 'light', shapes: [{ value: 'OFF', shape: 'off' }, { value: 'ON', shape: 'on' }] }],
}

// The parts of a text around its mark, as if each line that begins one were nested in the one before.
function at(...texts: string[]): Around[] {
  return texts.map((text, index) => {
    const inner = texts[index - 1]
    return { text, inner: inner === undefined ? 0 : Math.max(0, text.lastIndexOf(inner)) }
  })
}

const check = (around: Around[], state: string | null, guard: string | null, action: string | null, most: string | null): void => {
  const found = shapesAt([lamp], around)
  expect([found?.state ?? null, found?.guard ?? null, found?.action ?? null, found ? meant(found) : null]).toEqual([state, guard, action, most])
}

test('a test of the control variable names a state, a guard its condition, a rule its action', () => {
  const inner = 'if pressed then r_count[] endif'
  check(at('r_count[]', inner, `if light = OFF then ${inner} endif`), 'off', 'pressed', 'count', 'count')
  check(at(inner, `if light = OFF then ${inner} endif`), 'off', 'pressed', null, 'pressed')
  check(at('skip', `case ON: skip`, `switch light case OFF: r_count[] case ON: skip endswitch`), 'on', null, null, 'on')
  check(at('skip', 'rule r_count = skip'), null, null, 'count', 'count')
  check(at('skip', 'if timer>5 then skip endif', '(light = ON)'), null, 'late', null, 'late')
  check(at('skip', 'if (light = ON and timer > 5) then skip endif'), 'on', null, null, 'on')
})

test('what lies in an else is not in the state that was tested', () => {
  const whole = 'if light = OFF then if pressed then skip else x := 1 endif else y := 2 endif'
  check(at('y := 2', whole), null, null, null, null)
  check(at('x := 1', 'if pressed then skip else x := 1 endif', whole), 'off', 'pressed', null, 'pressed')
  // A word in a comment is no word.
  check(at('x := 1', 'if light = OFF then /* else */ x := 1 endif'), 'off', null, null, 'off')
})

test('the rule around a place is known', () => {
  const inner = 'if light = OFF then r_count[] endif'
  expect(shapesAt([lamp], at('r_count[]', inner, `rule r_lamp = ${inner}`))?.rule).toBe('r_lamp')
  expect(shapesAt([lamp], at('r_count[]', inner))?.rule).toBe(null)
})

test('what no text names has no shape', () => {
  check(at('skip', 'if other = OFF then skip endif'), null, null, null, null)
  check(at('skip', 'if light != OFF then skip endif'), null, null, null, null)
  check(at('skip', 'if light = BROKEN then skip endif', 'rule r_counter = skip'), null, null, null, null)
  check(at('skip', 'case ON: skip', 'switch other case ON: skip endswitch'), null, null, null, null)
  check([], null, null, null, null)
})
