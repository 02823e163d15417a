// SYNC(palette): the page's colours are the project's.

import { readFileSync } from 'node:fs'

import { expect, test } from 'vitest'

test('each colour of the palette is in the style sheet as it is', () => {
  const palette = readFileSync(new URL('../../crates/palette/src/lib.rs', import.meta.url), 'utf8')
  const sheet = readFileSync(new URL('../app/colours.css', import.meta.url), 'utf8')
  const table = palette.slice(palette.indexOf('colours! {'))
  const colours = [...table.slice(0, table.indexOf('\n}\n')).matchAll(/"([a-z-]+)" "(#\w{6})" "(#\w{6})"/g)]
  expect(colours.length).toBeGreaterThan(40)
  for (const [, name, light, dark] of colours) expect(sheet).toContain(`--${name}: light-dark(${light}, ${dark});`)
})
