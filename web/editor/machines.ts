// Machines of a chart get another name, and go: what names them is asked for, and their texts are changed.
//
// In: a chart, and the name of a machine, a pattern or a system in it. Out: changes of texts, one in each, which can be undone.
// INVARIANT: a text is changed only where it is the one that was asked about.

import { removal, renaming } from '../diagram/machines'
import type { MachineNames, TextEdit } from '../diagram/protocol'
import { isAtRisk } from '../diagram/sync'
import { changesOf } from '../diagram/text'
import { words } from '../words'
import type { Chart } from './chart'
import type { Doc } from './document'
import { lastName } from './ofChart'
import type { Studio } from './studio'

const TRIES = 3

// What names a machine, in the texts as they are; they are saved first. What is typed meanwhile is asked about again.
export async function namesOf(studio: Studio, chart: Chart, name: string): Promise<MachineNames> {
  const { doc } = chart
  const { path } = doc.file
  for (let tries = 0; tries < TRIES; tries++) {
    await studio.saveAll()
    if (isAtRisk(doc.store.get().sync)) throw new Error(words.files.undecided(lastName(path)))
    const before = doc.text
    const names = await studio.server.request<MachineNames>('studio/machine', { path, name })
    if (doc.text === before) return names
  }
  throw new Error(words.machines.typing)
}

export async function renameMachine(studio: Studio, chart: Chart, old: string, to: string, title: string | null): Promise<boolean> {
  try {
    const names = await namesOf(studio, chart, old)
    const { uri, path } = chart.doc.file
    const edits = to === old ? renaming(path, { ...names, places: [] }, to, title) : renaming(path, names, to, title)
    const targets: [Doc, TextEdit[]][] = []
    for (const [path, own] of edits) {
      const file = studio.fileAt(path)
      const doc = file && (await studio.document(file.uri))
      const named = names.places.filter((place) => place.path === path)
      const isThere = ({ range }: (typeof named)[number]): boolean => doc?.view.state.sliceDoc(doc.offsetAt(range.start), doc.offsetAt(range.end)) === old
      if (!doc || doc.readOnly || !named.every(isThere)) throw new Error(words.machines.other(lastName(path)))
      targets.push([doc, own])
    }
    for (const [doc, own] of targets) doc.change(changesOf(doc.text, own))
    studio.store.set(({ trail }) => ({ trail: trail.map((step) => (step.uri === uri && step.drawing === old ? { ...step, drawing: to } : step)) }))
    const others = targets.map(([doc]) => doc).filter((doc) => doc !== chart.doc)
    if (others.length > 0) studio.tell(words.machines.renamed(old, to, others.map(({ file }) => lastName(file.path))))
    return true
  } catch (error) {
    studio.tell((error as Error).message, 'refused')
    return false
  }
}

export async function deleteMachine(studio: Studio, chart: Chart, name: string): Promise<boolean> {
  try {
    const names = await namesOf(studio, chart, name)
    const { doc } = chart
    doc.change(changesOf(doc.text, removal(names)))
    studio.store.set(({ trail }) => ({ trail: trail.filter((step) => step.uri !== doc.file.uri || step.drawing !== name) }))
    studio.tell(words.machines.deleted(name), 'told', { name: words.canvas.undo, act: () => doc.undo() })
    return true
  } catch (error) {
    studio.tell((error as Error).message, 'refused')
    return false
  }
}
