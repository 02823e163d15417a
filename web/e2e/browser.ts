// The browser of the tests: Debian's Chromium, pages that fail a test if a script fails, and what tests do again and again.

import { mkdirSync } from 'node:fs'
import { join, resolve } from 'node:path'

import { type Browser, type Locator, type Page, chromium } from 'playwright-core'

const SHOTS = resolve(import.meta.dirname, '../shots')

export function opened(): Promise<Browser> {
  if (Number(process.versions.node.split('.')[0]) < 20) throw new Error('The tests in the browser need Node 20 or newer.')
  return chromium.launch({ executablePath: process.env['CHROMIUM'] ?? '/usr/bin/chromium', args: ['--no-sandbox'] })
}

export interface Trouble {
  told: string[]
}

export async function page(browser: Browser, address: string, trouble: Trouble, options: { width?: number; dark?: boolean } = {}): Promise<Page> {
  const context = await browser.newContext({
    viewport: { width: options.width ?? 1400, height: 860 },
    colorScheme: options.dark ? 'dark' : 'light',
    permissions: ['clipboard-read', 'clipboard-write'],
    reducedMotion: 'reduce',
  })
  const page = await context.newPage()
  page.on('pageerror', (error) => trouble.told.push(error.stack ?? error.message))
  page.on('console', (message) => message.type() === 'error' && trouble.told.push(message.text()))
  page.setDefaultTimeout(8_000)
  await page.goto(address)
  await page.locator('.bench').waitFor()
  return page
}

// `npm run e2e` leaves pictures to look at in `shots`.
export async function shot(page: Page, name: string): Promise<void> {
  mkdirSync(SHOTS, { recursive: true })
  await page.waitForTimeout(120)
  await page.screenshot({ path: join(SHOTS, `${name}.png`) })
}

export const shape = (page: Page, id: string): Locator => page.locator(`.react-flow__node[data-id="${id}"]`)

export async function middle(place: Locator): Promise<[number, number]> {
  const box = await place.boundingBox()
  if (!box) throw new Error('it is not on the page')
  return [box.x + box.width / 2, box.y + box.height / 2]
}

export async function drag(page: Page, from: [number, number], to: [number, number]): Promise<void> {
  await page.mouse.move(...from)
  await page.mouse.down()
  await page.mouse.move((from[0] + to[0]) / 2, (from[1] + to[1]) / 2, { steps: 4 })
  await page.mouse.move(...to, { steps: 4 })
  await page.mouse.up()
}

export const text = (page: Page): Promise<string> =>
  page.evaluate(() => [...document.querySelectorAll('.cm-line')].map((line) => line.textContent).join('\n'))

// A point on an arrow, on the screen.
export async function onArrow(page: Page, name: string): Promise<[number, number]> {
  const path = page.getByRole('img', { name }).locator('.reach')
  return path.evaluate((path) => {
    const line = path as SVGPathElement
    const at = line.getPointAtLength(line.getTotalLength() * 0.4).matrixTransform(line.getScreenCTM() ?? undefined)
    return [at.x, at.y]
  })
}
