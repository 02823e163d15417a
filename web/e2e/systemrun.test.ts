// The counterexample of a system: lanes of its tasks, what happens in a step, the chart lit, values by part.

import { writeFileSync } from 'node:fs'
import { join } from 'node:path'

import type { Browser, Page } from 'playwright-core'
import { afterAll, afterEach, beforeAll, beforeEach, expect, test } from 'vitest'

import { type Trouble, opened, page as newPage, shape, shot } from './browser'
import { LATE } from './late'
import { type Served, copied, removed, served } from './served'

let browser: Browser
let studio: Served
let page: Page
const trouble: Trouble = { told: [] }

beforeAll(async () => {
  studio = await served(copied())
  writeFileSync(join(studio.folder, 'Late.chart'), LATE)
  browser = await opened()
})

afterAll(async () => {
  await browser?.close()
  studio?.stop()
  if (studio) removed(studio.folder)
})

beforeEach(async () => {
  trouble.told = []
})

afterEach(async ({ task }) => {
  if (task.result?.state === 'fail') await shot(page, `failed: ${task.name}`.replace(/\W+/g, '-'))
  await page.context().close()
  expect(trouble.told).toEqual([])
})

async function played(width: number): Promise<void> {
  page = await newPage(browser, `${studio.address}#/Late.chart`, trouble, { width })
  await shape(page, 'sensing').waitFor()
  await page.getByRole('button', { name: 'Verify', exact: true }).click()
  const verdict = page.locator('.verdict', { hasText: 'inv_age1' })
  await verdict.filter({ hasText: 'violated' }).waitFor({ timeout: 40_000 })
  await verdict.getByRole('button', { name: /^Play its/ }).click()
}

const lit = (phase: string) => page.locator('.row-lit', { hasText: phase })

test('a counterexample of a system shows what its tasks do, and when', async () => {
  await played(1400)
  const player = page.locator('.player.of-system')
  await player.getByText('Violated: the data that arrive are no older than the chart allows.').waitFor()
  await player.getByText('Nothing has begun yet.').waitFor()
  const lane = (task: string) => player.locator('.lane', { hasText: task })
  await lane('Sensing').locator('.work', { hasText: 'elaborate acquire' }).first().waitFor()
  await lane('Control').locator('.wait').first().waitFor()
  // The first step begins both tasks; the chart and the words say the same.
  const on = page.getByRole('button', { name: 'One step on' })
  await on.click()
  await player.locator('.run-step', { hasText: '0.5 ms' }).waitFor()
  const happened = player.getByRole('list', { name: 'In this step' })
  expect(await happened.locator('li').allInnerTexts()).toEqual(['Sensing begins: elaborate acquire', 'Control begins: read position', 'Control asks for the lock of position'])
  await lit('elaborate acquire').waitFor()
  await lit('read position').waitFor()
  // A click on a lane goes to that time.
  const track = lane('Sensing').locator('.lane-track')
  const { width } = (await track.boundingBox()) ?? { width: 0 }
  await track.click({ position: { x: width - 2, y: 9 } })
  await player.getByText('Here the property does not hold.').waitFor()
  await happened.locator('.bad', { hasText: 'Control gets data that are older than the chart allows' }).waitFor()
  expect(await on.isDisabled()).toBe(true)
  await shot(page, 'system-counterexample')
  // Values stand by part, without what never changes.
  const headings = player.locator('tr.part')
  expect(await headings.allInnerTexts()).toEqual(expect.arrayContaining(['Sensing', 'Control', 'position']))
  const row = player.locator('th', { hasText: 'task_period(control_task)' })
  expect(await row.count()).toBe(0)
  await player.getByLabel('Show the locations that never change, too').check()
  await row.first().waitFor()
  // A property that no file of the folder holds leads nowhere.
  expect(await page.locator('.verdict', { hasText: 'inv_deadlines' }).locator('.link-button').count()).toBe(0)
})

test('it can be read in a narrow window', async () => {
  await played(360)
  const player = page.locator('.player.of-system')
  await player.locator('.lane-track').nth(1).scrollIntoViewIfNeeded()
  await player.getByRole('button', { name: 'One step on' }).click()
  await shot(page, 'system-counterexample-narrow')
  const { width } = (await player.locator('.lane-track').nth(1).boundingBox()) ?? { width: 0 }
  expect(width).toBeGreaterThan(180)
  const wide = await page.evaluate(() => document.documentElement.scrollWidth)
  expect(wide).toBeLessThanOrEqual(360)
})
