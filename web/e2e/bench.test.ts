// Measurements of the studio in the browser, printed: first picture, sizes, frames while panning and dragging, the way from a letter
// to its fault, from a step to its picture. Nothing is asserted: machines differ.

import { readFileSync, readdirSync, writeFileSync } from 'node:fs'
import { join, resolve } from 'node:path'
import { gzipSync } from 'node:zlib'

import type { Browser, Page } from 'playwright-core'
import { afterAll, beforeAll, test } from 'vitest'

import { type Trouble, middle, opened, page as newPage, shape } from './browser'
import { type Served, copied, removed, served } from './served'

const SHAPES = 500

// Rings of states and guards side by side, each shape with its place.
function large(): string {
  const lines = ['chart Large', '', 'machine large "Large"', '\tcontrol phase']
  const places = ['', 'layout large']
  const half = SHAPES / 2
  for (let index = 0; index < half; index++) {
    lines.push(`\t${index === 0 ? 'initial ' : ''}state s${index} "State ${index}"`, `\tguard g${index} "Guard ${index}"`)
    const [x, y] = [(index % 20) * 180, Math.floor(index / 20) * 240]
    places.push(`\ts${index} at ${x}, ${y}`, `\tg${index} at ${x}, ${y + 110}`)
  }
  for (let index = 0; index < half; index++) {
    lines.push(`\ts${index} -> g${index} yes -> s${(index + 1) % half}`, `\tg${index} no -> s${index}`)
  }
  return `${lines.join('\n')}\nendmachine\n${places.join('\n')}\nendlayout\n`
}

let browser: Browser
let studio: Served
const trouble: Trouble = { told: [] }

beforeAll(async () => {
  const folder = copied('examples', 'library')
  writeFileSync(join(folder, 'Large.chart'), large())
  studio = await served(folder)
  browser = await opened()
})

afterAll(async () => {
  await browser?.close()
  studio?.stop()
  if (studio) removed(studio.folder)
})

const at = (sorted: number[], share: number): number => sorted[Math.min(sorted.length - 1, Math.floor(sorted.length * share))] ?? 0

function told(name: string, values: number[], unit: string): void {
  const sorted = [...values].sort((a, b) => a - b)
  console.log(`${name}: p50 ${at(sorted, 0.5).toFixed(1)} ${unit}, p95 ${at(sorted, 0.95).toFixed(1)} ${unit} (${values.length})`)
}

// The lengths of the frames while something is done.
async function frames(page: Page, work: () => Promise<void>): Promise<number[]> {
  await page.evaluate(() => {
    const seen: number[] = []
    let last = performance.now()
    const tick = (now: number): void => {
      seen.push(now - last)
      last = now
      requestAnimationFrame(tick)
    }
    requestAnimationFrame(tick)
    Object.assign(window, { seen })
  })
  await work()
  return (await page.evaluate(() => (window as unknown as { seen: number[] }).seen)).slice(2)
}

test('sizes', () => {
  const assets = resolve(import.meta.dirname, '../dist/assets')
  const scripts = readdirSync(assets).filter((name) => name.endsWith('.js'))
  const bytes = scripts.map((name) => gzipSync(readFileSync(join(assets, name))).length)
  console.log(`scripts: ${Math.round(bytes.reduce((sum, size) => sum + size, 0) / 1024)} KiB gzip in ${scripts.length} files`)
})

test('first paint', async () => {
  const times: number[] = []
  for (let round = 0; round < 5; round++) {
    const context = await browser.newContext()
    const page = await context.newPage()
    await page.goto(studio.address)
    await page.locator('.bench').waitFor()
    times.push(await page.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? performance.now()))
    await context.close()
  }
  told('first paint', times, 'ms')
})

test('a chart of 500 shapes', async () => {
  const page = await newPage(browser, `${studio.address}#/Large.chart`, trouble)
  await shape(page, 's0').waitFor({ timeout: 30_000 })
  await page.waitForTimeout(800)
  const pane = page.locator('.canvas')
  const [x, y] = await middle(pane)
  await page.mouse.move(x, y)
  const panned = await frames(page, async () => {
    for (let step = 0; step < 90; step++) {
      await page.mouse.wheel(step % 40 < 20 ? 18 : -18, 8)
      await page.waitForTimeout(8)
    }
  })
  told('frame while panning 500 shapes', panned, 'ms')
  await page.keyboard.press('f')
  await page.waitForTimeout(500)
  const node = page.locator('.react-flow__node .box.circle').nth(100)
  const [nx, ny] = await middle(node)
  await page.mouse.move(nx, ny)
  await page.mouse.down()
  const dragged = await frames(page, async () => {
    for (let step = 0; step < 90; step++) {
      await page.mouse.move(nx + (step % 30) * 2, ny + (step % 20) * 2)
      await page.waitForTimeout(8)
    }
  })
  await page.mouse.up()
  told('frame while dragging one of 500 shapes', dragged, 'ms')
  await page.context().close()
})

test('a letter and its fault', async () => {
  const page = await newPage(browser, `${studio.address}#/examples/visual_servoing/VisualServoingComponent.chart`, trouble)
  await shape(page, 'waiting').waitFor()
  await page.locator('.cm-line', { hasText: 'control vsState' }).click()
  await page.keyboard.press('End')
  const times: number[] = []
  for (let round = 0; round < 12; round++) {
    await page.evaluate(() => {
      const begun = performance.now()
      const watch = new MutationObserver(() => {
        if (!document.querySelector('.cm-lintRange-error')) return
        watch.disconnect()
        Object.assign(window, { took: performance.now() - begun })
      })
      Object.assign(window, { took: null })
      watch.observe(document.querySelector('.cm-content') as Node, { subtree: true, childList: true, attributes: true })
    })
    await page.keyboard.press('(')
    await page.waitForFunction(() => (window as unknown as { took: number | null }).took !== null)
    times.push(await page.evaluate(() => (window as unknown as { took: number }).took))
    await page.keyboard.press('Control+z')
    await page.waitForFunction(() => !document.querySelector('.cm-lintRange-error'))
    await page.waitForTimeout(100)
  }
  told('letter → fault', times, 'ms')
  await page.context().close()
})

test('a step and its picture', async () => {
  const page = await newPage(browser, `${studio.address}#/examples/mutual_exclusion/Peterson.asm`, trouble)
  await page.locator('.cm-content').waitFor()
  await page.keyboard.press('F5')
  await page.locator('.state-table').waitFor()
  const times: number[] = []
  for (let round = 0; round < 30; round++) {
    await page.evaluate(() => {
      const begun = performance.now()
      const watch = new MutationObserver(() => {
        watch.disconnect()
        Object.assign(window, { took: performance.now() - begun })
      })
      Object.assign(window, { took: null })
      watch.observe(document.querySelector('.run') as Node, { subtree: true, childList: true, characterData: true })
    })
    const offer = page.locator('.offers button').first()
    if ((await offer.count()) > 0) await offer.evaluate((button) => (button as HTMLButtonElement).click())
    else await page.keyboard.press('F10')
    await page.waitForFunction(() => (window as unknown as { took: number | null }).took !== null)
    times.push(await page.evaluate(() => (window as unknown as { took: number }).took))
    await page.waitForTimeout(30)
  }
  told('step → picture', times, 'ms')
  await page.context().close()
})

const BITS = 10
const STEPS = 10_000

// Each step changes ten values: after ten thousand steps there are a hundred thousand events to draw.
function busy(): string {
  const names = Array.from({ length: BITS }, (_, index) => `bit${index}`)
  return `asm Busy
import StandardLibrary
signature:
\tcontrolled count: Integer
${names.map((name) => `\tcontrolled ${name}: Boolean`).join('\n')}
definitions:
\tmain rule r_Main =
\t\tpar
\t\t\tcount := count + 1
${names.map((name) => `\t\t\t${name} := not ${name}`).join('\n')}
\t\tendpar
default init s0:
\tfunction count = 0
${names.map((name) => `\tfunction ${name} = false`).join('\n')}
`
}

test('a timeline of 100 000 events', async () => {
  writeFileSync(join(studio.folder, 'Busy.asm'), busy())
  const page = await newPage(browser, studio.address, trouble)
  await page.evaluate(() => localStorage.setItem('groundstate-panel', '430'))
  await page.goto(`${studio.address}#/Busy.asm`)
  await page.reload()
  await page.locator('.cm-content').waitFor()
  await page.keyboard.press('F5')
  await page.locator('.state-table').waitFor()
  await page.getByLabel('Speed', { exact: true }).selectOption({ label: 'As fast as can be' })
  await page.keyboard.press('F5')
  const step = page.locator('.run-step')
  for (let tries = 0; tries < 600; tries++) {
    if (Number(/\d+/.exec((await step.textContent()) ?? '')?.[0] ?? 0) >= STEPS) break
    await page.waitForTimeout(200)
  }
  await page.keyboard.press('F5')
  console.log(`the run is at ${await step.textContent()}, with ${BITS} events a step`)
  await page.getByRole('tab', { name: 'Timeline' }).click()
  const detail = page.locator('.timeline #detail')
  await detail.waitFor()
  await page.waitForTimeout(1500)
  const [x, y] = await middle(detail)
  const where = page.locator('.timeline #where')
  const pan = async (): Promise<number[]> => {
    const seen = new Set<string>()
    await page.mouse.move(x, y)
    await page.mouse.down()
    const panned = await frames(page, async () => {
      for (let index = 0; index < 120; index++) {
        await page.mouse.move(x + (index % 60 < 30 ? index % 30 : 30 - (index % 30)) * 6, y)
        if (index % 7 === 0) seen.add((await where.textContent()) ?? '')
        await page.waitForTimeout(8)
      }
    })
    await page.mouse.up()
    if (seen.size < 3) throw new Error(`the timeline stands still: ${[...seen].join()}`)
    return panned
  }
  told('frame while panning a timeline of 100 000 events', await pan(), 'ms')
  // All of it, then a half: each picture has tens of thousands of events.
  const button = (name: string) => page.locator('.timeline').locator(`[data-do="${name}"]`)
  await button('all').click()
  await button('in').click()
  await page.waitForTimeout(300)
  told('frame while panning with most of it in view', await pan(), 'ms')
  await page.evaluate(() => localStorage.removeItem('groundstate-panel'))
  await page.context().close()
}, 300_000)
