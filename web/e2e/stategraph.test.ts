// The state graph: drawn, filtered, walked through by keys, with the chart beside it.

import { writeFileSync } from 'node:fs'
import { join } from 'node:path'

import type { Browser, Page } from 'playwright-core'
import { afterAll, afterEach, beforeAll, beforeEach, expect, test } from 'vitest'

import { type Trouble, middle, opened, page as newPage, shape, shot } from './browser'
import { DOOR, MODEL } from './door'
import { type Served, copied, removed, served } from './served'

// Its states have no end: what is drawn is not all.
const ENDLESS = `asm Endless
import StandardLibrary
signature:
	controlled count: Integer
	controlled name: String
definitions:
	main rule r_Main = count := count + 1
default init s0:
	function count = 0
	function name = "<img src=x onerror=alert(1)>"
`

let browser: Browser
let studio: Served
let page: Page
const trouble: Trouble = { told: [] }

const path = (name: string): string => join(studio.folder, name)

beforeAll(async () => {
  studio = await served(copied())
  writeFileSync(path('Door.chart'), DOOR)
  writeFileSync(path('Door.asm'), MODEL)
  writeFileSync(path('Endless.asm'), ENDLESS)
  browser = await opened()
})

afterAll(async () => {
  await browser?.close()
  studio?.stop()
  if (studio) removed(studio.folder)
})

beforeEach(async () => {
  trouble.told = []
  page = await newPage(browser, `${studio.address}#/Door.chart`, trouble)
  await shape(page, 'shut').waitFor()
})

afterEach(async ({ task }) => {
  if (task.result?.state === 'fail') await shot(page, `failed: ${task.name}`.replace(/\W+/g, '-'))
  await page.context().close()
  expect(trouble.told).toEqual([])
})

const litNow = (id: string) => page.locator(`.react-flow__node[data-id="${id}"] .lit`).first()
const dots = () => page.locator('.graph-dot')

async function drawn(): Promise<void> {
  await page.getByRole('tab', { name: 'State graph' }).click()
  await page.getByRole('button', { name: 'Draw the states of Door.asm' }).click()
  await page.getByRole('button', { name: 'Draw the old model' }).click()
  await dots().first().waitFor({ timeout: 20_000 })
}

test('a state that is clicked or walked to shows in the table and on the chart', async () => {
  await drawn()
  expect(await page.locator('.graph-head').innerText()).toMatch(/\d+ states, \d+ steps/)
  expect(await page.locator('.graph-dot.bad').count()).toBeGreaterThan(0)
  await page.mouse.click(...(await middle(page.locator('.graph-dot[data-state="1"] circle').last())))
  const table = page.locator('.graph-state')
  await table.locator('tr', { hasText: 'AJAR' }).waitFor()
  await litNow('ajar').waitFor()
  // By keys: on, back, and to the first.
  await page.locator('.graph-picture').focus()
  await page.keyboard.press('ArrowRight')
  await table.locator('tr', { hasText: 'OPEN' }).waitFor()
  await litNow('open').waitFor()
  expect(await page.locator('.graph-picture [aria-live]').textContent()).toMatch(/^State \d+: door OPEN, force 1$/)
  await page.keyboard.press('Home')
  await litNow('shut').waitFor()
  // Along a step in the list, which says what it needs.
  expect(await table.locator('li', { hasText: 'pushed = true' }).innerText()).toContain('State 1')
  await table.locator('li', { hasText: 'pushed = true' }).getByRole('button').click()
  await litNow('ajar').waitFor()
  await shot(page, 'stategraph-picked')
  // Without its panel, nothing of it is lit.
  await page.getByRole('tab', { name: 'Problems' }).click()
  await litNow('ajar').waitFor({ state: 'detached' })
})

test('a term filters the states, and a wrong one is told', async () => {
  await drawn()
  const all = await dots().count()
  const term = page.getByLabel('Filter by a term')
  await term.fill('force > 2')
  await term.press('Enter')
  await page.locator('.graph-dot.out').first().waitFor({ timeout: 20_000 })
  const out = await page.locator('.graph-dot.out').count()
  expect(await page.locator('.graph-head').innerText()).toContain(`true in ${all - out} states`)
  await page.getByLabel('Hide the others').check()
  await page.locator('.graph-dot.out').first().waitFor({ state: 'detached' })
  expect(await dots().count()).toBe(all - out)
  await shot(page, 'stategraph-filtered')
  await term.fill('forse > 2')
  await term.press('Enter')
  await page.locator('.graph-body .bad', { hasText: 'forse' }).waitFor({ timeout: 20_000 })
})

test('a graph that is not whole says so, and its strings are no markup', async () => {
  await page.goto(`${studio.address}#/Endless.asm`)
  await page.reload()
  await page.getByRole('tab', { name: 'State graph' }).click()
  await page.getByRole('button', { name: 'Draw the states of Endless.asm' }).click()
  await page.locator('.graph-open', { hasText: 'Not all: 2,000 states' }).waitFor({ timeout: 40_000 })
  await dots().first().waitFor({ timeout: 20_000 })
  expect(await page.locator('.graph-dot.open').count()).toBe(1)
  await page.locator('.graph-picture').focus()
  await page.keyboard.press('Home')
  await page.locator('.graph-state td', { hasText: '<img src=x' }).waitFor()
  expect(await page.locator('.graph-state img').count()).toBe(0)
  await shot(page, 'stategraph-endless')
})
