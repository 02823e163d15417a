// The text of a file on the page: the view of its document, and beside a chart that of its model.

import { type ReactNode, useEffect, useRef, useState } from 'react'

import { words } from '../words'
import type { Doc } from './document'
import { Icon } from './icons'
import { useStore } from './store'
import type { Studio } from './studio'

export function TextPane({ studio, doc }: { studio: Studio; doc: Doc }): ReactNode {
  const beside = useStore(studio.store, (state) => state.beside)
  useStore(studio.store, (state) => state.files)
  const model = doc.file.kind === 'chart' ? studio.sibling(doc.file, 'asm') : undefined
  const [other, setOther] = useState<Doc | null>(null)
  const wanted = model && beside === 'model' ? model.uri : null
  useEffect(() => {
    setOther(null)
    if (wanted !== null) void studio.document(wanted).then(setOther)
  }, [studio, wanted])
  const shown = wanted !== null ? other : doc
  return (
    <section className="text-pane" aria-label={words.shell.layout.text}>
      {model && (
        <div className="text-tabs" role="tablist" aria-label={words.shell.layout.text}>
          <button role="tab" aria-selected={beside === 'chart'} onClick={() => studio.store.set({ beside: 'chart' })}>
            <Icon name="chart" size={14} />
            {words.text.chart}
          </button>
          <button role="tab" aria-selected={beside === 'model'} onClick={() => studio.store.set({ beside: 'model' })}>
            <Icon name="model" size={14} />
            {words.text.model}
          </button>
          <span className="text-path">{(shown ?? doc).file.path}</span>
        </div>
      )}
      {shown && <Mounted doc={shown} />}
    </section>
  )
}

function Mounted({ doc }: { doc: Doc }): ReactNode {
  const place = useRef<HTMLDivElement>(null)
  useEffect(() => {
    const parent = place.current
    if (!parent) return
    parent.appendChild(doc.view.dom)
    doc.view.requestMeasure()
    return () => {
      if (doc.view.dom.parentNode === parent) parent.removeChild(doc.view.dom)
    }
  }, [doc])
  return <div ref={place} className="mounted" />
}
