// Files that are made, renamed, deleted and put back, and what names them.

import { existsSync, readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'

import type { Browser, Page } from 'playwright-core'
import { afterAll, afterEach, beforeAll, beforeEach, expect, test } from 'vitest'

import { type Trouble, opened, page as newPage, shape, shot } from './browser'
import { MODEL } from './door'
import { lampBuilt } from './lamp'
import { type Served, copied, removed, served } from './served'

const ROOM = `asm Room
import Lamp
// Lamp.asm has the lamp.
signature:
definitions:
	rule r_nothing = skip
`

// Its rule is in control-state form, and nobody drew it.
const GATE = `asm Gate
import StandardLibrary
signature:
	enum domain GateState = { SHUT | OPEN }
	controlled gate: GateState
	monitored train: Boolean
definitions:
	main rule r_Main =
		switch gate
			case SHUT: if not train then gate := OPEN endif
			case OPEN: if train then gate := SHUT endif
		endswitch
default init s0:
	function gate = OPEN
`

let browser: Browser
let studio: Served
let page: Page
const trouble: Trouble = { told: [] }

const path = (name: string): string => join(studio.folder, name)
const text = (name: string): string => (existsSync(path(name)) ? readFileSync(path(name), 'utf8') : '')

async function until(holds: () => boolean | Promise<boolean>, what: string): Promise<void> {
  for (let tries = 0; tries < 160; tries++) {
    if (await holds()) return
    await new Promise((done) => setTimeout(done, 50))
  }
  throw new Error(`it never came: ${what}`)
}

beforeAll(async () => {
  browser = await opened()
})

afterAll(async () => {
  await browser?.close()
})

beforeEach(async () => {
  trouble.told = []
  const folder = copied()
  lampBuilt(folder)
  writeFileSync(join(folder, 'Room.asm'), ROOM)
  writeFileSync(join(folder, 'Door.asm'), MODEL)
  writeFileSync(join(folder, 'Gate.asm'), GATE)
  studio = await served(folder)
  page = await newPage(browser, `${studio.address}#/Lamp.chart`, trouble)
  await shape(page, 'off').waitFor()
})

afterEach(async ({ task }) => {
  if (task.result?.state === 'fail') await shot(page, `failed: ${task.name}`.replace(/\W+/g, '-'))
  await page.context().close()
  studio.stop()
  removed(studio.folder)
  expect(trouble.told).toEqual([])
})

const listed = (name: string) => page.locator('.sidebar .file', { hasText: name })
const dialog = () => page.locator('dialog.frame')

test('a chart gets another name with its model, and what names it follows', async () => {
  // Typed, and undone under the new name.
  await page.locator('.cm-line', { hasText: 'state on' }).click()
  await page.keyboard.press('End')
  await page.keyboard.type(' // bright')
  await listed('Lamp.chart').focus()
  await page.keyboard.press('F2')
  await dialog().locator('.named', { hasText: 'Room.asm line 2' }).waitFor()
  await dialog().locator('.named', { hasText: 'Room.asm line 3' }).waitFor()
  await shot(page, 'rename-file')
  await dialog().getByRole('textbox').fill('Bulb 2')
  await dialog().locator('.note.bad').waitFor()
  await dialog().getByRole('textbox').fill('Bulb')
  await page.keyboard.press('Enter')
  await page.locator('.tab.on', { hasText: 'Bulb.chart' }).waitFor()
  await shape(page, 'off').waitFor()
  expect([existsSync(path('Lamp.chart')), existsSync(path('Lamp.asm'))]).toEqual([false, false])
  await until(() => text('Bulb.chart').startsWith('chart Bulb\n') && text('Bulb.chart').includes('// bright'), 'the chart')
  await until(() => text('Bulb.asm').includes('\nasm Bulb\n') && text('Press.avalla').includes('load Bulb.asm'), 'model and scenario')
  await until(() => text('Room.asm').includes('import Bulb\n') && text('Room.asm').includes('// Lamp.asm'), 'the import')
  await page.getByRole('tab', { name: /Problems/ }).click()
  await until(async () => !/`Lamp|Lamp.asm/.test((await page.locator('.panel').innerText()) || 'Lamp.asm'), 'no fault of the former name')
  expect(decodeURIComponent(page.url())).toContain('#/Bulb.chart')
  // What was typed before can still be undone.
  await page.locator('.cm-content').first().focus()
  await page.keyboard.press('Control+z')
  await page.keyboard.press('Control+z')
  await until(() => text('Bulb.chart').startsWith('chart Lamp\n') && !text('Bulb.chart').includes('bright'), 'undone')
  await page.keyboard.press('Control+y')
  await until(() => text('Bulb.chart').includes('// bright'), 'done again')
})

test('no name is taken from another file, and other windows follow', async () => {
  const other = await newPage(browser, `${studio.address}#/Door.asm`, trouble)
  await other.locator('.cm-line', { hasText: 'asm Door' }).waitFor()
  await listed('Door.asm').click({ button: 'right' })
  await page.getByRole('menuitem', { name: 'Rename…' }).click()
  await dialog().getByRole('textbox').fill('Room')
  // What names it is known only a little later.
  await dialog().locator('button[type=submit]:enabled').waitFor()
  await page.keyboard.press('Enter')
  await page.locator('.notice.refused', { hasText: 'Room.asm is there already' }).waitFor()
  expect(text('Room.asm')).toBe(ROOM)
  await dialog().getByRole('textbox').fill('Portal')
  await page.keyboard.press('Enter')
  await other.locator('.tab.on', { hasText: 'Portal.asm' }).waitFor()
  await other.locator('.cm-line', { hasText: 'asm Portal' }).waitFor()
  await other.locator('.cm-content').first().click()
  await other.keyboard.press('Control+Home')
  await other.keyboard.type('// typed there\n')
  await until(() => text('Portal.asm').startsWith('// typed there\nasm Portal'), 'what the other window typed')
  expect(existsSync(path('Door.asm'))).toBe(false)
  await other.context().close()
})

test('a file is deleted after a question, and put back', async () => {
  const before = text('Lamp.asm')
  await listed('Lamp.asm').focus()
  await page.keyboard.press('Delete')
  await dialog().locator('.named', { hasText: 'Press.avalla line 2' }).waitFor()
  await shot(page, 'delete-file')
  await page.keyboard.press('Escape')
  expect(text('Lamp.asm')).toBe(before)
  await listed('Lamp.asm').focus()
  await page.keyboard.press('Delete')
  await dialog().getByRole('button', { name: 'Delete' }).click()
  await until(() => !existsSync(path('Lamp.asm')), 'deleted')
  await page.locator('.deleted li', { hasText: 'Lamp.asm' }).waitFor()
  await shot(page, 'deleted-file')
  await page.getByRole('button', { name: 'Put Lamp.asm back' }).click()
  await until(() => text('Lamp.asm') === before, 'put back')
  await page.locator('.tab.on', { hasText: 'Lamp.asm' }).waitFor()
  expect(await page.locator('.deleted').count()).toBe(0)
})

test('an empty chart begins, and a model draws its own', async () => {
  await page.getByRole('button', { name: 'New', exact: true }).click()
  await dialog().getByText('Empty chart').click()
  await dialog().getByRole('textbox').fill('Pump')
  await shot(page, 'new-chart')
  await dialog().getByRole('button', { name: 'Create' }).click()
  await shape(page, 'idle').waitFor()
  expect(text('Pump.chart')).toContain('machine Pump "Pump"')
  await listed('Pump.chart').waitFor()
  await page.locator('.state-chip', { hasText: /^Saved/ }).waitFor()
  // Of a model that has a chart, none is made.
  await listed('Lamp.asm').click({ button: 'right' })
  expect(await page.getByRole('menuitem', { name: 'Draw its chart' }).count()).toBe(0)
  await page.keyboard.press('Escape')
  await listed('Room.asm').click({ button: 'right' })
  await page.getByRole('menuitem', { name: 'Draw its chart' }).click()
  await page.locator('.notice.refused', { hasText: 'Room.asm has no chart' }).waitFor()
  await listed('Gate.asm').click({ button: 'right' })
  await page.getByRole('menuitem', { name: 'Draw its chart' }).click()
  await page.locator('.tab.on', { hasText: 'Gate.chart' }).waitFor()
  await shape(page, 'shut').waitFor()
  await shot(page, 'extracted')
})

test('a picture of a text with a syntax error is called a guess', async () => {
  await page.locator('.cm-line', { hasText: 'held no -> on' }).click()
  await page.keyboard.press('End')
  await page.keyboard.type('\noff -> ')
  await page.locator('.stale-note', { hasText: 'this picture is a guess' }).waitFor()
  await shot(page, 'guess')
  await page.keyboard.type('held')
  await until(async () => (await page.locator('.stale-note').textContent()) === '', 'no guess any more')
})

test('in a narrow window the dialogs show all of a long path and their buttons', async () => {
  const name = 'VisualServoingComponentOfTheSecondRobot'
  writeFileSync(path(`${name}.asm`), MODEL.replace('asm Door', `asm ${name}`))
  writeFileSync(path('Room.asm'), ROOM.replaceAll('Lamp', name))
  await page.setViewportSize({ width: 360, height: 740 })
  await page.goto(`${studio.address}#/${name}.asm`)
  await page.reload()
  await page.locator('.tab.on', { hasText: name }).waitFor()
  const command = async (words: string): Promise<void> => {
    await page.keyboard.press('Control+k')
    await page.keyboard.type(words)
    await page.getByRole('option', { name: new RegExp(words, 'i') }).click()
  }
  const fits = async (): Promise<void> => {
    await dialog().locator('.named', { hasText: 'Room.asm' }).first().waitFor()
    expect(await dialog().evaluate((frame) => frame.scrollWidth - frame.clientWidth)).toBeLessThanOrEqual(0)
    for (const button of await dialog().locator('footer button').all()) {
      const { x, width } = (await button.boundingBox()) ?? { x: 0, width: 999 }
      expect(x + width).toBeLessThanOrEqual(350)
    }
    await dialog().getByRole('button', { name: 'Cancel' }).click()
  }
  await command('Rename this file')
  await shot(page, 'rename-file-narrow')
  await fits()
  await command('Delete this file')
  await fits()
})
