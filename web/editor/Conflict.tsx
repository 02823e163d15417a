// A conflict, side by side: the user's text on the left, which can be edited, the file's on the right.
//
// In: a document in conflict. Out: the decision, written with the hash of what the file holds. Until then the browser keeps the user's text.

import { MergeView } from '@codemirror/merge'
import { EditorState } from '@codemirror/state'
import { EditorView, lineNumbers } from '@codemirror/view'
import { type ReactNode, useEffect, useRef } from 'react'

import { words } from '../words'
import type { Doc } from './document'
import { coloured } from './language'
import { useStore } from './store'
import type { Studio } from './studio'
import { editorTheme } from './theme'

export default function Conflict({ studio, doc }: { studio: Studio; doc: Doc }): ReactNode {
  const place = useRef<HTMLDivElement>(null)
  const view = useRef<MergeView | null>(null)
  const conflict = useStore(doc.store, (state) => state.sync.conflict)
  const theirs = conflict?.theirs
  const failed = useStore(studio.rescue.store, (state) => state.failed.has(doc.file.path))
  useEffect(() => {
    const parent = place.current
    if (!parent || theirs === undefined) return
    const kept = (text: string): void => {
      doc.mine = text
      studio.rescue.now(doc)
    }
    const shared = [lineNumbers(), coloured(doc.file.kind), editorTheme, EditorState.lineSeparator.of('\n'), EditorState.tabSize.of(4)]
    view.current = new MergeView({
      a: { doc: doc.mine ?? doc.text, extensions: [...shared, EditorView.updateListener.of(({ state, docChanged }) => docChanged && kept(state.doc.toString()))] },
      b: { doc: theirs, extensions: [...shared, EditorState.readOnly.of(true), EditorView.editable.of(false)] },
      parent,
      revertControls: 'b-to-a',
      collapseUnchanged: { margin: 4, minSize: 6 },
      gutter: true,
    })
    return () => view.current?.destroy()
  }, [studio, doc, theirs])
  if (!conflict) return null
  const decide = (text: string): void => {
    doc.mine = null
    doc.event({ kind: 'decided', text })
  }
  return (
    <div className="conflict" role="dialog" aria-label={words.conflict.title}>
      <header>
        <div>
          <h2>{words.conflict.title}</h2>
          <p>
            {words.conflict.hint} {failed ? words.kept.notInBrowser : words.kept.inBrowser}
          </p>
        </div>
        <div className="row">
          <button className="primary" onClick={() => decide(view.current?.a.state.doc.toString() ?? doc.text)}>
            {words.conflict.keepMine}
          </button>
          <button onClick={() => decide(conflict.theirs)}>{words.conflict.takeTheirs}</button>
          <button
            onClick={() => {
              const a = view.current?.a
              a?.dispatch({ changes: { from: 0, to: a.state.doc.length, insert: conflict.merged } })
            }}
          >
            {words.conflict.merged}
          </button>
        </div>
      </header>
      <div className="conflict-heads">
        <span>{words.conflict.mine}</span>
        <span>{words.conflict.theirs}</span>
      </div>
      <div ref={place} className="merge" />
    </div>
  )
}
