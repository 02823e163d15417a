// The commands of the studio, for Ctrl K, menus and keys.
//
// In: the studio. Out: names with what they do, those that fit what is open.

import { formatDocument } from '@codemirror/lsp-client'

import type { File, JobKind } from '../diagram/protocol'
import { withModel } from '../editor/ofChart'
import { runsInFront, startRun } from '../editor/RunPanel'
import type { Command } from '../editor/Search'
import type { Layout, Studio } from '../editor/studio'
import { words } from '../words'
import { following, setTheme, theme } from './theme'

// Whether a chart has a system, by its picture, or by its text while there is none.
function hasSystem(studio: Studio, chart: File): boolean {
  const pictures = studio.chart(chart.uri)?.store.get().pictures
  if (pictures) return pictures.drawings.some((drawing) => drawing.kind === 'system')
  return /^\s*system\s+\w/m.test(studio.doc(chart.uri)?.text ?? '')
}

// The jobs that fit a file. A system is verified as it is drawn; a chart of machines alone by its model.
export function jobsFor(studio: Studio, uri: string | null): { job: JobKind; act: () => void }[] {
  const file = uri === null ? undefined : studio.file(uri)
  if (!file || studio.isLibrary(file.uri)) return []
  const start = (job: JobKind, at = file) => ({ job, act: () => void studio.jobs.start(job, at) })
  const onModel = (job: JobKind) => ({
    job,
    act: () => void withModel(studio, { what: job, chart: file, act: (model, isOlder) => void studio.jobs.start(job, model, undefined, { chart: file, isOlder }) }),
  })
  switch (file.kind) {
    case 'chart': {
      const verify = { job: 'verify' as const, act: () => (hasSystem(studio, file) ? start('verify') : onModel('verify')).act() }
      const system = hasSystem(studio, file)
      const show = (job: JobKind, panel: 'times' | 'code') => ({ job, act: () => studio.store.set({ panel }) })
      const times = system ? [show('times', 'times')] : []
      const program = system && !studio.hello.readOnly ? [start('program')] : []
      const rest = studio.sibling(file, 'asm') ? [start('check'), onModel('test'), onModel('graph'), onModel('review'), ...(system ? [] : [onModel('mutate')])] : []
      // Of a system, its times and channels have faults too, and the machines that it names.
      const mutate = system ? [start('mutate')] : []
      const generate = system ? [start('generate')] : studio.sibling(file, 'asm') ? [onModel('generate')] : []
      return [...(studio.hello.readOnly ? [] : [start('build')]), verify, ...times, ...rest, ...mutate, ...generate, ...program]
    }
    case 'model':
      return [start('verify'), start('test'), start('graph'), start('review'), start('mutate'), start('generate')]
    case 'scenario':
      return [start('test')]
    case 'coupling':
      return [start('refine')]
    default:
      return []
  }
}

export function commands(studio: Studio): Command[] {
  const { active } = studio.store.get()
  const show = (layout: Layout) => () => studio.store.set({ layout })
  const chart = studio.chart(active)
  const doc = studio.doc(active)
  const all: Command[] = [
    { name: words.commands.run, icon: 'play', key: 'F5', act: () => void startRun(studio) },
    ...jobsFor(studio, active).map(({ job, act }) => ({ name: words.jobs[job], icon: jobIcons[job], act })),
  ]
  if (chart && active !== null && !chart.doc.readOnly) {
    all.push(
      { name: words.commands.newMachine, icon: 'plus', act: () => studio.store.set({ dialog: { kind: 'machine', uri: active } }) },
      { name: words.commands.autoLayout, icon: 'layout', act: () => void chart.operate({ kind: 'layout' }) },
    )
    const name = chart.drawing?.name
    if (name !== undefined) {
      all.push(
        { name: words.machines.renameCommand, icon: 'text', act: () => studio.store.set({ dialog: { kind: 'renameMachine', uri: active, name } }) },
        { name: words.machines.deleteCommand, icon: 'trash', act: () => studio.store.set({ dialog: { kind: 'deleteMachine', uri: active, name } }) },
      )
    }
  }
  if (doc && !doc.readOnly) all.push({ name: words.commands.format, icon: 'text', key: 'Shift Alt F', act: () => void formatDocument(doc.view) })
  const file = doc && !doc.readOnly ? doc.file : undefined
  if (file) {
    all.push(
      { name: words.commands.renameFile, icon: 'text', act: () => studio.store.set({ dialog: { kind: 'renameFile', file } }) },
      { name: words.commands.deleteFile, icon: 'trash', act: () => studio.store.set({ dialog: { kind: 'deleteFile', file } }) },
    )
  }
  if (file && studio.files.mayExtract(file)) all.push({ name: words.commands.extract, icon: 'chart', act: () => void studio.files.extract(file) })
  if (!studio.hello.readOnly) all.push({ name: words.commands.newProject, icon: 'plus', act: () => studio.store.set({ dialog: { kind: 'new' } }) })
  all.push(
    { name: words.commands.problems, icon: 'warning', act: () => studio.store.set({ panel: 'problems' }) },
    { name: words.commands.code, icon: 'code', act: () => studio.store.set({ panel: 'code' }) },
    { name: words.commands.layoutBoth, icon: 'both', key: 'Ctrl 1', act: show('both') },
    { name: words.commands.layoutPicture, icon: 'picture', key: 'Ctrl 2', act: show('picture') },
    { name: words.commands.layoutText, icon: 'text', key: 'Ctrl 3', act: show('text') },
    { name: words.commands.theme, icon: 'auto', act: () => setTheme(following[theme()]) },
    { name: words.commands.keys, icon: 'keyboard', key: '?', act: () => studio.store.set({ dialog: { kind: 'keys' } }) },
    { name: words.commands.tour, icon: 'flag', act: () => window.dispatchEvent(new Event('groundstate-tour')) },
  )
  return all
}

export const jobIcons: Record<JobKind, string> = {
  verify: 'shield',
  test: 'beaker',
  build: 'hammer',
  check: 'compare',
  generate: 'code',
  review: 'search',
  times: 'clock',
  mutate: 'mutant',
  refine: 'refine',
  graph: 'states',
  program: 'play',
}

// Keys that work everywhere. Undo and redo reach the text of the file in front also from the canvas and the panels.
export function shortcut(studio: Studio, event: KeyboardEvent): void {
  const control = event.ctrlKey || event.metaKey
  const key = event.key.toLowerCase()
  const target = event.target as HTMLElement
  const typing = target.closest('input, textarea, .cm-editor, select') !== null
  const { dialog, active } = studio.store.get()
  const done = (): void => {
    event.preventDefault()
    event.stopPropagation()
  }
  if (control && key === 'k') {
    done()
    return studio.store.set({ dialog: dialog?.kind === 'search' ? null : { kind: 'search' } })
  }
  if (dialog) return
  if (control && key === 's') {
    done()
    return void studio.saveAll()
  }
  if (control && ['1', '2', '3'].includes(key)) {
    done()
    return studio.store.set({ layout: key === '1' ? 'both' : key === '2' ? 'picture' : 'text' })
  }
  const doc = studio.doc(active)
  if (control && !typing && doc && (key === 'z' || key === 'y')) {
    done()
    return key === 'y' || event.shiftKey ? doc.redo() : doc.undo()
  }
  const { runner } = studio
  const run = runner.store.get()
  if (event.key === 'F5') {
    done()
    if (!runsInFront(studio)) return void startRun(studio)
    return run.playing ? runner.pause() : runner.play()
  }
  if (event.key === 'F10') {
    done()
    if (!runsInFront(studio)) return void startRun(studio)
    studio.store.set({ panel: 'run' })
    if (event.shiftKey) return void runner.back()
    // A step that waits for an answer: the first that is offered gets the focus.
    if (run.session?.waiting === 'step') return void runner.step()
    document.querySelector<HTMLElement>('.asked button, .asked input, .asked select')?.focus()
    return
  }
  if (event.key === '?' && !typing) {
    done()
    studio.store.set({ dialog: { kind: 'keys' } })
  }
}
