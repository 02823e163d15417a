// Random operations in the browser, with writes of others in between: after each, file, text and picture say the same, and nothing that was
// written is lost.
//
// With GROUNDSTATE_FULL set it goes on for longer. The numbers are the same each time.

import { readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'

import type { Browser, Page } from 'playwright-core'
import { afterAll, beforeAll, expect, test } from 'vitest'

import { random } from '../diagram/testing'
import { type Trouble, opened, page as newPage, shape, shot, text } from './browser'
import { type Served, copied, removed, served } from './served'

const START = `// Kept by all.
chart Random

machine part "Part"
	control phase
	initial state first "First" // here it begins
	state second "Second"
	guard ready "Ready"
	action act "ACT"
	first -> ready yes -> act -> second
	second -> first
	ready no -> first
endmachine
`

const ROUNDS = process.env['GROUNDSTATE_FULL'] ? 400 : 40

let browser: Browser
let studio: Served
let page: Page
const trouble: Trouble = { told: [] }

const path = (): string => join(studio.folder, 'Random.chart')
const file = (): string => readFileSync(path(), 'utf8')

// The shapes that a text declares.
const declared = (text: string): string[] => [...text.matchAll(/^\t(?:initial )?(?:state|guard|action) (\w+)/gm)].map(([, name]) => name ?? '').sort()

const drawn = (): Promise<string[]> => page.evaluate(() => [...document.querySelectorAll('.react-flow__node')].map((node) => node.getAttribute('data-id') ?? '').sort())

beforeAll(async () => {
  studio = await served(copied())
  writeFileSync(path(), START)
  browser = await opened()
  page = await newPage(browser, `${studio.address}#/Random.chart`, trouble)
  // All lines are on the page.
  await page.setViewportSize({ width: 1400, height: 3000 })
  await shape(page, 'first').waitFor()
})

afterAll(async () => {
  await browser?.close()
  studio?.stop()
  if (studio) removed(studio.folder)
})

async function agree(what: string): Promise<string> {
  let told = ''
  for (let tries = 0; tries < 200; tries++) {
    const [here, shown, now] = [await text(page), await drawn(), file()]
    const saved = await page.locator('.state-chip', { hasText: 'Saved' }).isVisible()
    if (saved && now === here && String(declared(now)) === String(shown)) return now
    told = `${what}\nfile:\n${now}\neditor:\n${here}\npicture: ${shown.join(', ')}\nsaved: ${saved}`
    await page.waitForTimeout(50)
  }
  await shot(page, 'failed-agree')
  throw new Error(`they never agreed after ${told}`)
}

test('file, text and picture agree after each operation, whoever writes', async () => {
  const next = random(19)
  const below = (most: number): number => Math.floor(next() * most)
  // What was written outside or typed, and has to be there until it is undone or deleted.
  for (let round = 0; round < ROUNDS; round++) {
    const before = file()
    const names = declared(before)
    const name = names[below(names.length)] ?? 'first'
    const canvas = await page.locator('.canvas').boundingBox()
    if (!canvas) throw new Error('no canvas')
    const somewhere = async (): Promise<void> => page.mouse.click(canvas.x + 90 + below(canvas.width - 420), canvas.y + 60 + below(500))
    const choice = below(7)
    let kept: string | null = null
    const pick = (): Promise<void> => page.locator(`.react-flow__node[data-id="${name}"] .figure`).first().click({ force: true, position: { x: 8, y: 18 } })
    switch (choice) {
      case 0:
        await pick()
        for (let times = below(4); times >= 0; times--) await page.keyboard.press(['ArrowRight', 'ArrowDown', 'ArrowLeft', 'ArrowUp'][below(4)] ?? 'ArrowUp')
        break
      case 1:
        if (names.length > 12) break
        await page.locator('.canvas').focus()
        await page.keyboard.press(['s', 'g', 'a'][below(3)] ?? 's')
        await somewhere()
        break
      case 2:
        if (names.length < 4 || name === 'first') break
        await pick()
        await page.keyboard.press('Delete')
        break
      case 3:
        await page.locator('.canvas').focus()
        await page.keyboard.press(below(3) === 0 ? 'Control+Shift+z' : 'Control+z')
        break
      case 4: {
        // Typed, and at once others write elsewhere: both stay.
        kept = `// typed ${round}`
        await page.locator('.cm-line', { hasText: 'chart Random' }).first().click()
        await page.keyboard.press('End')
        await page.keyboard.type(` ${kept}`)
        writeFileSync(path(), file().replace(/endmachine/, `\t// outside ${round}\nendmachine`))
        break
      }
      case 5:
        kept = `out${round}`
        writeFileSync(path(), before.replace(/\n\tguard|\n\taction|\nendmachine/, (found) => `\n\tstate ${kept} "Out"${found}`))
        break
      default:
        kept = `"Said ${round}"`
        writeFileSync(path(), before.replace(/(initial state \w+) "[^"]*"/, `$1 ${kept}`))
    }
    // Keys that move shapes rest for a moment before the text follows.
    if (choice === 0) await page.waitForTimeout(450)
    const now = await agree(`round ${round}, operation ${choice}`)
    if (kept !== null) expect(now, `round ${round}, operation ${choice}`).toContain(kept)
    if (choice === 4) expect(now).toContain(`// outside ${round}`)
    expect(now).toContain('// Kept by all.')
    expect(await page.locator('.conflict').count(), now).toBe(0)
  }
  expect(trouble.told).toEqual([])
}, 900_000)
