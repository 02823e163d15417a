// How the studio behaves in small things: keys and clicks, names that are refused, counterexamples that are too long, little room.

import { existsSync, readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'

import type { Browser, Page } from 'playwright-core'
import { afterAll, afterEach, beforeAll, beforeEach, expect, test } from 'vitest'

import { type Trouble, middle, opened, page as newPage, shape, shot } from './browser'
import { lampBuilt } from './lamp'
import { type Served, copied, removed, served } from './served'

// Its counterexample has more steps than a browser can hold.
const FAR = `asm Far
import StandardLibrary
signature:
	controlled x: Integer
	monitored go: Boolean
definitions:
	invariant inv_near over x: x < 60000
	main rule r_Main = if go then x := x + 1 endif
default init s0:
	function x = 0
`

let browser: Browser
let studio: Served
let page: Page
const trouble: Trouble = { told: [] }

const path = (name: string): string => join(studio.folder, name)
const file = (): string => (existsSync(path('Lamp.chart')) ? readFileSync(path('Lamp.chart'), 'utf8') : '')
let chart = ''

async function until(holds: () => boolean | Promise<boolean>, what: () => string): Promise<void> {
  for (let tries = 0; tries < 160; tries++) {
    if (await holds()) return
    await new Promise((done) => setTimeout(done, 50))
  }
  throw new Error(`it never came: ${what()}`)
}

beforeAll(async () => {
  const folder = copied('examples', 'library')
  lampBuilt(folder)
  studio = await served(folder)
  chart = file()
  writeFileSync(path('Far.asm'), FAR)
  browser = await opened()
})

afterAll(async () => {
  await browser?.close()
  studio?.stop()
  if (studio) removed(studio.folder)
})

async function open(options: { width?: number; dark?: boolean } = {}, name = 'Lamp.chart'): Promise<void> {
  await page?.context().close()
  page = await newPage(browser, `${studio.address}#/${name}`, trouble, options)
  if (name === 'Lamp.chart') await shape(page, 'off').waitFor()
}

beforeEach(async () => {
  trouble.told = []
  writeFileSync(path('Lamp.chart'), chart)
  await open()
})

afterEach(async ({ task }) => {
  if (task.result?.state === 'fail') await shot(page, `failed: ${task.name}`.replace(/\W+/g, '-'))
  await page.context().close()
  expect(trouble.told).toEqual([])
})

test('Shift and a click add to what is selected, and what is selected does not look like an initial state', async () => {
  await shape(page, 'on').click()
  await shape(page, 'count').click({ modifiers: ['Shift'] })
  await page.locator('.inspector h2', { hasText: '2 shapes' }).waitFor()
  await shape(page, 'held').click({ modifiers: ['Control'] })
  await page.locator('.inspector h2', { hasText: '3 shapes' }).waitFor()
  await shot(page, 'selected')
  await open({ dark: true })
  await shape(page, 'on').click()
  await shot(page, 'selected-dark')
})

test('a copy does not lie on what was copied', async () => {
  await shape(page, 'on').click()
  await page.keyboard.press('Control+c')
  // The pointer is where the click was: on the original.
  await page.keyboard.press('Control+v')
  await until(() => /state on\d/.test(file()), file)
  const id = /state (on\d)/.exec(file())?.[1] ?? ''
  await shape(page, id).waitFor()
  const [one, other] = [await middle(shape(page, 'on')), await middle(shape(page, id))]
  expect(Math.hypot(one[0] - other[0], one[1] - other[1])).toBeGreaterThan(10)
})

test('the panel that is shown is marked among the tabs, which arrow keys go along', async () => {
  const tab = (name: string) => page.getByRole('tab', { name, exact: true })
  await tab('Run').click()
  await tab('Timeline').waitFor()
  const paper = (name: string): Promise<string> => tab(name).evaluate((one) => getComputedStyle(one).backgroundColor)
  await until(async () => (await paper('Run')) !== (await paper('Timeline')), () => 'a colour of its own')
  await tab('Run').focus()
  await page.keyboard.press('ArrowRight')
  expect(await page.evaluate(() => document.activeElement?.textContent)).toBe('Timeline')
  await page.keyboard.press('End')
  await page.keyboard.press('ArrowRight')
  expect(await page.evaluate(() => document.activeElement?.textContent)).toContain('Problems')
  await page.keyboard.press('Enter')
  expect(await tab('Problems').getAttribute('aria-selected')).toBe('true')
})

test('a name that is refused stays in its field, with the reason', async () => {
  await shape(page, 'on').click()
  const name = page.locator('.inspector input[name=name]')
  await name.fill('off')
  await name.press('Enter')
  await page.locator('.inspector .property', { has: page.locator('input[name=name]') }).locator('.field-fault').waitFor()
  expect(await name.inputValue()).toBe('off')
  expect(await name.getAttribute('aria-invalid')).toBe('true')
  await shot(page, 'name-refused')
  await name.press('Escape')
  expect(await name.inputValue()).toBe('on')
  await page.getByRole('button', { name: 'New machine' }).click()
  await page.locator('dialog input.mono').fill('Türsteuerung')
  await page.locator('dialog .note', { hasText: 'only a–z, A–Z, digits and _' }).waitFor()
})

test('what is not covered is marked at its head, and no word of it is dimmed', async () => {
  await page.getByRole('button', { name: 'More to do with this file' }).click()
  await page.getByRole('menuitem', { name: 'Test', exact: true }).click()
  await page.locator('.covered .told-place').first().click({ timeout: 20_000 })
  const marks = page.locator('.cm-lintRange-info')
  await marks.first().waitFor()
  expect(await marks.evaluateAll((all) => all.every((one) => getComputedStyle(one).opacity === '1'))).toBe(true)
  expect(await page.locator('.covered .verdict .faint').first().textContent()).toMatch(/^line \d+$/)
  await shot(page, 'coverage-text')
})

test('of a counterexample that is too long, its verdict, its beginning and its end are here', async () => {
  await open({}, 'Far.asm')
  await page.getByRole('button', { name: 'Verify', exact: true }).click()
  const verdict = page.locator('.verdict', { hasText: 'inv_near' })
  await verdict.filter({ hasText: 'violated' }).waitFor({ timeout: 60_000 })
  await verdict.filter({ hasText: 'its first 500 and last 500 of 60,001 steps' }).waitFor()
  expect(await page.locator('.output li', { hasText: '{"' }).count()).toBe(0)
  await verdict.getByRole('button', { name: 'Play its 60,000 steps' }).click()
  const slider = page.locator('.player input[type=range]')
  await slider.fill('500')
  await page.locator('.player .note', { hasText: '59,001 steps before this one are left out.' }).waitFor()
  await page.locator('.player tr', { hasText: 'x' }).filter({ hasText: '59501' }).waitFor()
  await slider.fill('999')
  await page.locator('.player .run-step', { hasText: 'Step 60000 / 60000' }).waitFor()
  await shot(page, 'far')
})

for (const width of [400, 700]) {
  test(`at a width of ${width} pixels everything can be reached`, async () => {
    await open({ width })
    const shown = page.locator('.topbar button:visible')
    for (const button of await shown.all()) {
      const box = await button.boundingBox()
      expect(box && box.x >= 0 && box.x + box.width <= width, await button.innerText()).toBe(true)
    }
    // One pane at a time.
    expect(await page.locator('.text-pane').count()).toBe(0)
    await shot(page, `narrow-${width}`)
    await page.getByRole('radio', { name: 'Text only' }).click()
    await page.locator('.cm-content').waitFor()
    expect(await page.locator('.picture-pane').count()).toBe(0)
    await page.getByRole('button', { name: 'Run', exact: true }).click()
    await page.locator('.run-step').waitFor({ timeout: 20_000 })
    await shot(page, `narrow-run-${width}`)
    await page.getByRole('tab', { name: 'C++' }).scrollIntoViewIfNeeded()
    await page.getByRole('tab', { name: 'Results' }).click()
    await page.getByRole('button', { name: 'Show the list of files' }).click()
    await page.locator('.sidebar .file').first().waitFor()
    await shot(page, `narrow-files-${width}`)
  })
}
