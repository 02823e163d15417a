// Random operations in the browser, with writes of others and lost connections in between: after each, file, text and picture say the same,
// and nothing that was written is lost.
//
// With GROUNDSTATE_FULL set it goes on for longer. The numbers are the same each time.

import { readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'

import type { Browser, Page } from 'playwright-core'
import { afterAll, afterEach, beforeAll, expect, test } from 'vitest'

import { random } from '../diagram/testing'
import { names, phases, seen, told } from './agreement'
import { type Trouble, drag, middle, opened, page as newPage, shape, shot, text } from './browser'
import { type Served, copied, removed, served } from './served'

const MACHINE = `// Kept by all.
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

const SYSTEM = `// Kept by all.
chart Random

system part "Part"
	tick 0.5 ms
	sensor eye "Eye"
	actuator arm "Arm"
	component look "Look" synchronous period 10 ms // sees
		elaborate scan 1 ms
		write seen 0.5 ms
	endcomponent
	component act "Act" synchronous period 20 ms
		read seen 0.5 ms
		elaborate law 2 ms
	endcomponent
	component log "Log" asynchronous
		elaborate note 1 ms
	endcomponent
	channel seen from look to act swinging buffer 2
	eye -> look
	act -> arm
endsystem
`

const ROUNDS = process.env['GROUNDSTATE_FULL'] ? 400 : 40

let browser: Browser
let studio: Served
let page: Page
const trouble: Trouble = { told: [] }

const path = (): string => join(studio.folder, 'Random.chart')
const file = (): string => readFileSync(path(), 'utf8')

beforeAll(async () => {
  studio = await served(copied())
  browser = await opened()
})

afterAll(async () => {
  await browser?.close()
  studio?.stop()
  if (studio) removed(studio.folder)
})

afterEach(async ({ task }) => {
  if (task.result?.state === 'fail') await shot(page, `failed: ${task.name}`.replace(/\W+/g, '-'))
  await page.context().close()
})

async function begin(start: string, first: string): Promise<void> {
  trouble.told = []
  writeFileSync(path(), start)
  page = await newPage(browser, `${studio.address}#/Random.chart`, trouble)
  // All lines are on the page.
  await page.setViewportSize({ width: 1400, height: 3000 })
  await shape(page, first).waitFor()
}

async function agree(what: string): Promise<string> {
  let reason = ''
  for (let tries = 0; tries < 200; tries++) {
    const [here, shown, now] = [await text(page), await seen(page), file()]
    const saved = await page.locator('.state-chip', { hasText: /^Saved$/ }).isVisible()
    const wanted = told(now, shown.shown)
    if (saved && now === here && String(wanted.shapes) === String(shown.shapes) && String(wanted.arrows) === String(shown.arrows)) return now
    reason = `${what}\nfile:\n${now}\neditor:\n${here}\npicture: ${shown.shapes.join(', ')}; ${shown.arrows.join('; ')}\ntext: ${wanted.arrows.join('; ')}\nsaved: ${saved}`
    await page.waitForTimeout(50)
  }
  throw new Error(`they never agreed after ${reason}`)
}

const next = random(19)
const below = (most: number): number => Math.floor(next() * most)
const one = <Thing,>(of: readonly Thing[]): Thing | undefined => of[below(of.length)]

const pick = (name: string): Promise<void> => page.locator(`.react-flow__node[data-id="${name}"] .figure`).first().click({ force: true, position: { x: 8, y: 18 } })

async function somewhere(): Promise<void> {
  const canvas = await page.locator('.canvas').boundingBox()
  if (!canvas) throw new Error('no canvas')
  await page.mouse.click(canvas.x + 90 + below(canvas.width - 420), canvas.y + 60 + below(500))
}

// Moves a shape by keys; these rest for a moment before the text follows.
async function nudge(name: string): Promise<void> {
  await pick(name)
  for (let times = below(4); times >= 0; times--) await page.keyboard.press(one(['ArrowRight', 'ArrowDown', 'ArrowLeft', 'ArrowUp']) ?? 'ArrowUp')
  await page.waitForTimeout(450)
}

async function place(keys: string[]): Promise<void> {
  await page.locator('.canvas').focus()
  await page.keyboard.press(one(keys) ?? 's')
  await somewhere()
}

async function remove(name: string): Promise<void> {
  await pick(name)
  await page.keyboard.press('Delete')
  await settled()
}

async function undo(): Promise<void> {
  await page.locator('.canvas').focus()
  await page.keyboard.press(below(3) === 0 ? 'Control+Shift+z' : 'Control+z')
}

// Draws an arrow from an end of a shape to another shape. What is refused changes nothing.
async function draw(from: string, to: string): Promise<void> {
  await shape(page, from).hover({ force: true })
  const ports = shape(page, from).locator('.port')
  const count = await ports.count()
  if (count === 0) return
  await drag(page, await middle(ports.nth(below(count))), await middle(shape(page, to)))
  // Let go beside every shape, it asks what is to be there.
  await page.keyboard.press('Escape')
  await settled()
}

// What the canvas asked for is answered: agreement before that would be with the text as it was.
const settled = (): Promise<void> => page.waitForTimeout(150)

// Deletes an arrow, where none lies over it.
async function cut(): Promise<void> {
  const arrows = page.locator('.lines [role="img"]')
  const arrow = arrows.nth(below(await arrows.count()))
  const [x, y] = await arrow.locator('.reach').evaluate((path) => {
    const line = path as SVGPathElement
    const at = line.getPointAtLength(line.getTotalLength() * 0.4).matrixTransform(line.getScreenCTM() ?? undefined)
    return [at.x, at.y] as const
  })
  await page.mouse.click(x, y)
  await page.keyboard.press('Delete')
  await settled()
}

async function typed(what: string): Promise<void> {
  await page.locator('.cm-line', { hasText: 'chart Random' }).first().click()
  await page.keyboard.press('End')
  await page.keyboard.type(` ${what}`)
}

// Others write at the end of the section. Out: what they wrote.
function outside(round: number): string {
  writeFileSync(path(), file().replace(/\nend(machine|system)/, `\n\t// outside ${round}\nend$1`))
  return `// outside ${round}`
}

// Typing and writing while there is no connection: both are there when it is back.
async function lost(round: number): Promise<string[]> {
  studio.cut(true)
  await page.locator('.banner').waitFor()
  await typed(`// lost ${round}`)
  const theirs = outside(round)
  studio.cut(false)
  await page.locator('.banner').waitFor({ state: 'detached', timeout: 20_000 })
  trouble.told = trouble.told.filter((line) => !line.includes('WebSocket'))
  return [`// lost ${round}`, theirs]
}

async function held(round: number, operation: string, kept: string[]): Promise<string> {
  const now = await agree(`round ${round}, ${operation}`)
  for (const part of [...kept, '// Kept by all.']) expect(now, `round ${round}, ${operation}`).toContain(part)
  expect(await page.locator('.conflict').count(), now).toBe(0)
  return now
}

test('file, text and picture of a machine agree after each operation, whoever writes', async () => {
  await begin(MACHINE, 'first')
  for (let round = 0; round < ROUNDS; round++) {
    const before = file()
    const all = names(before)
    const [name, other] = [one(all) ?? 'first', one(all) ?? 'first']
    let kept: string[] = []
    const choice = one(['nudge', 'place', 'remove', 'undo', 'type', 'write', 'rename', 'draw', 'draw', 'draw', 'cut', 'lost'])
    switch (choice) {
      case 'nudge':
        await nudge(name)
        break
      case 'place':
        if (all.length <= 12) await place(['s', 'g', 'a'])
        break
      case 'remove':
        if (all.length >= 4 && name !== 'first') await remove(name)
        break
      case 'undo':
        await undo()
        break
      case 'draw':
        await draw(name, other)
        break
      case 'cut':
        await cut()
        break
      case 'type':
        // Typed, and at once others write elsewhere: both stay.
        await typed(`// typed ${round}`)
        kept = [`// typed ${round}`, outside(round)]
        break
      case 'write':
        kept = [`state out${round} "Out"`]
        writeFileSync(path(), before.replace(/\n\tguard|\n\taction|\nendmachine/, (found) => `\n\t${kept[0]}${found}`))
        break
      case 'lost':
        kept = await lost(round)
        break
      default:
        kept = [`"Said ${round}"`]
        writeFileSync(path(), before.replace(/(initial state \w+) "[^"]*"/, `$1 ${kept[0]}`))
    }
    await held(round, `${choice} ${name} ${other}`, kept)
  }
  expect(trouble.told).toEqual([])
}, 1_800_000)

// The phases of a component, in its properties.
async function phased(name: string, round: number): Promise<void> {
  await pick(name)
  const fields = page.locator('.inspector')
  const list = fields.locator('.phases')
  await fields.waitFor()
  if ((await list.count()) === 0) return
  const removals = list.getByRole('button', { name: /^Delete elaborate / })
  switch (below(3)) {
    case 0:
      await list.locator('.new-phase input').fill(`work${round}`)
      await list.locator('.new-phase button').click()
      break
    case 1:
      if ((await removals.count()) > 1) await removals.first().click()
      break
    default: {
      const time = list.locator('input[name="phaseTime-0"]')
      if ((await time.count()) === 0) break
      await time.fill(`${1 + below(4)} ms`)
      await time.press('Enter')
    }
  }
}

test('file, text and picture of a system agree after each operation, whoever writes', async () => {
  await begin(SYSTEM, 'look')
  for (let round = 0; round < ROUNDS; round++) {
    const before = file()
    const all = names(before)
    const [name, other] = [one(all) ?? 'look', one(all) ?? 'act']
    let kept: string[] = []
    const choice = one(['nudge', 'place', 'remove', 'undo', 'type', 'write', 'draw', 'draw', 'draw', 'cut', 'phases', 'phases', 'lost'])
    switch (choice) {
      case 'nudge':
        await nudge(name)
        break
      case 'place':
        if (all.length <= 12) await place(['c', 's', 'a'])
        break
      case 'remove':
        if (all.length >= 6 && name !== 'look') await remove(name)
        break
      case 'undo':
        await undo()
        break
      case 'draw':
        await draw(name, other)
        break
      case 'cut':
        await cut()
        break
      case 'phases':
        await phased(name, round)
        break
      case 'type':
        await typed(`// typed ${round}`)
        kept = [`// typed ${round}`, outside(round)]
        break
      case 'lost':
        kept = await lost(round)
        break
      default:
        kept = [`component out${round} "Out"`]
        writeFileSync(path(), before.replace(/\n\tcomponent/, (found) => `\n\t${kept[0]} synchronous period 40 ms\n\t\telaborate rest 1 ms\n\tendcomponent${found}`))
    }
    const now = await held(round, `${choice} ${name} ${other}`, kept)
    // Whoever writes or reads a channel has a phase for it, and nobody else.
    const { ends, phases: own } = phases(now)
    expect(own, `round ${round}, ${choice} ${name} ${other}\n${now}`).toEqual(ends)
  }
  expect(trouble.told).toEqual([])
}, 1_800_000)
