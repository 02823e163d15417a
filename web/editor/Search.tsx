// Ctrl K: files, drawings, shapes and commands by a few letters.

import { type KeyboardEvent, type ReactNode, useDeferredValue, useMemo, useRef, useState } from 'react'

import { shapeOf } from '../diagram/gestures'
import { search } from '../diagram/search'
import { words } from '../words'
import { Icon } from './icons'
import { useStore } from './store'
import type { Studio } from './studio'

export interface Command {
  name: string
  icon: string
  key?: string
  act: () => void
}

interface Entry {
  name: string
  hint: string
  icon: string
  key?: string
  act: () => void
}

function entries(studio: Studio, commands: Command[]): Entry[] {
  const { files, hello, active } = studio.store.get()
  const all: Entry[] = commands.map((command) => ({ ...command, hint: words.search.command }))
  for (const file of [...files, ...(hello?.library ?? [])]) {
    const own = files.includes(file)
    const name = file.path.split('/').at(-1) ?? file.path
    all.push({
      name,
      hint: own ? file.path : words.shell.library,
      icon: own ? (['chart', 'model', 'scenario'].includes(file.kind) ? file.kind : 'yaml') : 'library',
      act: () => void studio.open(file.uri),
    })
  }
  for (const doc of studio.openDocs) {
    const chart = studio.chart(doc.file.uri)
    for (const drawing of chart?.store.get().pictures?.drawings ?? []) {
      all.push({
        name: drawing.title || drawing.name,
        hint: `${words.search.drawing} · ${doc.file.path.split('/').at(-1)}`,
        icon: 'picture',
        act: () => void studio.open(doc.file.uri, { drawing: drawing.name }),
      })
      if (doc.file.uri !== active) continue
      for (const box of drawing.picture.boxes) {
        const shape = shapeOf(box)
        if (!shape) continue
        all.push({
          name: box.lines.join(' ') || box.id,
          hint: `${words.shapes[shape]} ${box.id} · ${drawing.name}`,
          icon: shape,
          act: () => {
            chart?.turnTo(drawing.name)
            chart?.select({ boxes: [box.id], lines: [] })
            chart?.store.set((state) => ({ revealed: state.revealed + 1 }))
          },
        })
      }
    }
  }
  return all
}

export function Search({ studio, commands, close }: { studio: Studio; commands: Command[]; close: () => void }): ReactNode {
  const [question, setQuestion] = useState('')
  const [at, setAt] = useState(0)
  const list = useRef<HTMLUListElement>(null)
  const files = useStore(studio.store, (state) => state.files)
  const all = useMemo(() => entries(studio, commands), [studio, commands, files])
  const wanted = useDeferredValue(question)
  const found = useMemo(() => search(wanted, all, (entry) => entry.name, 50), [wanted, all])
  const chosen = Math.min(at, found.length - 1)
  const key = (event: KeyboardEvent): void => {
    const go = (by: number): void => {
      event.preventDefault()
      const next = (chosen + by + found.length) % Math.max(1, found.length)
      setAt(next)
      list.current?.children[next]?.scrollIntoView({ block: 'nearest' })
    }
    if (event.key === 'ArrowDown') go(1)
    if (event.key === 'ArrowUp') go(-1)
    if (event.key === 'Enter') {
      event.preventDefault()
      close()
      found[chosen]?.item.act()
    }
  }
  return (
    <div className="search" role="search">
      <div className="search-field">
        <Icon name="search" size={18} />
        <input
          autoFocus
          role="combobox"
          aria-expanded="true"
          aria-controls="search-list"
          aria-activedescendant={`search-${chosen}`}
          aria-label={words.search.label}
          placeholder={words.search.hint}
          value={question}
          spellCheck={false}
          onChange={(event) => {
            setQuestion(event.target.value)
            setAt(0)
          }}
          onKeyDown={key}
        />
        <kbd>Esc</kbd>
      </div>
      {found.length === 0 && <p className="search-none">{words.search.none}</p>}
      <ul ref={list} id="search-list" role="listbox" aria-label={words.search.label}>
        {found.map(({ item, match }, index) => (
          <li
            key={index}
            id={`search-${index}`}
            role="option"
            aria-selected={index === chosen}
            onPointerMove={() => setAt(index)}
            onClick={() => {
              close()
              item.act()
            }}
          >
            <Icon name={item.icon} />
            <span className="search-name">
              <Marked text={item.name} at={match.at} />
            </span>
            <span className="search-hint">{item.hint}</span>
            {item.key && <kbd>{item.key}</kbd>}
          </li>
        ))}
      </ul>
    </div>
  )
}

function Marked({ text, at }: { text: string; at: number[] }): ReactNode {
  const met = new Set(at)
  return [...text].map((letter, index) => (met.has(index) ? <b key={index}>{letter}</b> : <span key={index}>{letter}</span>))
}
