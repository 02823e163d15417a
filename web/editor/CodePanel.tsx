// The C++ beside a model: its files, one of them to read, whether it is current; generating it, building it, running it.
//
// In: the chart or model in front, and what is selected in it. Out: jobs; a click on a line leads to its place in the model. Nothing is
// edited here.

import { EditorState, StateEffect, StateField } from '@codemirror/state'
import { Decoration, type DecorationSet, EditorView, drawSelection, highlightSpecialChars, keymap, lineNumbers } from '@codemirror/view'
import { highlightSelectionMatches, searchKeymap } from '@codemirror/search'
import { defaultKeymap } from '@codemirror/commands'
import { type ReactNode, useEffect, useRef, useState } from 'react'

import { drawingAt, rangesOf } from '../diagram/pick'
import type { File } from '../diagram/protocol'
import { words } from '../words'
import { Code, type CodeState } from './code'
import { cpp } from './cpp'
import { Icon } from './icons'
import { useStore } from './store'
import type { Studio } from './studio'
import { editorTheme } from './theme'

const setMarked = StateEffect.define<readonly number[]>()

const marked = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(value, transaction) {
    let next = value.map(transaction.changes)
    for (const effect of transaction.effects) {
      if (!effect.is(setMarked)) continue
      const { doc } = transaction.state
      const lines = effect.value.filter((line) => line >= 1 && line <= doc.lines).sort((a, b) => a - b)
      next = Decoration.set(lines.map((line) => Decoration.line({ class: 'cm-ran cm-ran-next' }).range(doc.line(line).from)))
    }
    return next
  },
  provide: (field) => EditorView.decorations.from(field),
})

// What is generated for a file in front: of a chart with a system the program, else the class of its model.
export function generatedFrom(studio: Studio, uri: string | null): File | null {
  const file = uri === null ? undefined : studio.file(uri)
  if (!file || studio.isLibrary(file.uri)) return null
  if (file.kind === 'model') return file
  if (file.kind !== 'chart') return null
  const drawings = studio.chart(file.uri)?.store.get().pictures?.drawings ?? []
  return drawings.some((drawing) => drawing.kind === 'system') ? file : (studio.sibling(file, 'asm') ?? null)
}

const hasProgram = (file: File | null): boolean => file?.kind === 'chart'

let code: Code | null = null

export function CodePanel({ studio }: { studio: Studio }): ReactNode {
  code ??= new Code(studio)
  return <Panel studio={studio} code={code} />
}

function Panel({ studio, code }: { studio: Studio; code: Code }): ReactNode {
  const state = useStore(code.store, (state) => state)
  const active = useStore(studio.store, (state) => state.active)
  useStore(studio.store, (state) => state.opened)
  const ended = useStore(studio.jobs.store, (state) => state.jobs.filter((job) => !job.running).length)
  useFollowing(studio, code, active, ended)
  const source = generatedFrom(studio, active)
  const { generated } = state
  if (!generated || generated.state === 'none') {
    return (
      <div className="panel-empty tall">
        <h3>{words.code.none}</h3>
        <p>{state.refused ?? (source ? words.code.noneHint : words.code.notHere)}</p>
        <Actions studio={studio} source={source} program={false} />
      </div>
    )
  }
  return (
    <div className="code-panel">
      <div className="code-side">
        <ul className="code-files" aria-label={words.code.files}>
          {generated.files.map((file) => (
            <li key={file}>
              <button className={file === state.file ? 'on' : undefined} aria-current={file === state.file} title={file} onClick={() => void code.open(file)}>
                {file}
              </button>
            </li>
          ))}
        </ul>
      </div>
      <div className="code-main">
        <header className="row code-head">
          <Currency generated={generated} />
          <span className="grow" />
          <Actions studio={studio} source={source} program />
        </header>
        <Reader code={code} state={state} />
      </div>
    </div>
  )
}

function Currency({ generated }: { generated: NonNullable<CodeState['generated']> }): ReactNode {
  const [tone, icon] = ({ current: ['good', 'check'], older: ['bad', 'warning'], unknown: ['unknown', 'question'], none: ['unknown', 'question'] } as const)[generated.state]
  const names = generated.changed.map((path) => path.split('/').at(-1) ?? path).join(', ')
  return (
    <span className={`outcome ${tone} currency`} role="status">
      <Icon name={icon} size={13} />
      {generated.state === 'older' ? words.code.older(names) : generated.state === 'current' ? words.code.current : words.code.unknown}
    </span>
  )
}

function Actions({ studio, source, program }: { studio: Studio; source: File | null; program: boolean }): ReactNode {
  const [how, setHow] = useState('real 5')
  const busy = useStore(studio.jobs.store, (state) => state.jobs.some((job) => job.running && (job.job === 'generate' || job.job === 'program')))
  if (!source || studio.hello.readOnly) return null
  const [pace, seconds] = how.split(' ')
  return (
    <div className="row">
      <button className="small" disabled={busy} onClick={() => void studio.jobs.start('generate', source).then(() => studio.store.set({ panel: 'code' }))}>
        <Icon name="code" size={13} />
        {words.jobs.generate}
      </button>
      {program && hasProgram(source) && (
        <>
          <select className="small" aria-label={words.code.how} title={words.code.how} value={how} onChange={(event) => setHow(event.target.value)}>
            {(['real 5', 'real 20', 'real 60', 'virtual 5', 'virtual 60'] as const).map((one) => (
              <option key={one} value={one}>
                {words.code.paces[one]}
              </option>
            ))}
          </select>
          <button className="small primary" disabled={busy} onClick={() => void studio.jobs.start('program', source, { seconds: Number(seconds), pace })}>
            <Icon name="play" size={13} />
            {words.jobs.program}
          </button>
        </>
      )}
    </div>
  )
}

// Looks again when it may be another, and follows what is selected in the model.
function useFollowing(studio: Studio, code: Code, active: string | null, ended: number): void {
  useEffect(() => void code.look(active), [code, active, ended])
  const opened = useStore(studio.store, (state) => state.opened)
  useEffect(() => {
    const stops = studio.openDocs.flatMap((doc) => {
      const saved = doc.store.subscribe(() => code.later())
      const cursor = (at: { line: number; character: number }): void => void code.select(doc.file.uri, at)
      doc.onCursor.push(cursor)
      return [saved, () => (doc.onCursor = doc.onCursor.filter((known) => known !== cursor))]
    })
    return () => stops.forEach((stop) => stop())
  }, [studio, code, active, opened])
  // Shapes that are selected on the canvas.
  useEffect(() => {
    const chart = studio.chart(active)
    if (!chart) return
    let before = chart.store.get().selection
    return chart.store.subscribe(() => {
      const { selection } = chart.store.get()
      if (selection === before) return
      before = selection
      const drawing = chart.drawing
      const first = drawing && rangesOf(drawing, selection)[0]
      if (!first || !drawingAt([drawing], first.start)) return
      void code.select(chart.doc.file.uri, nameOf(chart, selection) ?? first.start)
    })
  }, [studio, code, active, opened])
}

// A component's class stands for its name.
function nameOf(chart: NonNullable<ReturnType<Studio['chart']>>, selection: { boxes: string[] }): { line: number; character: number } | null {
  const box = chart.drawing?.picture.boxes.find((box) => box.id === selection.boxes[0])
  return box?.nameRange?.start ?? null
}

function Reader({ code, state }: { code: Code; state: CodeState }): ReactNode {
  const place = useRef<HTMLDivElement>(null)
  const view = useRef<EditorView | null>(null)
  useEffect(() => {
    if (!place.current) return
    const made = new EditorView({
      parent: place.current,
      state: EditorState.create({
        extensions: [
          EditorState.readOnly.of(true),
          EditorView.editable.of(false),
          EditorView.contentAttributes.of({ tabindex: '0', 'aria-label': words.code.text, 'aria-readonly': 'true' }),
          EditorState.tabSize.of(4),
          lineNumbers(),
          highlightSpecialChars(),
          drawSelection(),
          highlightSelectionMatches({ minSelectionLength: 3 }),
          cpp,
          keymap.of([...searchKeymap, ...defaultKeymap]),
          marked,
          editorTheme,
          EditorView.updateListener.of((update) => {
            if (!update.selectionSet || !update.transactions.some((one) => one.isUserEvent('select'))) return
            void code.lead(update.state.doc.lineAt(update.state.selection.main.head).number)
          }),
        ],
      }),
    })
    view.current = made
    return () => made.destroy()
  }, [code])
  useEffect(() => {
    const now = view.current
    if (now && now.state.doc.toString() !== state.text) now.dispatch({ changes: { from: 0, to: now.state.doc.length, insert: state.text } })
  }, [state.text, state.file])
  useEffect(() => {
    const now = view.current
    if (!now) return
    const first = state.marked[0]
    const at = first !== undefined && first <= now.state.doc.lines ? now.state.doc.line(first).from : null
    now.dispatch({ effects: [setMarked.of(state.marked), ...(at === null ? [] : [EditorView.scrollIntoView(at, { y: 'center' })])] })
  }, [state.marked, state.revealed, state.text])
  return <div ref={place} className="mounted code-text" />
}
