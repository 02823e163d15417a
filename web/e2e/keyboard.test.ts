// Drawing with the keyboard alone: shapes are placed, arrows drawn, and what goes on is shown and told.

import { readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'

import type { Browser, Page } from 'playwright-core'
import { afterAll, afterEach, beforeAll, beforeEach, expect, test } from 'vitest'

import { type Trouble, opened, page as newPage, shape, shot } from './browser'
import { type Served, copied, removed, served } from './served'

const LAMP = `chart Lamp

machine lamp "Lamp"
	control light
	initial state off "Off"
	guard pressed "Pressed"
	off -> pressed
endmachine
`

const SYSTEM = `chart Plant

system plant "Plant"
	tick 1 ms
	component plan "Plan" synchronous period 10 ms
	endcomponent
endsystem
`

let browser: Browser
let studio: Served
let page: Page
const trouble: Trouble = { told: [] }

const text = (name = 'Lamp.chart'): string => readFileSync(join(studio.folder, name), 'utf8')

async function until(holds: () => boolean | Promise<boolean>, what: () => string = text): Promise<void> {
  for (let tries = 0; tries < 160; tries++) {
    if (await holds()) return
    await new Promise((done) => setTimeout(done, 50))
  }
  throw new Error(`it never came: ${what()}`)
}

beforeAll(async () => {
  studio = await served(copied())
  browser = await opened()
})

afterAll(async () => {
  await browser?.close()
  studio?.stop()
  if (studio) removed(studio.folder)
})

async function open(name: string, written: string, options: { width?: number; dark?: boolean } = {}): Promise<void> {
  writeFileSync(join(studio.folder, name), written)
  page = await newPage(browser, `${studio.address}#/${name}`, trouble, options)
  await page.locator('.react-flow__node').first().waitFor()
}

beforeEach(() => {
  trouble.told = []
})

afterEach(async ({ task }) => {
  if (task.result?.state === 'fail') await shot(page, `failed: ${task.name}`.replace(/\W+/g, '-'))
  await page.context().close()
  expect(trouble.told).toEqual([])
})

const note = () => page.locator('.hand-note')
const focused = () => page.evaluate(() => document.activeElement?.getAttribute('data-id') ?? null)

test('a shape is placed behind another one, with the arrow to it', async () => {
  await open('Lamp.chart', LAMP)
  await shape(page, 'pressed').focus()
  await page.keyboard.press('Space')
  await page.keyboard.press('a')
  await note().filter({ hasText: 'Action: click a place, or press Enter to put it behind Pressed, with an arrow' }).waitFor()
  await shot(page, 'keyboard-place')
  await page.keyboard.press('Enter')
  await until(() => /pressed yes -> \w+/.test(text()) && text().includes('action'))
  const action = /action (\w+)/.exec(text())?.[1] ?? ''
  await until(async () => (await focused()) === action, () => action)
  // The next one goes on from there, with no pointer between.
  await page.keyboard.press('s')
  await page.keyboard.press('Enter')
  await until(() => new RegExp(`${action} -> \\w+|yes -> ${action} -> \\w+`).test(text()))
  await shot(page, 'keyboard-placed')
  // One gesture is undone as one.
  await page.keyboard.press('Control+z')
  await until(() => !new RegExp(`${action} -> `).test(text()) && text().includes(action))
  // Escape leaves, and nothing is placed.
  const before = text()
  await page.keyboard.press('g')
  await page.keyboard.press('Escape')
  expect(await note().textContent()).toBe('')
  expect(text()).toBe(before)
})

test('an arrow is drawn by keys', async () => {
  await open('Lamp.chart', LAMP)
  await shape(page, 'pressed').focus()
  await page.keyboard.press('e')
  await note().filter({ hasText: 'Arrow from Pressed, if yes: arrow keys' }).waitFor()
  await page.keyboard.press('n')
  await note().filter({ hasText: 'if no' }).waitFor()
  await page.keyboard.press('Escape')
  expect(text()).toBe(LAMP)
  await page.keyboard.press('e')
  await page.keyboard.press('ArrowLeft')
  await page.keyboard.press('ArrowUp')
  await page.keyboard.press('Tab')
  await note().filter({ hasText: 'to ' }).waitFor()
  while (!(await note().textContent())?.includes('to Off')) await page.keyboard.press('Tab')
  await note().filter({ hasText: 'Arrow from Pressed, if yes, to Off: Enter draws it.' }).waitFor()
  await shot(page, 'keyboard-arrow')
  await page.keyboard.press('Enter')
  await until(() => text().includes('pressed yes -> off'))
  expect(await note().textContent()).toBe('')
  await page.locator('.notice', { hasText: 'Arrow from Pressed, if yes, to Off.' }).waitFor()
})

test('a system grows by keys', async () => {
  await open('Plant.chart', SYSTEM, { dark: true })
  await shape(page, 'plan').focus()
  await page.keyboard.press('s')
  await page.keyboard.press('Enter')
  await until(() => /\w+ -> plan/.test(text('Plant.chart')), () => text('Plant.chart'))
  await shape(page, 'plan').focus()
  await page.keyboard.press('Space')
  await page.keyboard.press('c')
  await page.keyboard.press('Enter')
  await until(() => /channel \w+ from plan/.test(text('Plant.chart')), () => text('Plant.chart'))
  await shot(page, 'keyboard-system')
})

test('in a narrow window the note has its place', async () => {
  await open('Lamp.chart', LAMP, { width: 620 })
  await shape(page, 'off').focus()
  await page.keyboard.press('e')
  await note().filter({ hasText: 'Arrow from Off' }).waitFor()
  await shot(page, 'keyboard-narrow')
})
