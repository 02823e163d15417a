// The pictures of the README and of docs/studio.md: `npm run pictures` writes them anew.

import { cpSync, rmSync, writeFileSync } from 'node:fs'
import { join, resolve } from 'node:path'

import type { Browser, Page } from 'playwright-core'
import { afterAll, beforeAll, test } from 'vitest'

import { type Trouble, drag, middle, opened, page as newPage, shape } from './browser'
import { DOOR, MODEL } from './door'
import { lampBuilt } from './lamp'
import { type Served, copied, removed, served } from './served'
import { small } from './small'

const ROOT = resolve(import.meta.dirname, '../..')
const DOCS = join(ROOT, 'docs')
const COMPONENT = 'examples/visual_servoing/VisualServoingComponent.chart'

let browser: Browser
let studio: Served
const trouble: Trouble = { told: [] }

// A name of its own in the bar, not that of a temporary folder.
async function kept(page: Page, name: string): Promise<void> {
  await page.evaluate(() => {
    const brand = document.querySelector('.brand b')
    if (brand) brand.textContent = 'robots'
  })
  await page.mouse.move(5, 500)
  await page.waitForTimeout(500)
  writeFileSync(join(DOCS, `${name}.png`), small(await page.screenshot()))
}

const at = (path: string): string => `${studio.address}#/${path}`

beforeAll(async () => {
  const folder = copied('library')
  for (const example of ['coffee_machine', 'mutual_exclusion', 'pick_and_place', 'visual_servoing'])
    cpSync(join(ROOT, 'examples', example), join(folder, 'examples', example), { recursive: true })
  studio = await served(folder)
  browser = await opened()
})

afterAll(async () => {
  await browser?.close()
  studio?.stop()
  if (studio) removed(studio.folder)
})

async function run(page: Page, steps: number): Promise<void> {
  await page.keyboard.press('F5')
  const build = page.getByRole('button', { name: 'Build the model and run' })
  await build.or(page.locator('.state-table')).first().waitFor()
  if (await build.isVisible()) await build.click()
  await page.locator('.state-table').waitFor({ timeout: 20_000 })
  await page.getByRole('button', { name: 'Show all (F)' }).click()
  for (let step = 0; step < steps; step++) {
    const offers = page.locator('.offers button')
    const yes = offers.filter({ hasText: 'true' })
    await page.keyboard.press('F10')
    await page.waitForTimeout(250)
    if ((await yes.count()) > 0) await yes.first().click()
    else if ((await offers.count()) > 0) await offers.first().click()
    await page.waitForTimeout(250)
  }
}

test('running, and the picture of the README', async () => {
  const page = await newPage(browser, studio.address, trouble)
  await page.evaluate(() => localStorage.setItem('groundstate-panel', '200'))
  await page.goto(at(COMPONENT))
  await page.reload()
  await shape(page, 'waiting').waitFor()
  await run(page, 5)
  await kept(page, 'studio')
  await page.goto(at('examples/pick_and_place/PlacingSystem.chart'))
  await page.keyboard.press('Control+2')
  await shape(page, 'planner').waitFor()
  await run(page, 24)
  await kept(page, 'studio-running')
  await page.context().close()
})

test('the timeline', async () => {
  const page = await newPage(browser, studio.address, trouble)
  await page.evaluate(() => localStorage.setItem('groundstate-panel', '430'))
  await page.reload()
  await page.goto(at('examples/pick_and_place/PlacingSystem.chart'))
  await page.keyboard.press('Control+2')
  await shape(page, 'planner').waitFor()
  await page.locator('.canvas').click({ position: { x: 8, y: 8 } })
  // What is asked for is nobody's to answer at this speed.
  await page.getByRole('tab', { name: 'Run', exact: true }).click()
  await page.getByRole('button', { name: 'Run with random inputs' }).click()
  await page.locator('.state-table').waitFor({ timeout: 20_000 })
  await page.getByRole('button', { name: 'Show all (F)' }).click()
  await page.getByLabel('Speed', { exact: true }).selectOption({ label: 'As fast as can be' })
  await page.getByRole('tab', { name: 'Timeline' }).click()
  await page.keyboard.press('F5')
  const where = page.locator('.timeline #where')
  await where.filter({ hasText: /–([4-9]\d|\d{3,})\./ }).waitFor({ timeout: 60_000 })
  await page.keyboard.press('F5')
  await page.waitForTimeout(900)
  await page.locator('.timeline').getByRole('button', { name: 'First view' }).click()
  await page.evaluate(() => localStorage.removeItem('groundstate-panel'))
  await kept(page, 'studio-timeline')
  await page.context().close()
})

test('drawing', async () => {
  const page = await newPage(browser, at(COMPONENT), trouble)
  await shape(page, 'elaborated').click()
  await shape(page, 'elaborated').hover()
  await drag(page, await middle(page.locator('.port.no')), [390, 590])
  await page.getByRole('menuitem', { name: 'State' }).click()
  await page.locator('.inspector input[name=name][value^=waiting]').waitFor()
  await page.locator('.inspector input[name=name]').fill('lost')
  await page.keyboard.press('Tab')
  await page.keyboard.type('Image lost')
  await page.keyboard.press('Enter')
  await page.locator('.figure text', { hasText: 'lost' }).waitFor()
  await kept(page, 'studio-drawing')
  await page.context().close()
})

test('checking', async () => {
  // Without the fairness that it says, a process may wait for ever.
  rmSync(join(studio.folder, 'examples/mutual_exclusion/Peterson.verify.yaml'))
  const page = await newPage(browser, at('examples/mutual_exclusion/Peterson.asm'), trouble, { dark: true })
  await page.getByRole('button', { name: 'Verify', exact: true }).click()
  await page.locator('.verdict', { hasText: 'violated' }).waitFor({ timeout: 60_000 })
  await page.getByRole('button', { name: /Play its/ }).first().click()
  for (let step = 0; step < 3; step++) await page.getByRole('button', { name: 'One step on' }).click()
  await kept(page, 'studio-checking')
  await page.context().close()
})

test('the state graph', async () => {
  writeFileSync(join(studio.folder, 'Door.chart'), DOOR)
  writeFileSync(join(studio.folder, 'Door.asm'), MODEL)
  const page = await newPage(browser, at('Door.chart'), trouble)
  await shape(page, 'ajar').waitFor()
  await page.getByRole('tab', { name: 'State graph' }).click()
  await page.getByRole('button', { name: 'Draw the states of Door.asm' }).click()
  await page.getByRole('button', { name: 'Draw the old model' }).click()
  await page.locator('.graph-dot').first().waitFor({ timeout: 30_000 })
  await page.locator('.graph-picture').focus()
  for (const key of ['Home', 'ArrowRight', 'ArrowRight', 'ArrowRight', 'ArrowRight']) await page.keyboard.press(key)
  await page.getByRole('button', { name: 'Show all states (F)' }).click()
  await kept(page, 'studio-graph')
  await page.context().close()
})

test('what scenarios covered', async () => {
  lampBuilt(studio.folder)
  const page = await newPage(browser, at('Lamp.chart'), trouble)
  await shape(page, 'on').waitFor()
  await page.getByLabel('More to do with this file').click()
  await page.getByRole('menuitem', { name: 'Test', exact: true }).click()
  await page.locator('.box.uncovered').first().waitFor({ timeout: 30_000 })
  await kept(page, 'studio-coverage')
  await page.context().close()
})

test('a system and its times', async () => {
  const page = await newPage(browser, at('examples/pick_and_place/PlacingSystem.chart'), trouble)
  await shape(page, 'planner').click()
  await page.getByRole('tab', { name: 'Times' }).click()
  await page.locator('.times').waitFor()
  await page.getByRole('button', { name: 'Show all (F)' }).click()
  await kept(page, 'studio-times')
  await page.context().close()
})

test('generated C++', async () => {
  const page = await newPage(browser, at('examples/coffee_machine/CoffeeMachine.asm'), trouble, { dark: true })
  await page.getByRole('tab', { name: 'C++' }).click()
  await page.getByRole('button', { name: 'Generate C++' }).last().click()
  await page.locator('.currency.good').waitFor({ timeout: 30_000 })
  await page.locator('.text-pane .cm-line', { hasText: 'PUSH_TEA' }).last().click()
  await page.locator('.code-text .cm-ran-next').first().waitFor()
  await kept(page, 'studio-code')
  await page.context().close()
})

test('a program that runs', async () => {
  const axis = `chart Axis\n\nimport patterns/ControlTask\n\nsystem axis "Axis"\n\ttick 0.5 ms\n\tsensor encoder "Encoder"\n\tactuator motor "Motor"\n\n\tcomponent sensing "Sensing" synchronous period 10 ms\n\t\telaborate acquire 1.5 ms\n\t\twrite position 0.5 ms\n\tendcomponent\n\n\tcomponent control "Control" synchronous period 20 ms\n\t\tread position 0.5 ms\n\t\telaborate law 6 ms\n\tendcomponent\n\n\tchannel position from sensing to control swinging buffer 2\n\tencoder -> sensing\n\tcontrol -> motor\nendsystem\n`
  writeFileSync(join(studio.folder, 'Axis.chart'), axis)
  const page = await newPage(browser, studio.address, trouble)
  await page.getByRole('button', { name: 'Axis.chart' }).first().click()
  await shape(page, 'control').waitFor()
  await page.getByLabel('More to do with this file').click()
  await page.getByRole('menuitem', { name: 'Build and run' }).click()
  await page.locator('.program-now').waitFor({ timeout: 180_000 })
  await page.locator('.row-lit').first().waitFor({ timeout: 20_000 })
  await kept(page, 'studio-program')
  await page.context().close()
}, 240_000)

test('conflict', async () => {
  const lamp = (action: string): string =>
    `chart Lamp\n\nmachine lamp "Lamp"\n\tcontrol light\n\tinitial state off "Off"\n\tstate on "On"\n\tguard pressed "Pressed"\n\taction count "${action}"\n\toff -> pressed yes -> count -> on\n\ton -> pressed\n\tpressed no -> off\nendmachine\n`
  const file = join(studio.folder, 'Lamp.chart')
  writeFileSync(file, lamp('COUNT'))
  const page = await newPage(browser, studio.address, trouble)
  await page.getByRole('button', { name: 'Lamp.chart' }).first().click()
  await page.locator('.cm-line', { hasText: 'action count' }).click()
  await page.keyboard.press('End')
  await page.keyboard.type(' {r_count}')
  writeFileSync(file, lamp('COUNT PRESSES'))
  await page.locator('.conflict').waitFor()
  await kept(page, 'studio-conflict')
  await page.context().close()
})
