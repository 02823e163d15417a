// Reports on paper: nothing reaches beyond the margin of a page.

import { spawnSync } from 'node:child_process'
import { join, resolve } from 'node:path'

import { type Browser } from 'playwright-core'
import { afterAll, beforeAll, expect, test } from 'vitest'

import { opened } from './browser'
import { copied, removed } from './served'

const ROOT = resolve(import.meta.dirname, '../..')
const PROGRAM = process.env['GROUNDSTATE'] ?? join(ROOT, 'target/debug/groundstate')
// A4 with margins of a centimetre, in CSS pixels.
const PAGE = 718

let browser: Browser
let folder: string

beforeAll(async () => {
  folder = copied()
  browser = await opened()
})

afterAll(async () => {
  await browser?.close()
  removed(folder)
})

async function beyond(name: string): Promise<string[]> {
  const page = await browser.newPage({ viewport: { width: PAGE, height: 1000 } })
  await page.goto(`file://${join(folder, name)}`)
  await page.emulateMedia({ media: 'print' })
  const found = await page.evaluate(() => {
    const wide = [...document.querySelectorAll('table, pre, svg')].filter((one) => one.getBoundingClientRect().right > document.documentElement.clientWidth + 1)
    return wide.map((one) => `${one.tagName} in ${one.closest('section')?.querySelector('h2')?.textContent}`)
  })
  await page.close()
  return found
}

// Mutants that survive are no failure here.
const made = (words: string[]): unknown => spawnSync(PROGRAM, words, { cwd: join(ROOT, 'examples/visual_servoing') })

test('the tables of a report fit on a page', async () => {
  made(['report', 'CompleteController.asm', '--steps', '200', '--seed', '1', '-o', join(folder, 'report.html')])
  expect(await beyond('report.html')).toEqual([])
})

test('so do the texts of a report on mutants', async () => {
  made(['mutate', 'VisualServoingComponent.asm', '--page', join(folder, 'mutants.html')])
  expect(await beyond('mutants.html')).toEqual([])
})
