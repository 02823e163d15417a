// The studio as its users meet it: each test does one thing on the page, and looks at the file on the disk.

import { existsSync, readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'

import type { Browser, Page } from 'playwright-core'
import { afterAll, afterEach, beforeAll, beforeEach, expect, test } from 'vitest'

import { type Trouble, drag, middle, onArrow, opened, page as newPage, shape, shot, text } from './browser'
import { type Served, copied, removed, served } from './served'

const LAMP = `// A lamp with a button.
chart Lamp

machine lamp "Lamp"
	control light
	initial state off "Off"
	state on "On"
	guard pressed "Pressed"
	action count "COUNT"
	off -> pressed yes -> count -> on
	on -> pressed
	pressed no -> off
endmachine
`

let browser: Browser
let studio: Served
let page: Page
const trouble: Trouble = { told: [] }

const path = (name: string): string => join(studio.folder, name)
const file = (name: string): string => (existsSync(path(name)) ? readFileSync(path(name), 'utf8') : '')
const saved = (): Promise<void> => page.locator('.state-chip', { hasText: /^Saved$/ }).waitFor()

async function until(holds: () => boolean | Promise<boolean>, what: string | (() => string)): Promise<void> {
  for (let tries = 0; tries < 160; tries++) {
    if (await holds()) return
    await new Promise((done) => setTimeout(done, 50))
  }
  throw new Error(`it never came: ${typeof what === 'string' ? what : what()}`)
}

const has = (name: string, part: string | RegExp): Promise<void> =>
  until(() => (typeof part === 'string' ? file(name).includes(part) : part.test(file(name))), () => `${part} in ${name}:\n${file(name)}`)

async function open(name: string): Promise<void> {
  await page.goto(`${studio.address}#/${name}`)
  await page.reload()
  await page.locator('.tab.on').waitFor()
}

async function lamp(): Promise<void> {
  writeFileSync(path('Lamp.chart'), LAMP)
  await open('Lamp.chart')
  await shape(page, 'off').waitFor()
}

beforeAll(async () => {
  const folder = copied('examples', 'library')
  writeFileSync(join(folder, 'Lamp.chart'), LAMP)
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
  page = await newPage(browser, studio.address, trouble)
})

afterEach(async ({ task }) => {
  if (task.result?.state === 'fail') console.log(await page.locator('.notice').allTextContents())
  if (task.result?.state === 'fail') await shot(page, `failed: ${task.name}`.replace(/\W+/g, '-'))
  await page.context().close()
  expect(trouble.told).toEqual([])
})

test('a shape is moved, undone and done again, from canvas and text', async () => {
  await lamp()
  const [x, y] = await middle(shape(page, 'on'))
  await drag(page, [x, y], [x + 120, y + 40])
  await has('Lamp.chart', /layout lamp[\s\S]*on at \d+, \d+/)
  // Nothing else moved, and what was written stays as it was.
  expect(file('Lamp.chart').startsWith(LAMP.trimEnd())).toBe(true)
  await page.keyboard.press('Control+z')
  await until(() => file('Lamp.chart') === LAMP, 'the text as it was')
  await page.keyboard.press('Control+y')
  await has('Lamp.chart', 'layout lamp')
  await page.locator('.cm-content').click()
  await page.keyboard.press('Control+z')
  await until(() => file('Lamp.chart') === LAMP, 'the text as it was')
})

test('a shape is placed by its key, named, linked, and made initial', async () => {
  await lamp()
  await page.locator('.canvas').click({ position: { x: 60, y: 30 } })
  await page.keyboard.press('s')
  await page.mouse.click(330, 250)
  await has('Lamp.chart', /\n\tstate \w+/)
  const name = page.locator('.inspector input[name=name]')
  await name.waitFor()
  // Name and text in one go: the new name comes while the text is typed.
  await name.fill('broken')
  await name.press('Tab')
  await page.keyboard.type('Broken lamp')
  await page.keyboard.press('Enter')
  await has('Lamp.chart', 'state broken')
  await has('Lamp.chart', 'state broken "Broken lamp"')
  await page.locator('.inspector input[name=link]').fill('BROKEN')
  await page.locator('.inspector input[name=link]').press('Enter')
  await has('Lamp.chart', 'state broken "Broken lamp" {BROKEN}')
  await page.getByRole('switch', { name: 'Initial state' }).click()
  await has('Lamp.chart', 'initial state broken')
  expect(file('Lamp.chart')).toContain('\tstate off "Off"')
  expect(file('Lamp.chart')).toContain('// A lamp with a button.')
})

test('an arrow is drawn from a port, redirected and deleted', async () => {
  writeFileSync(path('Lamp.chart'), LAMP.replace('\tpressed no -> off\n', ''))
  await open('Lamp.chart')
  await shape(page, 'pressed').hover()
  const port = await middle(page.locator('.port.no'))
  await drag(page, port, await middle(shape(page, 'on')))
  await has('Lamp.chart', 'pressed no -> on')
  await page.mouse.click(...(await onArrow(page, 'Arrow from Pressed, no, to On')))
  const tip = await middle(page.locator('.holds .hold').nth(1))
  await drag(page, tip, await middle(shape(page, 'off')))
  await has('Lamp.chart', 'pressed no -> off')
  await page.mouse.click(...(await onArrow(page, 'Arrow from Pressed, no, to Off')))
  await page.keyboard.press('Delete')
  await until(() => !file('Lamp.chart').includes('pressed no'), 'no exit for no')
})

test('an arrow into the free grows a new shape, and is undone with it', async () => {
  await lamp()
  await shape(page, 'on').hover()
  const port = await middle(shape(page, 'on').locator('.port.right'))
  await drag(page, port, [800, 300])
  await page.getByRole('menuitem', { name: 'Guard' }).click()
  await has('Lamp.chart', /on -> (?!pressed)\w+/)
  await page.locator('.canvas').focus()
  await page.keyboard.press('Control+z')
  await until(() => file('Lamp.chart') === LAMP, 'the text as it was')
})

test('shapes are selected together, aligned, copied and deleted', async () => {
  await lamp()
  await shape(page, 'on').click()
  await shape(page, 'count').click({ modifiers: ['Control'] })
  await page.keyboard.press('Control+c')
  await page.getByRole('button', { name: 'Align left' }).click()
  await has('Lamp.chart', 'layout lamp')
  await page.keyboard.press('Control+v')
  await has('Lamp.chart', /action count\d+/)
  await saved()
  await shape(page, 'pressed').click()
  await page.keyboard.press('Delete')
  await until(() => !file('Lamp.chart').includes('guard pressed'), 'no guard')
  expect(file('Lamp.chart')).not.toMatch(/pressed/)
})

test('selecting a shape shows its text, and the cursor in the text selects the shape', async () => {
  await lamp()
  await shape(page, 'count').click()
  await page.locator('.cm-picked', { hasText: 'count' }).first().waitFor()
  await page.locator('.cm-line', { hasText: 'state on' }).click()
  await shape(page, 'on').locator('.box.selected').waitFor()
  expect(await shape(page, 'count').locator('.box.selected').count()).toBe(0)
})

test('everything is done with keys alone', async () => {
  await lamp()
  await shape(page, 'off').focus()
  await page.keyboard.press('Tab')
  await page.keyboard.press('Enter')
  await page.locator('.field-in-shape').waitFor()
  await page.keyboard.type('Button pressed')
  await page.keyboard.press('Enter')
  await has('Lamp.chart', 'guard pressed "Button pressed"')
  await page.keyboard.press('ArrowRight')
  await page.keyboard.press('ArrowRight')
  await has('Lamp.chart', 'pressed at')
})

test('a fault in the text is told there, on the shape and in the list; the picture stays', async () => {
  await lamp()
  await page.locator('.cm-line', { hasText: 'pressed no' }).click()
  await page.keyboard.press('End')
  await page.keyboard.type('\n\tstate lost')
  await shape(page, 'lost').locator('.fault-badge').waitFor()
  await page.getByRole('tab', { name: /Problems/ }).click()
  await page.locator('.problem', { hasText: 'lost' }).first().waitFor()
  await shot(page, 'faults')
  await page.locator('.cm-line', { hasText: 'state lost' }).click()
  await page.keyboard.press('End')
  await page.keyboard.type(' ->')
  expect(await shape(page, 'off').count()).toBe(1)
})

test('a model is built, runs, lights states, shows guards, steps back and becomes a scenario', async () => {
  await lamp()
  await page.keyboard.press('F5')
  await page.getByRole('button', { name: 'Build the model and run' }).click()
  await shape(page, 'off').locator('.box.lit').waitFor({ timeout: 20_000 })
  await page.keyboard.press('F10')
  await page.locator('.offers button', { hasText: 'true' }).click()
  await shape(page, 'on').locator('.box.lit').waitFor()
  await shape(page, 'pressed').locator('.value-badge.true').waitFor()
  await page.locator('.cm-ran-changed').first().waitFor()
  await shot(page, 'run')
  await page.getByRole('switch', { name: 'pressed' }).click()
  await page.keyboard.press('F10')
  await shape(page, 'off').locator('.box.lit').waitFor()
  await page.keyboard.press('Shift+F10')
  await shape(page, 'on').locator('.box.lit').waitFor()
  await page.getByRole('button', { name: 'Record as a scenario' }).click()
  await has('LampRun1.avalla', 'check light = ON;')
  await page.locator('.joined').getByRole('button', { name: 'Test', exact: true }).click()
  await page.locator('.verdict', { hasText: 'passed' }).waitFor({ timeout: 20_000 })
})

test('the state that a run is in is brought into view', async () => {
  // So far apart that no view shows both.
  writeFileSync(path('Lamp.chart'), `${LAMP}\nlayout lamp\n\toff at 0, 0\n\ton at 0, 9000\nendlayout\n`)
  await open('Lamp.chart')
  await page.locator('.react-flow__node').first().waitFor()
  const inView = async (id: string): Promise<boolean> => {
    const [box, canvas] = [await shape(page, id).boundingBox(), await page.locator('.react-flow').boundingBox()]
    if (!box || !canvas) return false
    const y = box.y + box.height / 2
    return y > canvas.y && y < canvas.y + canvas.height
  }
  await page.keyboard.press('F5')
  const build = page.getByRole('button', { name: 'Build the model and run' })
  if (!file('Lamp.asm')) await build.click()
  await until(() => inView('off'), 'the state with which it begins')
  await page.keyboard.press('F10')
  await page.locator('.offers button', { hasText: 'true' }).click()
  await until(() => inView('on'), 'the next state')
  expect(await inView('off')).toBe(false)
})

test('a run pauses at a breakpoint', async () => {
  await lamp()
  await shape(page, 'on').click()
  await page.getByRole('switch', { name: 'Pause a run here' }).click()
  await shape(page, 'on').locator('.break-badge').waitFor()
  await page.keyboard.press('F5')
  await shape(page, 'off').locator('.box.lit').waitFor()
  await page.keyboard.press('F10')
  await page.locator('.offers button', { hasText: 'false' }).click()
  await page.getByRole('switch', { name: 'pressed' }).click()
  await page.keyboard.press('F5')
  await page.locator('.note', { hasText: 'Paused' }).waitFor()
  await shape(page, 'on').locator('.box.lit').waitFor()
})

// It moves on for ever, and its domain ends.
const AXIS = `asm Axis
import StandardLibrary
signature:
	domain Millimetre subsetof Integer
	monitored stop: Boolean
	controlled position: Millimetre
definitions:
	domain Millimetre = {0 : 2}
	main rule r_Main = if not stop then position := position + 1 endif
default init s0:
	function position = 0
`

test('the timeline grows with the run, and a click on it goes to that step', async () => {
  await open('examples/visual_servoing/CompleteController.asm')
  await page.getByRole('tab', { name: 'Run', exact: true }).click()
  await page.getByRole('button', { name: 'Run with random inputs' }).click()
  await page.locator('.run-step', { hasText: 'Step 0' }).waitFor()
  await page.getByLabel('Speed', { exact: true }).selectOption({ label: 'As fast as can be' })
  await page.getByRole('button', { name: 'Run (F5)' }).click()
  await page.getByRole('tab', { name: 'Timeline' }).click()
  const lanes = page.locator('.timeline #detail')
  await lanes.locator('path.work').first().waitFor()
  const steps = async (): Promise<number> => Number(/([\d.,]+)\D*$/.exec((await page.locator('.timeline #where').textContent()) ?? '')?.[1] ?? 0)
  const before = await steps()
  await until(async () => (await steps()) > before, 'more steps')
  await page.keyboard.press('F5')
  await page.locator('.timeline').getByRole('button', { name: 'Whole run' }).click()
  await shot(page, 'timeline')
  const box = await lanes.boundingBox()
  if (!box) throw new Error('the lanes are drawn')
  // Each pixel is several steps: what lies there is some steps before the end.
  const reached = await steps()
  await page.mouse.click(box.x + box.width - 24, box.y + 40)
  await until(async () => (await steps()) < reached, 'fewer steps')
  // Going back is over when nothing changes any more.
  let [known, same] = [-1, 0]
  await until(async () => {
    const now = await steps()
    same = now === known ? same + 1 : 0
    known = now
    return same === 20
  }, 'an end of going back')
  await page.getByRole('tab', { name: 'Run', exact: true }).click()
  // A tick is 0.1 ms.
  await page.locator('.run-step', { hasText: `Step ${Math.round(known * 10)}` }).waitFor()
})

test('a model is verified, and its counterexample plays', async () => {
  writeFileSync(join(studio.folder, 'Axis.asm'), AXIS)
  await open('Axis.asm')
  await page.getByRole('button', { name: 'Verify', exact: true }).click()
  await page.locator('.verdict', { hasText: 'violated' }).waitFor({ timeout: 40_000 })
  await page.getByRole('button', { name: /Play its/ }).first().click()
  await page.getByRole('button', { name: 'One step on' }).click()
  await page.locator('.player tr.changed').first().waitFor()
  await shot(page, 'verdicts')
})

test('the times of a system are told as a table, with what cannot hold', async () => {
  await open('examples/sorting_cell/SortingCell.chart')
  await page.getByRole('button', { name: 'More to do with this file' }).click()
  await page.getByRole('menuitem', { name: 'Times' }).click()
  const row = page.locator('.times tr', { hasText: 'encoder' })
  await row.waitFor({ timeout: 40_000 })
  expect(await row.innerText()).toMatch(/1 ms\s+0.4 ms\s+0.40\s+0.2 ms\s+0.6 ms\s+1 ms\s+meets/)
  await page.locator('.times tr', { hasText: 'classifier' }).getByText('8.6..20.6 ms').waitFor()
  await shot(page, 'times')
  writeFileSync(path('examples/sorting_cell/SortingCell.chart'), file('examples/sorting_cell/SortingCell.chart').replace('processors 7', 'processors 1'))
  await page.locator('.times-now .note', { hasText: 'more than there are' }).waitFor()
})

test('differences between chart and model are shown on the shapes, failed checks in the scenario', async () => {
  await lamp()
  writeFileSync(path('Lamp.asm'), file('Lamp.asm').replace('light := ON', 'light := OFF'))
  await page.getByRole('button', { name: 'More to do with this file' }).click()
  await page.getByRole('menuitem', { name: 'Compare with model' }).click()
  await page.locator('.fault-told').first().waitFor({ timeout: 20_000 })
  await shape(page, 'off').locator('.fault-badge').waitFor()
  await shot(page, 'differences')
  await page.locator('.fault-told .label').last().click()
  await page.getByRole('tab', { name: 'Model', selected: true }).or(page.locator('.tab.on', { hasText: 'Lamp.asm' })).first().waitFor()
  const scenario = 'examples/coffee_machine/BuyCoffee.avalla'
  const text = file(scenario)
  writeFileSync(path(scenario), text.replace('missing 20', 'missing 30'))
  await open(scenario)
  await page.locator('.joined').getByRole('button', { name: 'Test', exact: true }).click()
  await page.locator('.cm-lintRange-error').first().waitFor({ timeout: 20_000 })
  writeFileSync(path(scenario), text)
})

test('what is written outside appears; what clashes is shown side by side', async () => {
  await lamp()
  writeFileSync(path('Lamp.chart'), LAMP.replace('"On"', '"Shining"'))
  await page.locator('.figure text', { hasText: 'Shining' }).waitFor()
  await page.context().setOffline(true)
  await page.context().setOffline(false)
  await page.locator('.cm-line', { hasText: 'action count' }).click()
  await page.keyboard.press('End')
  await page.keyboard.type(' // mine')
  // Before the editor has written: the same line, from outside.
  writeFileSync(path('Lamp.chart'), LAMP.replace('"COUNT"', '"ADD ONE"'))
  await page.locator('.conflict').waitFor()
  await shot(page, 'conflict')
  expect(file('Lamp.chart')).toContain('ADD ONE')
  await page.getByRole('button', { name: 'Keep my text' }).click()
  await has('Lamp.chart', '// mine')
  expect(await text(page)).toContain('// mine')
})

test('what is typed while the connection is broken is saved when it is back', async () => {
  await lamp()
  studio.cut(true)
  await page.locator('.banner').waitFor()
  await page.locator('.cm-line', { hasText: 'state on' }).click()
  await page.keyboard.press('End')
  await page.keyboard.type(' // offline')
  writeFileSync(path('Lamp.chart'), LAMP.replace('A lamp', 'The lamp'))
  studio.cut(false)
  await has('Lamp.chart', 'state on "On" // offline')
  await has('Lamp.chart', '// The lamp with a button.')
  await page.locator('.cm-line', { hasText: 'The lamp' }).waitFor()
  await saved()
  trouble.told = trouble.told.filter((told) => !told.includes('WebSocket'))
})

test('files, drawings, shapes and commands are found', async () => {
  await open('examples/visual_servoing/VisualServoingComponent.chart')
  await shape(page, 'reading').waitFor()
  await page.keyboard.press('Control+k')
  await page.keyboard.type('elapsed')
  await shot(page, 'search')
  await page.keyboard.press('Escape')
  await shape(page, 'reading').dblclick()
  await page.locator('.trail button').waitFor()
  await page.getByRole('tab', { name: 'Asynchronous master reading', selected: true }).waitFor()
  await page.locator('.trail button').click()
  await page.getByRole('tab', { name: 'Visual servoing component', selected: true }).waitFor()
})

test('a project begins from a template, and a chart with a new machine', async () => {
  await page.getByRole('button', { name: 'New', exact: true }).first().click()
  await page.locator('.card').first().waitFor()
  await shot(page, 'new')
  await page.locator('dialog input.mono').fill('Door')
  await page.getByRole('button', { name: 'Create' }).click()
  await page.locator('.tab.on').waitFor()
  await lamp()
  await page.getByRole('button', { name: 'New machine' }).click()
  await page.locator('dialog input.mono').fill('blink')
  await page.getByRole('button', { name: 'Create' }).click()
  await has('Lamp.chart', 'machine blink')
})

test('the pattern library opens read only', async () => {
  await page.getByRole('button', { name: /PatternMachines/ }).last().click()
  await page.locator('.react-flow__node').first().waitFor()
  await page.locator('.state-chip', { hasText: 'Read only' }).waitFor()
  expect(await page.locator('.palette').count()).toBe(0)
})

const CARRIER = `chart Carrier

machine carrier "Carrier"
	control mode
	initial state stopped "Stopped"
	composite state working "Working"
		history
		entry lampOn "LAMP ON"
		initial state empty "Empty"
		state loaded "Loaded"
		guard grasped "Part grasped"
		empty -> grasped yes -> loaded
	endstate
	guard started "Start pressed"
	guard emergency "Emergency stop"
	stopped -> started yes -> working
	working -> emergency yes -> stopped
endmachine
`

test('a composite state stands around its states, goes with them, and has none of their places', async () => {
  writeFileSync(path('Carrier.chart'), CARRIER)
  await open('Carrier.chart')
  const around = async (inner: string): Promise<boolean> => {
    const [frame, box] = [await shape(page, 'working').boundingBox(), await shape(page, inner).boundingBox()]
    if (!frame || !box) return false
    return frame.x < box.x && frame.y < box.y && frame.x + frame.width > box.x + box.width && frame.y + frame.height > box.y + box.height
  }
  await shape(page, 'loaded').waitFor()
  for (const inner of ['empty', 'loaded', 'grasped']) expect(await around(inner), inner).toBe(true)
  expect(await around('stopped')).toBe(false)
  expect(await shape(page, 'working').textContent()).toContain('entry / LAMP ON')
  await shot(page, 'composite')
  // A state is moved within: the frame follows, and gets no place of its own.
  const [x, y] = await middle(shape(page, 'loaded'))
  await drag(page, [x, y], [x + 160, y + 20])
  await has('Carrier.chart', /layout carrier[\s\S]*loaded at \d+, \d+/)
  await until(() => around('loaded'), 'the frame around what was moved')
  expect(file('Carrier.chart')).not.toContain('working at')
  // It is taken by its name, and goes with all that it holds.
  await page.locator('.react-flow__node[data-id="working"] text.name').click()
  await page.locator('.inspector', { hasText: 'Composite state' }).waitFor()
  await shot(page, 'composite-selected')
  await page.keyboard.press('Delete')
  await until(() => !file('Carrier.chart').includes('composite'), () => file('Carrier.chart'))
  expect(file('Carrier.chart')).not.toMatch(/loaded|empty|working|grasped/)
  await page.keyboard.press('Control+z')
  await has('Carrier.chart', 'composite state working')
})

test('a shape is put into a composite state by dragging, taken out by choice, and a frame is drawn from the palette', async () => {
  writeFileSync(path('Carrier.chart'), CARRIER.replace('\tguard started', '\tstate parked "Parked"\n\tguard started'))
  await open('Carrier.chart')
  await shape(page, 'parked').waitFor()
  await shape(page, 'loaded').waitFor()
  // Dropped between the states of the frame.
  const frame = await shape(page, 'working').boundingBox()
  if (!frame) throw new Error('no frame')
  await drag(page, await middle(shape(page, 'parked')), [frame.x + frame.width - 24, frame.y + frame.height - 24])
  await has('Carrier.chart', /composite state working[\s\S]*\t\tstate parked "Parked"\n[\s\S]*endstate/)
  await page.keyboard.press('Control+z')
  await has('Carrier.chart', /\n\tstate parked "Parked"\n/)
  await page.keyboard.press('Control+Shift+z')
  await has('Carrier.chart', /\n\t\tstate parked "Parked"\n/)
  await saved()
  await shot(page, 'composite-into')
  // By keys: the field in its properties.
  await shape(page, 'parked').click()
  await page.getByLabel('Inside').selectOption({ label: 'no composite state' })
  await has('Carrier.chart', /\n\tstate parked "Parked"\n/)
  await page.getByLabel('Inside').selectOption({ label: 'working' })
  await has('Carrier.chart', /\n\t\tstate parked "Parked"\n/)
  // Out of it by dragging, if that is meant.
  await saved()
  const again = await shape(page, 'working').boundingBox()
  if (!again) throw new Error('no frame')
  const [x, y] = await middle(shape(page, 'parked'))
  await page.mouse.move(x, y)
  await page.mouse.down()
  await page.keyboard.down('Control')
  await page.mouse.move(again.x - 60, again.y + 10, { steps: 6 })
  await page.mouse.up()
  await page.keyboard.up('Control')
  await has('Carrier.chart', /\n\tstate parked "Parked"\n/)
  await page.locator('.canvas').press('Escape')
  await page.locator('.palette').getByRole('button', { name: /Composite state/ }).click()
  const canvas = await page.locator('.canvas').boundingBox()
  if (!canvas) throw new Error('no canvas')
  await page.mouse.click(canvas.x + canvas.width - 120, canvas.y + canvas.height - 150)
  await has('Carrier.chart', /composite state working1?\w*\n\t\tinitial state begun\n\tendstate/)
  await shot(page, 'composite-drawn')
})

const PRESS = `chart Press

machine press "Press"
	control mode
	initial state idle "Idle"
	composite state working "Working" // while it works
		initial state lowering "Lowering"
		state raising "Raising"
		lowering -> raising
	endstate
	idle -> working
endmachine

machine other "Other"
	control phase
	initial state rest "Rest"
endmachine
`

test('a composite state remembers, and does something on entering and leaving, by its properties', async () => {
  writeFileSync(path('Press.chart'), PRESS)
  await open('Press.chart')
  await shape(page, 'lowering').waitFor()
  await page.locator('.cm-line', { hasText: 'composite state working' }).click()
  await page.locator('.inspector h2', { hasText: 'Composite state' }).waitFor()
  const fields = page.locator('.inspector')
  await fields.getByRole('switch', { name: 'Entered where it was left' }).click()
  await has('Press.chart', '// while it works\n\t\thistory\n\t\tinitial state lowering')
  await fields.locator('input[name=history]').fill('before')
  await fields.locator('input[name=history]').press('Enter')
  await has('Press.chart', '\t\thistory {before}\n')
  await fields.getByLabel('What is done', { exact: true }).fill('LAMP ON')
  await fields.getByLabel('What is done', { exact: true }).press('Enter')
  await has('Press.chart', '\t\thistory {before}\n\t\tentry lampOn "LAMP ON"\n')
  await fields.getByLabel('When', { exact: true }).selectOption('exit')
  await fields.getByLabel('What is done', { exact: true }).fill('LAMP OFF')
  await fields.getByLabel('What is done', { exact: true }).press('Enter')
  await has('Press.chart', '\t\tentry lampOn "LAMP ON"\n\t\texit lampOff "LAMP OFF"\n\t\tinitial')
  await fields.locator('input[name="link-lampOff"]').fill('lamp := false')
  await fields.locator('input[name="link-lampOff"]').press('Enter')
  await has('Press.chart', '\t\texit lampOff "LAMP OFF" {lamp := false}\n')
  await page.locator('.react-flow__node[data-id="working"]', { hasText: 'exit / LAMP OFF' }).waitFor()
  await shot(page, 'composite-properties')
  // What the grammar has no word for is refused at its field.
  await fields.locator('input[name="link-lampOff"]').fill('} state x {')
  await fields.locator('input[name="link-lampOff"]').press('Enter')
  await fields.locator('.field-fault').waitFor()
  await fields.getByRole('button', { name: 'Remove lampOff' }).click()
  await until(() => !file('Press.chart').includes('lampOff'), 'no exit')
  await fields.getByRole('switch', { name: 'Entered where it was left' }).click()
  await until(() => !file('Press.chart').includes('history'), 'no history')
  await fields.locator('input[name=name]').fill('busy')
  await fields.locator('input[name=name]').press('Enter')
  await has('Press.chart', 'idle -> busy')
  expect(file('Press.chart')).toContain('\tcomposite state busy "Working" // while it works\n\t\tentry lampOn "LAMP ON"\n')
})

test('a composite state is copied with all that it holds, beside it and into another machine', async () => {
  writeFileSync(path('Press.chart'), PRESS)
  await open('Press.chart')
  await shape(page, 'lowering').waitFor()
  await page.locator('.cm-line', { hasText: 'composite state working' }).click()
  await page.locator('.inspector h2', { hasText: 'Composite state' }).waitFor()
  await page.locator('.canvas').focus()
  await page.keyboard.press('Control+d')
  await has('Press.chart', '\tcomposite state working2 "Working" // while it works\n\t\tinitial state lowering2 "Lowering"\n\t\tstate raising2 "Raising"\n\t\tlowering2 -> raising2\n\tendstate\n')
  await shape(page, 'raising2').waitFor()
  await shot(page, 'composite-copied')
  await page.keyboard.press('Control+c')
  await page.getByRole('tab', { name: 'Other' }).click()
  await shape(page, 'rest').waitFor()
  await page.locator('.canvas').focus()
  await page.keyboard.press('Control+v')
  await until(() => (/machine other[^]*composite state working2 "Working"[^]*lowering2 -> raising2/).test(file('Press.chart')), () => file('Press.chart'))
  await shape(page, 'lowering2').waitFor()
})
