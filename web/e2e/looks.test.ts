// How the studio looks: pictures of each view in light and dark at 1400 and 1024 pixels, and what axe finds in them.

import { readFileSync, writeFileSync } from 'node:fs'
import { createRequire } from 'node:module'
import { join } from 'node:path'

import type { Browser, Page } from 'playwright-core'
import { afterAll, beforeAll, expect, test } from 'vitest'

import { type Trouble, opened, page as newPage, shape, shot } from './browser'
import { lampBuilt } from './lamp'
import { LATE } from './late'
import { type Served, copied, removed, served } from './served'

const AXE = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8')

let browser: Browser
let studio: Served
const trouble: Trouble = { told: [] }

beforeAll(async () => {
  const folder = copied('examples', 'library')
  lampBuilt(folder)
  writeFileSync(join(folder, 'Late.chart'), LATE)
  studio = await served(folder)
  browser = await opened()
})

afterAll(async () => {
  await browser?.close()
  studio?.stop()
  if (studio) removed(studio.folder)
})

interface Finding {
  id: string
  impact: string
  nodes: { target: string[]; failureSummary: string }[]
}

// axe is put in by the test's own means: the page's security policy would refuse it.
async function serious(page: Page): Promise<string[]> {
  await page.evaluate(AXE)
  const found = await page.evaluate(async () => {
    const axe = (window as unknown as { axe: { run: (options: object) => Promise<{ violations: Finding[] }> } }).axe
    return (await axe.run({ resultTypes: ['violations'] })).violations
  })
  return found
    .filter((finding) => finding.impact === 'serious' || finding.impact === 'critical')
    .map((finding) => `${finding.id}: ${finding.nodes.map((node) => `${node.target.join(' ')} ${node.failureSummary}`).join('; ')}`)
}

const VIEWS: [string, string, (page: Page) => Promise<void>][] = [
  ['welcome', '', async () => undefined],
  [
    'machine',
    '#/examples/visual_servoing/VisualServoingComponent.chart',
    async (page) => {
      await shape(page, 'available').click()
      await page.locator('.inspector').waitFor()
    },
  ],
  [
    'system',
    '#/examples/pick_and_place/PlacingSystem.chart',
    async (page) => {
      await shape(page, 'planner').waitFor()
    },
  ],
  [
    'model',
    '#/examples/coffee_machine/CoffeeMachine.asm',
    async (page) => {
      await page.keyboard.press('F5')
      await page.locator('.state-table').waitFor()
      await page.keyboard.press('F10')
      await page.locator('.asked').waitFor()
    },
  ],
  [
    'times',
    '#/examples/pick_and_place/PlacingSystem.chart',
    async (page) => {
      await shape(page, 'planner').click()
      await page.getByRole('tab', { name: 'Times' }).click()
      await page.locator('.times').waitFor()
    },
  ],
  [
    'generated',
    '#/examples/coffee_machine/CoffeeMachine.asm',
    async (page) => {
      await page.getByRole('tab', { name: 'C++' }).click()
      await page.getByRole('button', { name: 'Generate C++' }).last().click()
      await page.locator('.currency.good').waitFor({ timeout: 30_000 })
      await page.locator('.text-pane .cm-line', { hasText: 'portions' }).first().click()
    },
  ],
  [
    'coverage',
    '#/Lamp.chart',
    async (page) => {
      await shape(page, 'on').waitFor()
      await page.getByRole('button', { name: 'More to do with this file' }).click()
      await page.getByRole('menuitem', { name: 'Test', exact: true }).click()
      await page.locator('.box.uncovered').first().waitFor({ timeout: 30_000 })
    },
  ],
  [
    'stategraph',
    '#/examples/mutual_exclusion/Peterson.asm',
    async (page) => {
      await page.getByRole('tab', { name: 'State graph' }).click()
      await page.getByRole('button', { name: 'Draw the states of Peterson.asm' }).click()
      await page.locator('.graph-dot').first().waitFor({ timeout: 30_000 })
      await page.locator('.graph-picture').focus()
      await page.keyboard.press('Home')
      await page.keyboard.press('ArrowRight')
      await page.locator('.graph-state').waitFor()
    },
  ],
  [
    'system-run',
    '#/Late.chart',
    async (page) => {
      await shape(page, 'sensing').waitFor()
      await page.getByRole('button', { name: 'Verify', exact: true }).click()
      await page.locator('.verdict').getByRole('button', { name: /^Play its/ }).click({ timeout: 40_000 })
      await page.getByRole('button', { name: 'One step on' }).click()
      await page.locator('.happened').waitFor()
    },
  ],
  [
    'rename-machine',
    '#/Lamp.chart',
    async (page) => {
      await shape(page, 'on').waitFor()
      await page.getByRole('button', { name: 'Rename or delete this drawing' }).click()
      await page.getByRole('menuitem', { name: 'Rename…' }).click()
      await page.locator('dialog').getByLabel('Name', { exact: true }).fill('state')
      await page.locator('dialog .note.bad').waitFor()
    },
  ],
  [
    'keys',
    '#/examples/coffee_machine/BuyCoffee.avalla',
    async (page) => {
      await page.locator('.cm-content').waitFor()
      await page.keyboard.press('?')
      await page.locator('dialog').waitFor()
    },
  ],
]

for (const [name, address, act] of VIEWS) {
  for (const dark of [false, true]) {
    for (const width of [1400, 1024]) {
      test(`${name}, ${dark ? 'dark' : 'light'}, ${width}`, async () => {
        trouble.told = []
        const page = await newPage(browser, studio.address + address, trouble, { width, dark })
        await page.waitForTimeout(400)
        await act(page)
        await shot(page, `${name}-${dark ? 'dark' : 'light'}-${width}`)
        expect(await serious(page)).toEqual([])
        expect(trouble.told).toEqual([])
        await page.context().close()
      })
    }
  }
}
