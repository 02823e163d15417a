// Systems in the browser: properties set in the picture, times that follow, C++ beside the model, a program that is built and runs.

import { existsSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'

import type { Browser, Page } from 'playwright-core'
import { afterAll, afterEach, beforeAll, beforeEach, expect, test } from 'vitest'

import { type Trouble, drag, middle, onArrow, opened, page as newPage, shape, shot } from './browser'
import { type Served, copied, removed, served } from './served'

const AXIS = `chart Axis

import patterns/ControlTask

system axis "Axis" // one axis
	tick 0.5 ms
	sensor encoder
	actuator motor
	component sensing "Sensing" synchronous period 10 ms // samples
		elaborate acquire 1.5 ms // slow
		write position 0.5 ms
	endcomponent
	component control "Control" synchronous period 20 ms
		read position 0.5 ms
		elaborate law 6 ms
	endcomponent
	channel position from sensing to control swinging buffer 2
	encoder -> sensing
	control -> motor
	within 60 ms from encoder to motor
endsystem
`

let browser: Browser
let studio: Served
let page: Page
const trouble: Trouble = { told: [] }

const path = (name: string): string => join(studio.folder, name)
const file = (name: string): string => (existsSync(path(name)) ? readFileSync(path(name), 'utf8') : '')

async function until(holds: () => boolean | Promise<boolean>, what: () => string, tries = 160): Promise<void> {
  for (let left = tries; left > 0; left--) {
    if (await holds()) return
    await new Promise((done) => setTimeout(done, 50))
  }
  throw new Error(`it never came: ${what()}`)
}

const has = (name: string, part: string): Promise<void> => until(() => file(name).includes(part), () => `${part} in ${name}:\n${file(name)}`)

async function open(name: string, width = 1400): Promise<void> {
  await page.setViewportSize({ width, height: 860 })
  await page.goto(`${studio.address}#/${name}`)
  await page.reload()
  await page.locator('.tab.on').waitFor()
}

async function axis(): Promise<void> {
  writeFileSync(path('Axis.chart'), AXIS)
  await open('Axis.chart')
  await shape(page, 'sensing').waitFor()
}

const panel = async (name: string): Promise<void> => {
  const tab = page.getByRole('tab', { name, exact: true })
  if ((await tab.getAttribute('aria-selected')) !== 'true') await tab.click()
}

// How programs are compiled here: not slower than need be.
process.env['CMAKE_BUILD_TYPE'] ??= 'Debug'

beforeAll(async () => {
  studio = await served(copied('examples', 'library'))
  browser = await opened()
})

afterAll(async () => {
  await browser?.close()
  studio?.stop()
  if (studio) removed(studio.folder)
})

beforeEach(async () => {
  page = await newPage(browser, studio.address, trouble)
})

afterEach(async () => {
  await page.context().close()
  expect(trouble.told.splice(0)).toEqual([])
})

test('a period is set in the picture, told as a fault at its field, and undone', async () => {
  await axis()
  await shape(page, 'sensing').click()
  const inspector = page.locator('.inspector')
  const period = inspector.getByLabel('Period', { exact: true })
  await period.fill('20 ms')
  await period.press('Enter')
  await has('Axis.chart', 'synchronous period 20 ms // samples')
  await shot(page, 'system-inspector')
  // What is no time is refused at the field, and the text stays.
  await period.fill('20 min')
  await period.press('Enter')
  await inspector.locator('.field-fault', { hasText: '`20 min` is no time' }).waitFor()
  await shot(page, 'system-refused')
  expect(file('Axis.chart')).toContain('synchronous period 20 ms // samples')
  // What the chart's own check finds stands at the field, too.
  await period.fill('20.25 ms')
  await period.press('Enter')
  await has('Axis.chart', 'period 20.25 ms')
  await inspector.locator('.property', { has: page.locator('input[name="period"]') }).locator('.field-fault').waitFor()
  await page.locator('.canvas').focus()
  await page.keyboard.press('Control+z')
  await page.keyboard.press('Control+z')
  await has('Axis.chart', 'synchronous period 10 ms // samples')
  expect(file('Axis.chart')).toBe(AXIS)
})

test('phases, channels and devices are changed in the picture', async () => {
  await axis()
  await shape(page, 'sensing').click()
  const inspector = page.locator('.inspector')
  await inspector.locator('input[name="phaseTime-0"]').fill('1..2 ms')
  await page.keyboard.press('Enter')
  await has('Axis.chart', 'elaborate acquire 1..2 ms // slow')
  await inspector.getByLabel('Name', { exact: true }).last().fill('filter')
  await page.keyboard.press('Enter')
  await has('Axis.chart', 'elaborate filter\n')
  await inspector.getByLabel('Move elaborate filter up').click()
  await has('Axis.chart', 'elaborate filter\n\t\twrite position 0.5 ms')
  await inspector.getByLabel('Delete elaborate filter').click()
  await until(() => !file('Axis.chart').includes('filter'), () => file('Axis.chart'))
  await shape(page, 'position').click()
  await inspector.getByLabel('Made of').selectOption('queue')
  await has('Axis.chart', 'to control queue 2')
  await inspector.getByLabel('Messages').fill('8')
  await page.keyboard.press('Enter')
  await has('Axis.chart', 'to control queue 8')
  await shot(page, 'system-channel')
  await shape(page, 'encoder').click()
  await inspector.getByLabel('Carries').fill('Integer')
  await page.keyboard.press('Enter')
  await has('Axis.chart', 'sensor encoder : Integer')
})

test('the table of times follows the text', async () => {
  await axis()
  await panel('Times')
  const row = page.locator('.times tbody tr', { hasText: 'control' }).first()
  await row.getByText('20 ms').first().waitFor()
  await shot(page, 'system-times')
  await page.locator('.cm-line', { hasText: 'elaborate law 6 ms' }).click()
  await page.keyboard.press('End')
  for (let letter = 0; letter < 4; letter++) await page.keyboard.press('Backspace')
  await page.keyboard.type('9 ms')
  await until(async () => (await row.textContent())?.includes('10.5 ms') === true, () => 'a longer time in the table')
  await page.locator('.times-panel').getByLabel('Age, encoder to motor').fill('20 ms')
  await page.keyboard.press('Enter')
  await has('Axis.chart', 'within 20 ms from encoder to motor')
  await page.locator('.times').getByText('not shown').first().waitFor()
  // While it cannot be read, the former table stays and is called so.
  await page.locator('.cm-line', { hasText: 'tick 0.5 ms' }).click()
  await page.keyboard.press('End')
  await page.keyboard.type(' (')
  await page.locator('.times-now.stale').waitFor()
  await shot(page, 'system-times-stale')
})

test('C++ stands beside its model, both ways, and is called older when it is', async () => {
  await open('examples/coffee_machine/CoffeeMachine.asm')
  await panel('C++')
  await page.getByRole('button', { name: 'Generate C++' }).last().click()
  await page.locator('.currency.good').waitFor({ timeout: 30_000 })
  const reader = page.locator('.code-text')
  // From the model to its lines.
  await page.locator('.text-pane .cm-line', { hasText: 'PUSH_TEA' }).last().click()
  await reader.locator('.cm-ran-next').first().waitFor()
  await shot(page, 'code')
  // From a line to the model.
  await reader.locator('.cm-line', { hasText: 'Machine::canSell' }).click()
  await page.locator('.text-pane .cm-activeLine', { hasText: 'canSell' }).waitFor()
  await shot(page, 'code-back')
  await page.locator('.text-pane .cm-line', { hasText: 'function canSell' }).first().click()
  await page.keyboard.press('End')
  await page.keyboard.type(' // changed')
  await page.locator('.currency.bad', { hasText: 'older than CoffeeMachine.asm' }).waitFor()
  await shot(page, 'code-older')
  for (let letter = 0; letter < 11; letter++) await page.keyboard.press('Backspace')
  await page.locator('.currency.good').waitFor()
})

test('a program is built and runs, lit on the chart, with the verdict of conform', async () => {
  await axis()
  await page.getByLabel('More to do with this file').click()
  await page.getByRole('menuitem', { name: 'Build and run' }).click()
  await page.locator('.program-now').waitFor({ timeout: 180_000 })
  await until(async () => (await page.locator('.row-lit').count()) > 0, () => 'a lit phase', 400)
  await shot(page, 'program-running')
  const verdict = page.locator('.program-verdict')
  await verdict.waitFor({ timeout: 60_000 })
  expect(await verdict.textContent()).toMatch(/conforms by the order of events: \d+ events/)
  await shot(page, 'program-verdict')
  // Stopped early there is no verdict.
  await page.locator('.job').getByRole('button', { name: 'Again' }).click()
  await page.locator('.program-now').waitFor({ timeout: 60_000 })
  await page.locator('.job').getByRole('button', { name: 'Stop' }).click()
  await page.getByText('Stopped before its end: there is no verdict.').waitFor()
  expect(await verdict.count()).toBe(0)
  await panel('C++')
  await shape(page, 'control').click()
  await page.locator('.code-text .cm-ran-next').first().waitFor()
  await shot(page, 'code-system')
}, 300_000)

async function program(seconds: number): Promise<string> {
  await page.getByLabel('More to do with this file').click()
  await page.getByRole('menuitem', { name: 'Build and run' }).click()
  await page.locator('.program-now').waitFor({ timeout: 300_000 })
  await until(async () => (await page.locator('.row-lit').count()) > 0, () => 'a lit phase', 400)
  await shot(page, 'program-own')
  const verdict = page.locator('.program-verdict')
  await verdict.waitFor({ timeout: seconds * 1000 + 60_000 })
  return (await verdict.textContent()) ?? ''
}

test('an example runs as the program that lies beside its chart, with its own hooks', async () => {
  await open('examples/sorting_cell/SortingCell.chart')
  await shape(page, 'sequencer').waitFor()
  expect(await program(5)).toMatch(/conforms by the order of events: \d+ events/)
  // What the example's belt says at the end of its own program.
  await page.getByText(/\d+ pushes, \d+ of them wrong, \d+ after the stop; \d+ parcels/).waitFor()
  expect(existsSync(path('examples/sorting_cell/SortingCell.generated'))).toBe(false)
  await panel('C++')
  await page.locator('.code-panel').getByText('belt.hpp').first().waitFor()
}, 420_000)

test('a program of the user is built where it lies, under its own name, and its files stay', async () => {
  await axis()
  await page.getByLabel('More to do with this file').click()
  // The file that is written last: it may be there from before.
  rmSync(path('Axis.generated/control.hpp'), { force: true })
  await page.getByRole('menuitem', { name: 'Generate C++' }).click()
  await until(() => file('Axis.generated/control.hpp').includes('}  // namespace axis'), () => 'the C++')
  // The user moves the program to a place of their own, calls it otherwise, and it tells of itself.
  renameSync(path('Axis.generated'), path('bench'))
  writeFileSync(path('bench/CMakeLists.txt'), file('bench/CMakeLists.txt').replace('project(axis', 'project(bench').replace(/(add_executable|target_\w+)\(axis/g, '$1(bench'))
  writeFileSync(path('bench/main.cpp'), file('bench/main.cpp').replace('int main(', '#include <cstdio>\nint main(').replace('words) {', 'words) {\n    std::puts("the bench of the user");'))
  const own = file('bench/control.hpp')
  expect(await program(5)).toMatch(/conforms by the order of events: \d+ events/)
  await page.getByText('the bench of the user').waitFor()
  expect(existsSync(path('Axis.generated'))).toBe(false)
  expect(file('bench/control.hpp')).toBe(own)
}, 300_000)

const GAUGE = `asm Gauge
import StandardLibrary
signature:
	domain Percent subsetof Integer
	monitored level: Percent
	monitored tap: Boolean
	controlled sum: Integer
definitions:
	domain Percent = {0 : 200}
	main rule r_Main = if tap then sum := sum + level endif
default init s0:
	function sum = 0
`

test('inputs have sliders and switches, and come from a file', async () => {
  writeFileSync(path('Gauge.asm'), GAUGE)
  writeFileSync(path('Day.csv'), 'step,level,tap\n1,20,true\n2,150,\n3,,false\n')
  await open('Gauge.asm')
  await panel('Run')
  await page.locator('.panel').getByRole('button', { name: 'Run Gauge.asm' }).click()
  await page.locator('.state-table').waitFor()
  await page.keyboard.press('F10')
  // A truth value has a button for each, a number a slider.
  await page.locator('.asked').getByRole('button', { name: 'true' }).click()
  const asked = page.locator('.asked').getByRole('spinbutton', { name: 'level, Value' })
  await asked.fill('120')
  await page.locator('.asked').getByRole('button', { name: 'Give' }).click()
  const sum = page.locator('.state-table tr', { hasText: 'sum' })
  await until(async () => (await sum.textContent())?.includes('120') === true, () => 'a sum of 120')
  await page.locator('.inputs').getByRole('switch', { name: 'tap' }).waitFor()
  const slider = page.locator('.inputs').getByRole('slider', { name: 'level' })
  await slider.focus()
  await page.keyboard.press('ArrowRight')
  await shot(page, 'inputs')
  await page.keyboard.press('F10')
  await until(async () => (await sum.textContent())?.includes('241') === true, () => 'a sum of 241')
  // The same model with recorded inputs: nothing is asked for.
  await page.getByRole('button', { name: 'End the run' }).click()
  await page.getByRole('button', { name: /Run with inputs of/ }).click()
  await page.getByText('Inputs come from Day.csv').waitFor()
  for (const expected of ['20', '170', '170']) {
    await page.keyboard.press('F10')
    await until(async () => (await sum.textContent())?.includes(expected) === true, () => `a sum of ${expected}`)
  }
  await shot(page, 'inputs-recorded')
})

const THREE = `chart Three

system three "Three"
	tick 0.5 ms
	component look "Look" synchronous period 10 ms
		elaborate scan 2 ms
		write seen 0.5 ms
	endcomponent
	component plan "Plan" synchronous period 20 ms
		read seen 0.5 ms
		elaborate think 3 ms
		write route 0.5 ms
	endcomponent
	component act "Act" synchronous period 20 ms
		read route 0.5 ms
		elaborate move 1 ms
	endcomponent
	component log "Log" synchronous period 50 ms
		read route 1 ms
		elaborate keep 1 ms
	endcomponent
	channel seen from look to plan swinging buffer 2 master look
	channel route from plan to act, log queue 4
endsystem
`

test('the ends of a channel and what a phase reads are changed in the properties, and by an arrow’s end', async () => {
  writeFileSync(path('Three.chart'), THREE)
  await open('Three.chart')
  await shape(page, 'log').click()
  await page.getByLabel('Channel of: read route').selectOption('seen')
  await has('Three.chart', 'read seen 1 ms')
  await has('Three.chart', 'channel seen from look to plan, log swinging buffer')
  await has('Three.chart', 'channel route from plan to act queue 4')
  await shape(page, 'seen').click()
  await page.getByLabel('Reader 2').selectOption('act')
  await has('Three.chart', 'channel seen from look to plan, act swinging buffer')
  await page.getByLabel('From', { exact: true }).selectOption('log')
  await has('Three.chart', 'channel seen from log to plan, act swinging buffer 2 master log')
  // What was drawn has no fault.
  await page.locator('.panel-tabs .count').waitFor({ state: 'detached' })
  await shot(page, 'channel-ends')
  // Its writer is dragged back to where it was.
  await page.keyboard.press('Escape')
  const [x, y] = await onArrow(page, 'Arrow from Log to seen')
  await page.mouse.click(x, y)
  // The first hold is the arrow's beginning.
  const grip = page.locator('.hold').first()
  await drag(page, await middle(grip), await middle(shape(page, 'look')))
  await has('Three.chart', 'channel seen from look to plan, act swinging buffer 2 master look')
  await page.keyboard.press('Control+z')
  await has('Three.chart', 'channel seen from log to plan, act')
})
