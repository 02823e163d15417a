// The list of files: by folder and kind, filtered by a few letters; below it the pattern library.

import { type ReactNode, useMemo, useState } from 'react'

import { match } from '../diagram/search'
import type { File } from '../diagram/protocol'
import { Icon } from '../editor/icons'
import { useStore } from '../editor/store'
import type { Studio } from '../editor/studio'
import { words } from '../words'

const ORDER = { chart: 0, model: 1, scenario: 2, report: 3, verification: 4, coupling: 5 }
export const kindIcon = (file: File): string => (file.kind in { chart: 1, model: 1, scenario: 1 } ? file.kind : 'yaml')
export const fileName = (file: File): string => file.path.split('/').at(-1) ?? file.path
const folderOf = (file: File): string => file.path.split('/').slice(0, -1).join('/')

interface Group {
  folder: string
  files: File[]
}

function grouped(files: readonly File[]): Group[] {
  const groups = new Map<string, File[]>()
  for (const file of files) groups.set(folderOf(file), [...(groups.get(folderOf(file)) ?? []), file])
  return [...groups]
    .map(([folder, files]) => ({ folder, files: files.sort((a, b) => ORDER[a.kind] - ORDER[b.kind] || a.path.localeCompare(b.path)) }))
    .sort((a, b) => a.folder.localeCompare(b.folder))
}

export function Sidebar({ studio, hide }: { studio: Studio; hide: () => void }): ReactNode {
  const files = useStore(studio.store, (state) => state.files)
  const library = useStore(studio.store, (state) => state.hello?.library) ?? []
  const active = useStore(studio.store, (state) => state.active)
  const faults = useStore(studio.store, (state) => state.faults)
  const [question, setQuestion] = useState('')
  const groups = useMemo(
    () => grouped(question.trim() === '' ? files : files.filter((file) => match(question, file.path))),
    [files, question],
  )
  const activeFolder = files.find((file) => file.uri === active)
  const worst = (file: File): string | null => {
    const list = faults.get(file.uri)
    if (!list) return null
    return list.some((fault) => fault.severity === 'error') ? 'error' : list.some((fault) => fault.severity === 'warning') ? 'warning' : null
  }
  const line = (file: File): ReactNode => {
    const wrong = worst(file)
    return (
      <li key={file.uri}>
        <button
          className={`file ${file.kind}${file.uri === active ? ' on' : ''}`}
          aria-current={file.uri === active ? 'page' : undefined}
          title={file.path}
          onClick={() => void studio.open(file.uri)}
        >
          <Icon name={kindIcon(file)} />
          <span className="file-name">{fileName(file)}</span>
          {wrong && <span className={`fault-dot ${wrong}`} aria-label={wrong} />}
        </button>
      </li>
    )
  }
  return (
    <nav className="sidebar" aria-label={words.shell.files}>
      <div className="sidebar-head">
        <input type="search" aria-label={words.shell.filter} placeholder={words.shell.filter} value={question} onChange={(event) => setQuestion(event.target.value)} />
        {!studio.hello.readOnly && (
          <button className="quiet" title={words.shell.new} aria-label={words.shell.new} onClick={() => studio.store.set({ dialog: { kind: 'new' } })}>
            <Icon name="plus" />
          </button>
        )}
        <button className="quiet" title={words.shell.hideFiles} aria-label={words.shell.hideFiles} onClick={hide}>
          <Icon name="sidebar" />
        </button>
      </div>
      <div className="file-scroll">
        {groups.length === 0 && question !== '' && <p className="faint-note">{words.shell.none}</p>}
        {groups.map((group) => (
          <Folder
            key={group.folder}
            name={group.folder}
            forced={question.trim() !== '' || groups.length <= 3 || (activeFolder !== undefined && folderOf(activeFolder) === group.folder)}
          >
            {group.files.map(line)}
          </Folder>
        ))}
        {library.length > 0 && question.trim() === '' && (
          <Folder name={words.shell.library} forced={active !== null && library.some((file) => file.uri === active)} icon="library">
            {library.map(line)}
          </Folder>
        )}
      </div>
    </nav>
  )
}

function Folder({ name, forced, icon, children }: { name: string; forced: boolean; icon?: string; children: ReactNode }): ReactNode {
  const [open, setOpen] = useState<boolean | null>(null)
  const shown = open ?? forced
  if (name === '') return <ul className="folder-files root">{children}</ul>
  return (
    <section className="folder">
      <button className="folder-name" aria-expanded={shown} onClick={() => setOpen(!shown)}>
        <span className={`turn${shown ? ' open' : ''}`}>
          <Icon name="chevron" size={12} />
        </span>
        {icon && <Icon name={icon} size={14} />}
        <span>{name}</span>
      </button>
      {shown && <ul className="folder-files">{children}</ul>}
    </section>
  )
}
