// What scenarios covered, a review found and nobody noticed: on the chart's shapes, in the text, as a list.

import { readFileSync, rmSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'

import type { Browser, Page } from 'playwright-core'
import { afterAll, afterEach, beforeAll, beforeEach, expect, test } from 'vitest'

import { type Trouble, opened, page as newPage, shape, shot } from './browser'
import { SCENARIO, lampBuilt } from './lamp'
import { type Served, copied, removed, served } from './served'

let browser: Browser
let studio: Served
let page: Page
const trouble: Trouble = { told: [] }

const path = (name: string): string => join(studio.folder, name)

beforeAll(async () => {
  const folder = copied()
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
  if (task.result?.state === 'fail') await shot(page, `failed: ${task.name}`.replace(/\W+/g, '-'))
  await page.context().close()
  expect(trouble.told).toEqual([])
})

async function start(job: string): Promise<void> {
  await page.getByRole('button', { name: 'More to do with this file' }).click()
  await page.getByRole('menuitem', { name: job, exact: true }).click()
}

const covered = (id: string, word: 'covered' | 'uncovered') => shape(page, id).locator(`.box.${word}`)

test('what scenarios covered is marked on the shapes, until the model is another', async () => {
  await start('Test')
  await covered('off', 'covered').waitFor({ timeout: 20_000 })
  await covered('pressed', 'covered').waitFor()
  await covered('count', 'covered').waitFor()
  await covered('on', 'uncovered').waitFor()
  await covered('held', 'uncovered').waitFor()
  expect(await shape(page, 'held').getAttribute('aria-label')).toContain('Not wholly covered')
  await page.locator('.covered .verdict').first().waitFor()
  await shot(page, 'coverage')
  await page.locator('.covered .verdict button').first().click()
  await page.locator('.cm-content', { hasText: 'asm Lamp' }).waitFor()
  // With a scenario that has the rest, all is covered.
  writeFileSync(path('Held.avalla'), `${SCENARIO.replace('Press', 'Held')}set held := false;\nstep\ncheck light = ON;\nset held := true;\nstep\ncheck light = OFF;\n`)
  await start('Test')
  await covered('held', 'covered').waitFor({ timeout: 20_000 })
  expect(await page.locator('.box.uncovered').count()).toBe(0)
  // Of another text nothing is known.
  const model = readFileSync(path('Lamp.asm'), 'utf8')
  writeFileSync(path('Lamp.asm'), model.replace('light := OFF', 'light := ON'))
  await page.locator('.box.covered').first().waitFor({ state: 'detached' })
  writeFileSync(path('Lamp.asm'), model)
})

test('of a rule that never ran nothing is covered', async () => {
  const model = readFileSync(path('Lamp.asm'), 'utf8')
  for (const name of ['Press.avalla', 'Held.avalla']) rmSync(path(name), { force: true })
  writeFileSync(path('Lamp.asm'), model.replace(/\tr_lamp\[\]/, '\tif held then r_lamp[] endif'))
  writeFileSync(path('Idle.avalla'), 'scenario Idle\nload Lamp.asm\nset held := false;\nstep\ncheck light = OFF;\n')
  await page.waitForTimeout(600)
  await start('Test')
  for (const id of ['off', 'on', 'pressed', 'held', 'count']) await covered(id, 'uncovered').waitFor({ timeout: 20_000 })
  expect(await page.locator('.box.covered').count()).toBe(0)
  rmSync(path('Idle.avalla'))
  writeFileSync(path('Lamp.asm'), model)
  writeFileSync(path('Press.avalla'), SCENARIO)
  await page.waitForTimeout(600)
})

test('mutants that nobody notices are marked on the shapes and lead to their place', async () => {
  rmSync(path('Held.avalla'), { force: true })
  await start('Mutate')
  await page.locator('.mutation').first().waitFor({ timeout: 50_000 })
  await shape(page, 'on').locator('.fault-badge').or(shape(page, 'held').locator('.fault-badge')).first().waitFor()
  await shot(page, 'mutants')
  await page.locator('.covered .told-place').first().click()
  await page.locator('.cm-lintRange-warning').first().waitFor()
})

test('what a review finds is marked on the shapes and leads to its place', async () => {
  writeFileSync(path('Lamp.asm'), readFileSync(path('Lamp.asm'), 'utf8').replace('if held then', 'if held and light = OFF then'))
  await start('Review')
  await page.getByRole('button', { name: 'Review the old model' }).click()
  await page.locator('.verdict', { hasText: 'MP3' }).first().waitFor({ timeout: 50_000 })
  await shape(page, 'on').locator('.fault-badge').waitFor()
  await shot(page, 'review')
})
