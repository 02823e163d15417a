// An exported project: charts, runs and verdicts without a program behind them; nothing can be changed.

import { execFileSync } from 'node:child_process'
import { writeFileSync } from 'node:fs'
import { join } from 'node:path'

import type { Browser, Page } from 'playwright-core'
import { afterAll, beforeAll, expect, test } from 'vitest'

import { type Trouble, opened, page as newPage, shape, shot } from './browser'
import { type Served, copied, exported, removed } from './served'

let browser: Browser
let site: Served
let page: Page
const trouble: Trouble = { told: [] }

beforeAll(async () => {
  const folder = copied('examples/mutual_exclusion')
  writeFileSync(
    join(folder, 'Lamp.chart'),
    'chart Lamp\n\nmachine lamp "Lamp"\n\tcontrol light\n\tinitial state off "Off"\n\tstate on "On"\n\tguard pressed "Pressed"\n\tguard bright "Bright" {light = ON}\n\toff -> pressed yes -> on\n\ton -> bright yes -> off\n\tpressed no -> off\n\tbright no -> on\nendmachine\n',
  )
  execFileSync(process.env['GROUNDSTATE'] ?? join(import.meta.dirname, '../../target/debug/groundstate'), ['chart', 'build', 'Lamp.chart'], { cwd: folder })
  site = await exported(folder)
  browser = await opened()
})

afterAll(async () => {
  await browser?.close()
  site?.stop()
  if (site) removed(site.folder)
})

test('a chart is looked at, and cannot be changed', async () => {
  trouble.told = []
  page = await newPage(browser, `${site.address}#/Lamp.chart`, trouble)
  await shape(page, 'off').waitFor()
  await page.locator('.state-chip', { hasText: 'Read only' }).waitFor()
  expect(await page.locator('.palette').count()).toBe(0)
  await shape(page, 'on').click()
  await page.locator('.inspector').waitFor()
  await page.locator('.cm-picked', { hasText: 'on' }).first().waitFor()
  await shot(page, 'exported')
  expect(trouble.told).toEqual([])
  await page.context().close()
})

test('a recorded run is stepped through', async () => {
  trouble.told = []
  page = await newPage(browser, `${site.address}#/mutual_exclusion/Peterson.asm`, trouble)
  await page.locator('.cm-content').waitFor()
  await page.keyboard.press('F5')
  await page.locator('.state-table').waitFor()
  await page.keyboard.press('F10')
  await page.locator('.run-step', { hasText: 'Step 1' }).waitFor()
  await page.keyboard.press('Shift+F10')
  await page.locator('.run-step', { hasText: 'Step 0' }).waitFor()
  await shot(page, 'exported-run')
  expect(trouble.told).toEqual([])
  await page.context().close()
})

test('the guards of a recorded run have their values on the chart', async () => {
  trouble.told = []
  page = await newPage(browser, `${site.address}#/Lamp.chart`, trouble)
  await shape(page, 'off').waitFor()
  await page.keyboard.press('F5')
  await page.locator('.state-table').waitFor()
  await shape(page, 'bright').locator('.value-badge.false').waitFor()
  for (let step = 0; step < 30 && !(await shape(page, 'bright').locator('.value-badge.true').isVisible()); step++) {
    await page.keyboard.press('F10')
    await page.waitForTimeout(40)
  }
  await shape(page, 'bright').locator('.value-badge.true').waitFor()
  await shape(page, 'on').locator('.box.lit').waitFor()
  await shot(page, 'exported-guards')
  expect(trouble.told).toEqual([])
  await page.context().close()
})
