// Machines of a chart that get another name, and go: in the picture, with what names them.

import { existsSync, readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'

import type { Browser, Page } from 'playwright-core'
import { afterAll, afterEach, beforeAll, beforeEach, expect, test } from 'vitest'

import { type Trouble, opened, page as newPage, shape, shot } from './browser'
import { type Served, copied, removed, served } from './served'

const TOOLS = `chart Tools

pattern grip "Grip" // closes
	action close "CLOSE"
	enter -> close -> exit
endpattern

// The arm of the cell.
machine arm "Arm"
	control arm
	initial state up "Up"
	instance hold of grip "HOLD"
	state down "Down"
	up -> hold -> down
endmachine

layout grip
	close at 120, 120
endlayout
`

const CELL = `chart Cell

import "Tools.chart"

machine cell "Cell"
	control cell
	initial state idle "Idle"
	instance take of grip "TAKE"
	idle -> take -> idle
endmachine
`

let browser: Browser
let studio: Served
let page: Page
const trouble: Trouble = { told: [] }

const path = (name: string): string => join(studio.folder, name)
const text = (name: string): string => (existsSync(path(name)) ? readFileSync(path(name), 'utf8') : '')

async function until(holds: () => boolean | Promise<boolean>, what: () => string): Promise<void> {
  for (let tries = 0; tries < 160; tries++) {
    if (await holds()) return
    await new Promise((done) => setTimeout(done, 50))
  }
  throw new Error(`it never came: ${what()}`)
}

const holds = (name: string, whole: string): Promise<void> => until(() => text(name) === whole, () => text(name))

beforeAll(async () => {
  browser = await opened()
})

afterAll(async () => {
  await browser?.close()
})

beforeEach(async () => {
  trouble.told = []
  studio = await served(copied())
  writeFileSync(path('Tools.chart'), TOOLS)
  writeFileSync(path('Cell.chart'), CELL)
  page = await newPage(browser, `${studio.address}#/Tools.chart`, trouble)
  await shape(page, 'close').waitFor()
})

afterEach(async ({ task }) => {
  if (task.result?.state === 'fail') await shot(page, `failed: ${task.name}`.replace(/\W+/g, '-'))
  await page.context().close()
  studio.stop()
  removed(studio.folder)
  expect(trouble.told).toEqual([])
})

const tab = (name: string) => page.getByRole('tablist', { name: 'Drawings' }).getByRole('tab', { name, exact: true })

test('a pattern gets another name wherever it is named, and undo takes it back', async () => {
  await tab('Grip').click({ button: 'right' })
  await page.getByRole('menu', { name: 'What to do with Grip' }).waitFor()
  await shot(page, 'machine-menu')
  await page.getByRole('menuitem', { name: 'Rename…' }).click()
  const dialog = page.getByRole('dialog', { name: 'Rename Grip' })
  const name = dialog.getByLabel('Name', { exact: true })
  const rename = dialog.getByRole('button', { name: 'Rename', exact: true })
  for (const taken of ['arm', 'cell', 'endpattern']) {
    await name.fill(taken)
    await dialog.getByText('Another machine, or a word of charts, has this name.').waitFor()
    expect(await rename.isDisabled()).toBe(true)
  }
  await name.fill('clamp')
  await dialog.getByLabel('Title').fill('The "clamp"')
  await dialog.locator('.named', { hasText: 'Changed with it' }).getByText('Cell.chart').waitFor()
  await shot(page, 'machine-rename')
  await rename.click()
  await dialog.waitFor({ state: 'detached' })
  await holds('Tools.chart', TOOLS.replace('pattern grip "Grip"', 'pattern clamp "The \\"clamp\\""').replace('of grip', 'of clamp').replace('layout grip', 'layout clamp'))
  await holds('Cell.chart', CELL.replace('of grip', 'of clamp'))
  // It is the same drawing that is shown, and nothing is at fault.
  await shape(page, 'close').waitFor()
  expect(await tab('The "clamp"').getAttribute('aria-selected')).toBe('true')
  await page.getByRole('tab', { name: /^Problems/ }).click()
  await page.locator('.problems').waitFor()
  expect(await page.locator('.problem', { hasText: 'there is no pattern' }).count()).toBe(0)
  await page.locator('.canvas').focus()
  await page.keyboard.press('Control+z')
  await holds('Tools.chart', TOOLS)
  await tab('Grip').waitFor()
  expect(await tab('Grip').getAttribute('aria-selected')).toBe('true')
})

test('a machine that nothing names goes from the picture, and comes back', async () => {
  await tab('Arm').click()
  await shape(page, 'hold').waitFor()
  await tab('Arm').press('Delete')
  const dialog = page.getByRole('dialog', { name: 'Delete Arm?' })
  await dialog.getByRole('button', { name: 'Cancel' }).waitFor()
  expect(await dialog.locator('.named').count()).toBe(0)
  await dialog.getByRole('button', { name: 'Delete', exact: true }).click()
  await tab('Arm').waitFor({ state: 'detached' })
  await until(() => !text('Tools.chart').includes('endmachine'), () => text('Tools.chart'))
  expect(text('Tools.chart')).toContain('endpattern\n\n// The arm of the cell.\nlayout grip\n')
  await shape(page, 'close').waitFor()
  await page.locator('.notice', { hasText: 'arm is deleted.' }).getByRole('button', { name: 'Undo' }).click()
  await holds('Tools.chart', TOOLS)
  await tab('Arm').waitFor()
})

test('a pattern that blocks are of is deleted only with a warning, and the blocks are at fault', async () => {
  await page.getByLabel('Rename or delete this drawing').click()
  await page.getByRole('menuitem', { name: 'Delete…' }).click()
  const dialog = page.getByRole('dialog', { name: 'Delete Grip?' })
  const missed = dialog.locator('.named', { hasText: 'Still names it, and will be at fault' })
  await missed.getByText('Tools.chart').waitFor()
  await missed.getByText('Cell.chart').waitFor()
  await shot(page, 'machine-delete')
  await dialog.getByRole('button', { name: 'Delete', exact: true }).click()
  await until(() => !text('Tools.chart').includes('pattern'), () => text('Tools.chart'))
  expect(text('Tools.chart')).not.toContain('layout')
  await page.locator('.panel-tabs .count').waitFor()
  await page.getByRole('tab', { name: /^Problems/ }).click()
  await page.locator('.problem', { hasText: 'there is no pattern `grip`' }).first().waitFor()
  await tab('Arm').waitFor()
})

test('the last machine goes, and the chart has none', async () => {
  writeFileSync(path('Cell.chart'), 'chart Cell\n\nmachine cell\n\tcontrol cell\n\tinitial state idle\nendmachine\n')
  await page.goto(`${studio.address}#/Cell.chart`)
  await page.reload()
  await shape(page, 'idle').waitFor()
  await page.keyboard.press('Control+k')
  await page.keyboard.type('delete this machine')
  await page.getByRole('option', { name: /Delete this machine/ }).click()
  await page.getByRole('dialog').getByRole('button', { name: 'Delete', exact: true }).click()
  await page.getByText('This chart has no machine yet').waitFor()
  await holds('Cell.chart', 'chart Cell\n')
  // Another one may have its name.
  await page.locator('.empty-card').getByRole('button', { name: 'New machine' }).click()
  await page.getByLabel('Name', { exact: true }).fill('cell')
  await page.getByRole('button', { name: 'Create' }).click()
  await tab('Cell').waitFor()
})
