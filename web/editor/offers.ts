// What a link may name: completions of the language server at the link, else the names that the chart's model declares.

import type { Box } from '../diagram/protocol'
import type { Chart } from './chart'
import type { Studio } from './studio'

interface Completion {
  label: string
  insertText?: string
}

interface Outline {
  name: string
  kind: number
  detail?: string
  children?: Outline[]
}

// Names that cannot be called stand for states, rules for actions, the rest for guards.
const fits = (box: Box, name: string): boolean => {
  if (box.figure === 'circle') return /^[A-Z][A-Z0-9_]*$/.test(name)
  if (box.figure === 'rectangle' || box.figure === 'block') return name.startsWith('r_')
  return /^[a-z]/.test(name) && !name.startsWith('r_') && !name.startsWith('inv_')
}

const names = (items: readonly Outline[]): string[] => items.flatMap((item) => [item.name, ...names(item.children ?? [])])

async function completed(studio: Studio, chart: Chart, box: Box): Promise<string[]> {
  if (!box.range || box.link === null) return []
  const from = chart.doc.offsetAt(box.range.start)
  const text = chart.doc.text.slice(from, chart.doc.offsetAt(box.range.end))
  const open = text.indexOf('{')
  if (open < 0) return []
  const params = { textDocument: { uri: chart.doc.file.uri }, position: chart.doc.positionAt(from + open + 1) }
  const answer = await studio.ask<{ items: Completion[] } | Completion[] | null>('textDocument/completion', params)
  const items = Array.isArray(answer) ? answer : (answer?.items ?? [])
  return items.map((item) => item.label)
}

async function declared(studio: Studio, chart: Chart): Promise<string[]> {
  const model = studio.sibling(chart.doc.file, 'asm')
  if (!model) return []
  const answer = await studio.ask<Outline[] | null>('textDocument/documentSymbol', { textDocument: { uri: model.uri } })
  return names(answer ?? [])
}

export async function linkOffers(studio: Studio, chart: Chart, box: Box): Promise<string[]> {
  const found = await Promise.allSettled([completed(studio, chart, box), declared(studio, chart)])
  const all = found.flatMap((result) => (result.status === 'fulfilled' ? result.value : []))
  const used = chart.store.get().pictures?.drawings.flatMap((drawing) => drawing.picture.boxes.map((box) => box.link ?? '')) ?? []
  const fitting = [...new Set([...used, ...all])].filter((name) => name !== '' && fits(box, name))
  return fitting.slice(0, 100)
}
