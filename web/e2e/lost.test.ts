// What is typed is not lost: it is written while typing goes on, kept where it cannot be written, and offered again by the next page.

import { existsSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
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
const file = (): string => (existsSync(path('Lamp.chart')) ? readFileSync(path('Lamp.chart'), 'utf8') : '')
let chart = ''

async function until(holds: () => boolean, what: string): Promise<void> {
  for (let tries = 0; tries < 160; tries++) {
    if (holds()) return
    await new Promise((done) => setTimeout(done, 50))
  }
  throw new Error(`it never came: ${what}`)
}

beforeAll(async () => {
  const folder = copied()
  lampBuilt(folder)
  studio = await served(folder)
  chart = file()
  browser = await opened()
})

afterAll(async () => {
  await browser?.close()
  studio?.stop()
  if (studio) removed(studio.folder)
})

beforeEach(async () => {
  trouble.told = []
  writeFileSync(path('Lamp.chart'), chart)
  page = await newPage(browser, `${studio.address}#/Lamp.chart`, trouble)
  await shape(page, 'off').waitFor()
})

afterEach(async ({ task }) => {
  if (task.result?.state === 'fail') await shot(page, `failed: ${task.name}`.replace(/\W+/g, '-'))
  await page.context().close()
  studio.cut(false)
  expect(trouble.told.filter((told) => !/WebSocket|ERR_|403/.test(told))).toEqual([])
})

async function typed(line: string, text: string, delay = 0): Promise<void> {
  await page.locator('.cm-line', { hasText: line }).first().click()
  await page.keyboard.press('End')
  await page.keyboard.type(text, { delay })
}

const chip = (text: string) => page.locator('.state-chip', { hasText: text }).first()

test('who types without a pause is saved all the same', async () => {
  const typing = typed('state on', ` // ${'x'.repeat(40)}`, 90)
  await until(() => file().includes(' // x'), 'a part of it in the file')
  expect(file()).not.toContain('x'.repeat(40))
  await typing
  await until(() => file().includes('x'.repeat(40)), 'all of it in the file')
})

test('what is typed is written when the page is hidden', async () => {
  await typed('state on', ' // hidden')
  await page.evaluate(() => {
    Object.defineProperty(document, 'visibilityState', { value: 'hidden', configurable: true })
    document.dispatchEvent(new Event('visibilitychange'))
  })
  await until(() => file().includes('// hidden'), 'it in the file')
})

test('a text that could not be written is there again after the page was loaded anew', async () => {
  studio.cut(true)
  await page.locator('.banner', { hasText: 'groundstate studio' }).waitFor()
  await typed('state on', ' // kept')
  await chip('Offline').waitFor()
  await shot(page, 'lost-banner')
  await page.getByRole('button', { name: 'Copy my text' }).click()
  expect(await page.evaluate(() => navigator.clipboard.readText())).toContain('// kept')
  let asked = ''
  page.once('dialog', (dialog) => {
    asked = dialog.type()
    void dialog.accept()
  })
  await page.waitForTimeout(500)
  studio.cut(false)
  // The page that goes has no connection yet, or none any more.
  studio.cut(true)
  const loads = page.reload()
  await page.waitForTimeout(300)
  studio.cut(false)
  await loads
  expect(asked).toBe('beforeunload')
  await page.locator('.cm-line', { hasText: '// kept' }).waitFor({ timeout: 20_000 })
  await until(() => file().includes('// kept'), 'it in the file')
})

test('both sides of a conflict are there again after the page was loaded anew', async () => {
  await typed('action count', ' // mine')
  writeFileSync(path('Lamp.chart'), chart.replace('"COUNT"', '"ADD"'))
  await page.locator('.conflict', { hasText: 'this browser keeps your text' }).waitFor()
  await page.locator('.conflict .cm-merge-a .cm-line', { hasText: '// mine' }).click()
  await page.keyboard.press('End')
  await page.keyboard.type(' and more')
  await page.reload()
  await page.locator('.conflict .cm-merge-a .cm-line', { hasText: '// mine and more' }).waitFor()
  await page.locator('.conflict .cm-merge-b .cm-line', { hasText: '"ADD"' }).waitFor()
  await shot(page, 'lost-conflict')
  await page.getByRole('button', { name: 'Keep my text' }).click()
  await until(() => file().includes('// mine and more'), 'it in the file')
  // What is in the file is kept no longer.
  await chip('Saved').waitFor()
  expect(await page.evaluate(() => Object.keys(localStorage).filter((key) => key.startsWith('groundstate-kept')))).toEqual([])
})

test('a file that is gone is closed only when asked, and its text is offered by the next page', async () => {
  rmSync(path('Lamp.chart'))
  await chip('File is gone').waitFor()
  await typed('state on', ' // alone')
  await page.getByRole('button', { name: 'Close Lamp.chart' }).click()
  const dialog = page.getByRole('dialog', { name: 'What you typed in Lamp.chart is in no file' })
  await shot(page, 'lost-closing')
  await dialog.getByRole('button', { name: 'Keep it open' }).click()
  await page.locator('.cm-line', { hasText: '// alone' }).waitFor()
  await page.waitForTimeout(600)
  await page.goto(`${studio.address}#/`)
  await page.reload()
  await page.locator('.banner', { hasText: 'Lamp.chart' }).waitFor()
  await shot(page, 'lost-waiting')
  await page.getByRole('button', { name: 'Write Lamp.chart again' }).click()
  await until(() => file().includes('// alone'), 'it in the file')
  await page.locator('.banner').waitFor({ state: 'detached' })
  // Given up, it is gone.
  rmSync(path('Lamp.chart'))
  await chip('File is gone').waitFor()
  await page.getByRole('button', { name: 'Close Lamp.chart' }).click()
  await dialog.getByRole('button', { name: 'Discard my text' }).click()
  await page.locator('.tab').waitFor({ state: 'detached' })
  await page.reload()
  await page.locator('.bench').waitFor()
  expect(await page.locator('.banner').count()).toBe(0)
})

test('a studio that was started anew is told from one that is not there', async () => {
  await page.route('**/', (route) => route.fulfill({ status: 403, body: '' }))
  studio.cut(true)
  await page.locator('.banner', { hasText: 'The studio was started anew' }).waitFor()
  await shot(page, 'lost-anew')
  // It knows the page again: the banner goes.
  await page.unroute('**/')
  studio.cut(false)
  await page.locator('.banner').waitFor({ state: 'detached', timeout: 20_000 })
})
