// A refinement check: the part of the coupling that fails, both runs as lanes and as charts side by side.

import { writeFileSync } from 'node:fs'
import { join } from 'node:path'

import type { Browser, Page } from 'playwright-core'
import { afterAll, afterEach, beforeAll, beforeEach, expect, test } from 'vitest'

import { type Trouble, opened, page as newPage, shot } from './browser'
import { type Served, copied, removed, served } from './served'

let browser: Browser
let studio: Served
let page: Page
const trouble: Trouble = { told: [] }

const chart = (name: string, paths: string, states: string): string => `chart ${name}

machine lift "${name}" {r_lift}
	control floor
	initial state ground "Ground floor"
${states}	state upstairs "Upstairs"
	guard call "Somebody calls" {called}
	guard leave "All are out" {empty}
${paths}	upstairs -> leave yes -> ground
endmachine
`

const model = (name: string, literals: string, rule: string, monitored: string): string => `asm ${name}
import StandardLibrary
signature:
	enum domain Floor = {${literals}}
	controlled floor: Floor
	controlled light: Boolean
	monitored called: Boolean
	monitored empty: Boolean
${monitored}definitions:
	rule r_lift =
		par
${rule}			if floor = UPSTAIRS then
				if empty then
					par floor := GROUND light := false endpar
				endif
			endif
		endpar
	main rule r_Main = r_lift[]
default init s0:
	function floor = GROUND
	function light = false
`

const files: Record<string, string> = {
  'Lift.chart': chart('Lift', '\tground -> call yes -> upstairs\n', ''),
  'Lift.asm': model('Lift', 'GROUND | UPSTAIRS', '\t\t\tif floor = GROUND then if called then par floor := UPSTAIRS light := true endpar endif endif\n', ''),
  'SlowLift.chart': chart(
    'SlowLift',
    '\tguard arrived "Is it there?" {there}\n\tground -> call yes -> moving\n\tmoving -> arrived yes -> upstairs\n',
    '\tstate moving "Moving"\n',
  ),
  'SlowLift.asm': model(
    'SlowLift',
    'GROUND | MOVING | UPSTAIRS',
    '\t\t\tif floor = GROUND then if called then par floor := MOVING light := true endpar endif endif\n\t\t\tif floor = MOVING then if there then floor := UPSTAIRS endif endif\n',
    '\tmonitored there: Boolean\n',
  ),
  // The light goes on when the lift sets off, where nobody expects it.
  'Wrong.refine': 'abstract "Lift.asm";\nconcrete "SlowLift.asm";\ncouple (abstract.floor = UPSTAIRS) = (concrete.floor = UPSTAIRS);\nsame light;\nallow waiting;\n',
  'Right.refine': 'abstract "Lift.asm";\nconcrete "SlowLift.asm";\ncouple (abstract.floor = UPSTAIRS) = (concrete.floor != GROUND);\nsame light;\nfree abstract.empty;\nallow waiting;\n',
}

beforeAll(async () => {
  studio = await served(copied())
  for (const [name, text] of Object.entries(files)) writeFileSync(join(studio.folder, name), text)
  browser = await opened()
})

afterAll(async () => {
  await browser?.close()
  studio?.stop()
  if (studio) removed(studio.folder)
})

beforeEach(() => {
  trouble.told = []
})

afterEach(async ({ task }) => {
  if (task.result?.state === 'fail') await shot(page, `failed: ${task.name}`.replace(/\W+/g, '-'))
  await page.context().close()
  expect(trouble.told).toEqual([])
})

async function checked(name: string): Promise<void> {
  page = await newPage(browser, `${studio.address}#/${name}`, trouble)
  await page.getByRole('button', { name: 'Refine', exact: true }).click()
  await page.locator('.refined').waitFor({ timeout: 40_000 })
}

test('a refutation is shown with the part that fails, both runs and both charts', async () => {
  await checked('Wrong.refine')
  await page.locator('.refined .outcome.bad', { hasText: 'does not refine' }).waitFor()
  const part = page.locator('.refined-page')
  await part.locator('.candidate li', { hasText: 'abstract.light = concrete.light' }).first().waitFor()
  expect(await part.locator('.chartbox h3').allTextContents()).toEqual(['abstract: Lift', 'concrete: SlowLift'])
  // The last moment first: the lift has set off, and the abstract one stands.
  const told = part.locator('.chartbox .told')
  await expect.poll(() => told.allTextContents()).toEqual(['Ground floor', 'Moving'])
  expect(await part.locator('.chartbox .lit').count()).toBe(2)
  await part.getByRole('button', { name: 'A step back' }).click()
  await expect.poll(() => told.allTextContents()).toEqual(['Ground floor', 'Ground floor'])
  const lanes = part.locator('#detail')
  for (const lane of ['abstract.floor', 'concrete.floor', 'abstract.light', 'concrete.light']) await lanes.getByText(lane, { exact: true }).waitFor()
  await part.locator('tr.loose', { hasText: 'GROUND -> MOVING' }).waitFor()
  await shot(page, 'refinement')
})

test('what refines says what it rests on', async () => {
  await checked('Right.refine')
  await page.locator('.refined .outcome.good', { hasText: 'refines' }).waitFor()
  const told = page.locator('.refined-told')
  await told.filter({ hasText: 'Observed' }).filter({ hasText: 'abstract.light = concrete.light' }).waitFor()
  await told.filter({ hasText: 'Diagrams' }).filter({ hasText: '1:1 in' }).waitFor()
  await told.filter({ hasText: 'Assumed' }).filter({ hasText: 'does not go on for ever' }).waitFor()
  expect(await page.locator('.refined-page').count()).toBe(0)
})
