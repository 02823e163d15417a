// The list of files: by folder and kind, filtered by a few letters; below it what was deleted, and the pattern library.

import { type KeyboardEvent, type ReactNode, useMemo, useState } from 'react'

import { match } from '../diagram/search'
import type { File } from '../diagram/protocol'
import { Icon } from '../editor/icons'
import { type Item, Menu } from '../editor/Menu'
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
  const [menu, setMenu] = useState<{ file: File; at: { x: number; y: number }; from: HTMLElement } | null>(null)
  const keys = (event: KeyboardEvent, file: File): void => {
    const kind = ({ F2: 'renameFile', Delete: 'deleteFile' } as const)[event.key]
    if (!kind || !isOwn(studio, file)) return
    event.preventDefault()
    studio.store.set({ dialog: { kind, file } })
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
          onKeyDown={(event) => keys(event, file)}
          onContextMenu={(event) => {
            event.preventDefault()
            // The menu key tells no place.
            const { left, bottom } = event.currentTarget.getBoundingClientRect()
            const at = event.clientX > 0 ? { x: event.clientX, y: event.clientY } : { x: left + 20, y: bottom }
            setMenu({ file, at, from: event.currentTarget })
          }}
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
        <Deleted studio={studio} />
        {library.length > 0 && question.trim() === '' && (
          <Folder name={words.shell.library} forced={active !== null && library.some((file) => file.uri === active)} icon="library">
            {library.map(line)}
          </Folder>
        )}
      </div>
      {menu && (
        <Menu
          at={menu.at}
          label={words.files.menu(fileName(menu.file))}
          items={fileItems(studio, menu.file)}
          close={() => {
            setMenu(null)
            menu.from.focus()
          }}
        />
      )}
    </nav>
  )
}

const isOwn = (studio: Studio, file: File): boolean => !studio.hello.readOnly && !studio.isLibrary(file.uri)

function fileItems(studio: Studio, file: File): (Item | null)[] {
  const open: Item = { name: words.files.open, icon: <Icon name={kindIcon(file)} />, key: 'Enter', act: () => void studio.open(file.uri) }
  if (!isOwn(studio, file)) return [open]
  const ask = (kind: 'renameFile' | 'deleteFile') => () => studio.store.set({ dialog: { kind, file } })
  const extract: Item = { name: words.files.extract, icon: <Icon name="chart" />, act: () => void studio.files.extract(file) }
  return [
    open,
    ...(studio.files.mayExtract(file) ? [extract] : []),
    null,
    { name: words.files.rename, key: 'F2', act: ask('renameFile') },
    { name: words.files.ask, key: 'Del', danger: true, icon: <Icon name="trash" />, act: ask('deleteFile') },
  ]
}

// What was deleted since the page was opened.
function Deleted({ studio }: { studio: Studio }): ReactNode {
  const deleted = useStore(studio.files.store, (state) => state.deleted)
  if (deleted.length === 0) return null
  return (
    <section className="folder deleted" aria-label={words.files.deletedHere}>
      <h2 className="folder-name">{words.files.deletedHere}</h2>
      <ul className="folder-files">
        {deleted.map(({ path }) => {
          const name = path.split('/').at(-1) ?? path
          return (
            <li key={path} className="row">
              <span className="file-name" title={path}>
                {name}
              </span>
              <button className="small" aria-label={words.files.putBackNamed(name)} onClick={() => void studio.files.putBack(path)}>
                {words.files.putBack}
              </button>
            </li>
          )
        })}
      </ul>
    </section>
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
