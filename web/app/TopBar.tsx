// The bar at the top: the folder, the way here, the save state, search, run, checks, what is shown, colours.

import { type ReactNode, useState } from 'react'

import { status } from '../diagram/sync'
import { Icon } from '../editor/icons'
import { Menu } from '../editor/Menu'
import { runsInFront, startRun } from '../editor/RunPanel'
import { useStore } from '../editor/store'
import type { Doc } from '../editor/document'
import { type Layout, type Studio, layoutShown } from '../editor/studio'
import { words } from '../words'
import { jobIcons, jobsFor } from './commands'
import { following, setTheme, theme } from './theme'

const LAYOUTS: Layout[] = ['both', 'picture', 'text']

export function TopBar({ studio, sidebar, showSidebar }: { studio: Studio; sidebar: boolean; showSidebar: () => void }): ReactNode {
  const active = useStore(studio.store, (state) => state.active)
  const layout = useStore(studio.store, layoutShown)
  const narrow = useStore(studio.store, (state) => state.narrow)
  const online = useStore(studio.store, (state) => state.online)
  const name = useStore(studio.store, (state) => state.hello?.name ?? '')
  useStore(studio.store, (state) => state.opened)
  useStore(studio.store, (state) => state.files)
  const [colours, setColours] = useState(theme())
  const [menu, setMenu] = useState<{ x: number; y: number } | null>(null)
  const doc = studio.doc(active)
  const jobs = jobsFor(studio, active)
  const first = jobs.find(({ job }) => job === 'verify') ?? jobs.find(({ job }) => job === 'test' || job === 'refine')
  const file = doc?.file
  const chartOf = file && studio.files.mayExtract(file) ? [{ name: words.files.extract, icon: <Icon name="chart" />, act: () => void studio.files.extract(file) }] : []
  return (
    <header className="topbar">
      {!sidebar && (
        <button className="quiet" title={words.shell.showFiles} aria-label={words.shell.showFiles} onClick={showSidebar}>
          <Icon name="sidebar" />
        </button>
      )}
      <span className="brand">
        <span className="brand-mark" aria-hidden="true" />
        <b>{name}</b>
      </span>
      <Trail studio={studio} />
      <span className="grow" />
      {doc && <Saved studio={studio} doc={doc} />}
      {online !== 'open' && (
        <span className="state-chip bad" role="status">
          {words.shell.connecting}
        </span>
      )}
      <button className="search-button" title={words.shell.search} onClick={() => studio.store.set({ dialog: { kind: 'search' } })}>
        <Icon name="search" size={14} />
        <span>{words.shell.searchShort}</span>
        <kbd>Ctrl K</kbd>
      </button>
      {doc && doc.file.kind === 'chart' && (
        <div className="segments" role="radiogroup" aria-label={words.shell.layouts}>
          {LAYOUTS.filter((one) => !narrow || one !== 'both').map((one) => (
            <button key={one} role="radio" aria-checked={layout === one} title={words.shell.layout[one]} aria-label={words.shell.layout[one]} onClick={() => studio.store.set({ layout: one })}>
              <Icon name={one} />
            </button>
          ))}
        </div>
      )}
      <button
        className="quiet"
        title={words.shell.theme[colours]}
        aria-label={words.shell.theme[colours]}
        onClick={() => {
          const next = following[colours]
          setTheme(next)
          setColours(next)
        }}
      >
        <Icon name={colours === 'light' ? 'sun' : colours === 'dark' ? 'moon' : 'auto'} />
      </button>
      {jobs.length > 0 && (
        <div className="joined">
          {first && (
            <button aria-label={words.jobs[first.job]} onClick={first.act}>
              <Icon name={jobIcons[first.job]} />
              <span className="wide-only">{words.jobs[first.job]}</span>
            </button>
          )}
          <button
            className="square"
            aria-haspopup="menu"
            aria-label={words.shell.more}
            title={words.shell.more}
            onClick={(event) => {
              const rect = event.currentTarget.getBoundingClientRect()
              setMenu({ x: rect.right - 200, y: rect.bottom + 6 })
            }}
          >
            <span className="turn open">
              <Icon name="chevron" size={13} />
            </span>
          </button>
        </div>
      )}
      {doc && ['chart', 'model', 'scenario'].includes(doc.file.kind) && (
        <button className="primary" onClick={() => (runsInFront(studio) ? studio.store.set({ panel: 'run' }) : void startRun(studio))}>
          <Icon name="play" size={14} />
          {words.run.start}
        </button>
      )}
      {menu && <Menu at={menu} label={words.shell.more} close={() => setMenu(null)} items={[...jobs.map(({ job, act }) => ({ name: words.jobs[job], icon: <Icon name={jobIcons[job]} />, act })), ...chartOf]} />}
    </header>
  )
}

function Trail({ studio }: { studio: Studio }): ReactNode {
  const trail = useStore(studio.store, (state) => state.trail)
  if (trail.length === 0) return null
  const title = (uri: string, name: string): string =>
    studio.chart(uri)?.store.get().pictures?.drawings.find((drawing) => drawing.name === name)?.title || name
  return (
    <nav className="trail" aria-label={words.shell.trail}>
      {trail.map((stop, index) => (
        <button key={index} className="link-button" onClick={() => void studio.back(index)}>
          {title(stop.uri, stop.drawing)}
          <Icon name="chevron" size={12} />
        </button>
      ))}
    </nav>
  )
}

function Saved({ studio, doc }: { studio: Studio; doc: Doc }): ReactNode {
  const sync = useStore(doc.store, (state) => state.sync)
  if (doc.readOnly) return <span className="state-chip">{words.shell.readOnly}</span>
  const now = status(sync)
  const tone = now === 'saved' ? '' : now === 'conflict' || now === 'gone' || now === 'failed' ? 'bad' : 'busy'
  return (
    <span className={`state-chip ${tone}`} role="status" title={sync.failure ?? (now === 'gone' ? words.save.goneHint : undefined)}>
      {words.save[now]}
      {now === 'gone' && (
        <button className="link-button" onClick={() => doc.event({ kind: 'decided', text: sync.text })}>
          {words.save.writeAgain}
        </button>
      )}
      {now === 'failed' && (
        <button className="link-button" onClick={() => void studio.saveAll()}>
          {words.save.retry}
        </button>
      )}
    </span>
  )
}
