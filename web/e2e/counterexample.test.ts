// A counterexample as a run: on the chart, on the timeline, as a file.

import { existsSync, readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'

import type { Browser, Page } from 'playwright-core'
import { afterAll, afterEach, beforeAll, beforeEach, expect, test } from 'vitest'

import { type Trouble, opened, page as newPage, shape, shot } from './browser'
import { DOOR, MODEL } from './door'
import { type Served, copied, removed, served } from './served'

let browser: Browser
let studio: Served
let page: Page
const trouble: Trouble = { told: [] }

const path = (name: string): string => join(studio.folder, name)

beforeAll(async () => {
  studio = await served(copied())
  writeFileSync(path('Door.chart'), DOOR)
  writeFileSync(path('Door.asm'), MODEL)
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
  if (task.result?.state === 'fail') console.log(await page.locator('.notice').allTextContents())
  if (task.result?.state === 'fail') await shot(page, `failed: ${task.name}`.replace(/\W+/g, '-'))
  await page.context().close()
  expect(trouble.told).toEqual([])
})

const litNow = (id: string) => page.locator(`.react-flow__node[data-id="${id}"] .lit`).first()

test('a counterexample runs on the chart and the timeline, and is kept as a scenario', async () => {
  await page.getByRole('button', { name: 'Verify', exact: true }).click()
  await page.getByRole('button', { name: 'Verify the old model' }).click()
  const verdict = page.locator('.verdict', { hasText: 'inv_gentle' })
  await verdict.filter({ hasText: 'violated' }).waitFor({ timeout: 40_000 })
  await verdict.getByRole('button', { name: 'Run it' }).click()
  // It begins in the initial state, which is there at once.
  await page.locator('.run-step', { hasText: 'Step 0' }).waitFor()
  await page.locator('.state-table tr', { hasText: 'force' }).waitFor()
  await litNow('shut').waitFor()
  // Sets before the first step are part of the initial state.
  expect(await page.locator('.script .next').innerText()).toBe('step')
  for (let line = 0; line < 40 && !(await page.locator('.run-wait', { hasText: 'failed' }).isVisible()); line++) {
    await page.keyboard.press('F10')
    await page.waitForTimeout(80)
  }
  await page.locator('.run-wait', { hasText: 'failed' }).waitFor()
  await litNow('open').waitFor()
  await page.locator('.state-table tr', { hasText: 'force' }).filter({ hasText: /[34]/ }).waitFor()
  await page.locator('.changes .fault-line', { hasText: 'inv_gentle' }).waitFor()
  await shot(page, 'counterexample-run')
  // Back to the beginning, and on again: the same.
  await page.getByRole('button', { name: 'Step back (Shift F10)' }).click()
  await page.locator('.run-wait', { hasText: 'Ready' }).waitFor()
  await page.getByRole('tab', { name: 'Timeline' }).click()
  await page.locator('.timeline #detail').locator('path, rect').first().waitFor()
  await shot(page, 'counterexample-timeline')
  await page.getByRole('tab', { name: 'Run', exact: true }).click()
  await page.getByRole('button', { name: 'Save as a scenario' }).click()
  await page.locator('.notice', { hasText: 'DoorRun1' }).waitFor()
  expect(existsSync(path('DoorRun1.avalla'))).toBe(true)
  expect(readFileSync(path('DoorRun1.avalla'), 'utf8')).toContain('pick $f in r_Main')
})

test('a counterexample of a model that is gone says so', async () => {
  await page.getByRole('button', { name: 'Verify', exact: true }).click()
  await page.getByRole('button', { name: 'Verify the old model' }).click()
  const verdict = page.locator('.verdict', { hasText: 'inv_gentle' })
  await verdict.filter({ hasText: 'violated' }).waitFor({ timeout: 40_000 })
  // The model is another meanwhile: what the scenario chooses is not there any more.
  writeFileSync(path('Door.asm'), MODEL.replace('choose $f in', 'choose $g in').replaceAll('$f', '$g'))
  await verdict.getByRole('button', { name: 'Run it' }).click()
  await page.locator('.notice.refused').waitFor()
  expect(await page.locator('.notice.refused').innerText()).toContain('has errors')
  expect(await page.locator('.state-table').count()).toBe(0)
  writeFileSync(path('Door.asm'), MODEL)
})

test('a run at random is recorded with its choices and inputs, and passes as a scenario', async () => {
  await page.getByRole('tab', { name: 'Run', exact: true }).click()
  await page.getByRole('button', { name: 'Run with random inputs' }).click()
  await page.getByRole('button', { name: 'Run the old model' }).click()
  await page.locator('.run-step', { hasText: 'Step 0' }).waitFor()
  // Many steps at a time are as many steps of the scenario.
  await page.getByLabel('Speed', { exact: true }).selectOption({ label: 'As fast as can be' })
  await page.getByRole('button', { name: 'Run (F5)' }).click()
  await page.locator('.run-wait', { hasText: /violation|fault/ }).waitFor({ timeout: 20_000 })
  // The step that broke the invariant was made; it is taken back, so that the rest passes.
  await page.getByRole('button', { name: 'Step back (Shift F10)' }).click()
  await page.locator('.run-wait', { hasText: 'Ready' }).waitFor()
  const steps = Number(/\d+/.exec(await page.locator('.run-step').innerText())?.[0])
  await page.getByRole('button', { name: 'Record as a scenario' }).click()
  await page.locator('.notice', { hasText: 'plays this run again' }).waitFor()
  const name = /DoorRun\d+/.exec(await page.locator('.notice').innerText())?.[0]
  const text = readFileSync(path(`${name}.avalla`), 'utf8')
  expect(text.split('\n').filter((line) => line === 'step').length).toBe(steps)
  expect(text).toContain('pick $f in r_Main')
  await page.goto(`${studio.address}#/${name}.avalla`)
  await page.reload()
  await page.locator('.joined').getByRole('button', { name: 'Test', exact: true }).click()
  await page.locator('.verdict', { hasText: 'passed' }).waitFor({ timeout: 20_000 })
})
