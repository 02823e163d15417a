// Results of texts that are others now, models that are not those of their charts, and outcomes that say nothing of what was asked.

import { readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'

import type { Browser, Page } from 'playwright-core'
import { afterAll, afterEach, beforeAll, beforeEach, expect, test } from 'vitest'

import { type Trouble, opened, page as newPage, shape, shot } from './browser'
import { lampBuilt } from './lamp'
import { type Served, copied, removed, served } from './served'

let browser: Browser
let studio: Served
let page: Page
const trouble: Trouble = { told: [] }

const path = (name: string): string => join(studio.folder, name)

beforeAll(async () => {
  const folder = copied('examples', 'library')
  lampBuilt(folder)
  studio = await served(folder)
  browser = await opened()
})

afterAll(async () => {
  await browser?.close()
  studio?.stop()
  if (studio) removed(studio.folder)
})

beforeEach(async () => {
  trouble.told = []
  page = await newPage(browser, `${studio.address}#/Lamp.chart`, trouble)
  await shape(page, 'off').waitFor()
})

afterEach(async ({ task }) => {
  if (task.result?.state === 'fail') console.log(await page.locator('.notice').allTextContents())
  if (task.result?.state === 'fail') await shot(page, `failed: ${task.name}`.replace(/\W+/g, '-'))
  await page.context().close()
  expect(trouble.told).toEqual([])
})

async function start(job: string): Promise<void> {
  await page.getByRole('button', { name: 'More to do with this file' }).click()
  await page.getByRole('menuitem', { name: job, exact: true }).click()
}

const head = () => page.locator('.job header')

async function typed(line: string, text: string): Promise<void> {
  await page.locator('.cm-line', { hasText: line }).first().click()
  await page.keyboard.press('End')
  await page.keyboard.type(text)
}

test('a verdict says which text has changed since, and is current again when the text is what it was', async () => {
  await start('Verify')
  await head().locator('.outcome.good').waitFor({ timeout: 40_000 })
  expect(await page.locator('.job-time').first().textContent()).toMatch(/^\d\d:\d\d$/)
  await page.locator('.verdict', { hasText: 'every guard and operation is defined' }).waitFor()
  await typed('state on', ' // bright')
  await head().locator('.currency', { hasText: 'Lamp.chart has changed since' }).waitFor()
  expect(await head().locator('.outcome.good').count()).toBe(0)
  expect(await head().getByRole('button', { name: 'Again' }).getAttribute('class')).toContain('primary')
  await shot(page, 'older-verdict')
  await page.keyboard.press('Control+z')
  await head().locator('.outcome.good').waitFor()
  expect(await head().locator('.currency').count()).toBe(0)
  // The model, which is not open, is written by another program.
  const model = readFileSync(path('Lamp.asm'), 'utf8')
  writeFileSync(path('Lamp.asm'), `${model}\n// more\n`)
  await head().locator('.currency', { hasText: 'Lamp.asm has changed since' }).waitFor()
  writeFileSync(path('Lamp.asm'), model)
  await head().locator('.outcome.good').waitFor()
})

test('the model of a chart that has changed is not taken for the chart’s', async () => {
  const [chart, model] = [readFileSync(path('Lamp.chart'), 'utf8'), readFileSync(path('Lamp.asm'), 'utf8')]
  await typed('pressed no -> off', '')
  await page.keyboard.press('Home')
  await page.keyboard.press('Shift+End')
  await page.keyboard.type('pressed no -> on')
  await page.locator('.state-chip', { hasText: /^Saved$/ }).waitFor()
  await start('Verify')
  const dialog = page.getByRole('dialog', { name: 'Lamp.asm is not the model of Lamp.chart as it is drawn' })
  await dialog.waitFor()
  await shot(page, 'older-model')
  await dialog.getByRole('button', { name: 'Verify the old model' }).click()
  await head().locator('.currency', { hasText: 'an older model than the chart’s' }).waitFor()
  // A run of it is the same question.
  await page.keyboard.press('F5')
  await dialog.getByRole('button', { name: 'Run the old model' }).click()
  await page.locator('.run-what', { hasText: 'an older model than the chart’s' }).waitFor()
  await page.getByRole('tab', { name: 'Results' }).click()
  // Once more the same is what was decided; a new one is a new question.
  await head().getByRole('button', { name: 'Again' }).click()
  await page.locator('.job-list li').nth(1).waitFor()
  await head().locator('.currency', { hasText: 'an older model than the chart’s' }).waitFor()
  await start('Verify')
  await dialog.getByRole('button', { name: 'Build and verify' }).click()
  // Verified twice, built, verified.
  await page.locator('.job-list li').nth(3).waitFor({ timeout: 40_000 })
  await head().locator('h3', { hasText: 'Verify' }).waitFor()
  await head().locator('.outcome.good, .outcome.bad').first().waitFor({ timeout: 40_000 })
  expect(await head().locator('.currency').count()).toBe(0)
  expect(readFileSync(path('Lamp.asm'), 'utf8')).not.toBe(model)
  // A chart with a fault cannot be built.
  writeFileSync(path('Lamp.chart'), chart.replace('held yes -> off', 'held yes -> nowhere'))
  await page.locator('.file.on .fault-dot.error').waitFor()
  await start('Verify')
  await dialog.getByRole('button', { name: 'Show the faults' }).click()
  await page.locator('.problem', { hasText: 'nowhere' }).first().waitFor()
  await shot(page, 'older-faulty')
  writeFileSync(path('Lamp.chart'), chart)
  writeFileSync(path('Lamp.asm'), model)
})

test('what compares and builds says what came of it', async () => {
  await start('Compare with model')
  await page.locator('.job .note', { hasText: 'Chart and model agree.' }).waitFor({ timeout: 20_000 })
  await start('Build model')
  await page.locator('.job .note', { hasText: 'Lamp.asm is built from Lamp.chart.' }).waitFor({ timeout: 20_000 })
  await start('Generate C++')
  await page.locator('.job .note', { hasText: 'The C++ is in Lamp.generated.' }).waitFor({ timeout: 40_000 })
  await shot(page, 'generated-told')
  await page.getByRole('button', { name: 'Show it' }).click()
  await page.locator('.code-panel').waitFor()
})

test('scenarios of another model say nothing of this one', async () => {
  await page.goto(`${studio.address}#/examples/press_cell/Press.asm`)
  await page.reload()
  await page.locator('.joined').getByRole('button', { name: 'More to do with this file' }).click()
  await page.getByRole('menuitem', { name: 'Test', exact: true }).click()
  await page.locator('.job .note', { hasText: 'No scenario beside it loads Press.asm; 2 of PressCell.asm passed.' }).waitFor({ timeout: 40_000 })
  expect(await head().locator('.outcome.good').count()).toBe(0)
  await shot(page, 'elsewhere')
})
