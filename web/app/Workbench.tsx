// The workbench: files at the left, the open file in the middle, panels below; notices, dialogs, the tour.
//
// Owns: what is where, sizes, the address of what is in front. In: the server and its greeting.

import { type ReactNode, Suspense, lazy, useCallback, useEffect, useMemo, useState } from 'react'

import '@xyflow/react/dist/base.css'
import './shell.css'
import './controls.css'
import './dialogs.css'
import './figures.css'
import './canvas.css'
import './inspector.css'
import './panels.css'
import './script.css'
import './marks.css'
import './stategraph.css'
import './system.css'
import './systemrun.css'
import './code.css'
import './conflict.css'
import './narrow.css'
import type { Hello } from '../diagram/protocol'
import { Canvas } from '../editor/Canvas'
import type { Chart } from '../editor/chart'
import { GraphPanel } from '../editor/GraphPanel'
import { CheckPanel } from '../editor/CheckPanel'
import { CodePanel } from '../editor/CodePanel'
import { Dialogs } from '../editor/Dialogs'
import type { Doc } from '../editor/document'
import { Icon } from '../editor/icons'
import { Inspector } from '../editor/Inspector'
import { Problems, areWarnings, counted } from '../editor/Problems'
import { RunPanel } from '../editor/RunPanel'
import type { Server } from '../editor/server'
import { useStore } from '../editor/store'
import { type Panel, Studio, layoutShown } from '../editor/studio'
import { TextPane } from '../editor/TextPane'
import { TimelinePanel } from '../editor/TimelinePanel'
import { TimesPanel, useSystem } from '../editor/TimesPanel'
import { words } from '../words'
import { commands, shortcut } from './commands'
import { Drawings } from './Drawings'
import { Sidebar, fileName, kindIcon } from './Sidebar'
import { Splitter } from './Splitter'
import { tabKey } from './tabs'
import { TopBar } from './TopBar'
import { Tour } from './Tour'
import { Welcome } from './Welcome'
import { useAddress } from './address'
import { Banners } from './Banners'

const Conflict = lazy(() => import('../editor/Conflict'))

let studio: Studio | null = null

export default function Workbench({ server, hello }: { server: Server; hello: Hello }): ReactNode {
  // One studio for the life of the page.
  studio ??= new Studio(server, hello)
  return <Bench studio={studio} />
}

function Bench({ studio }: { studio: Studio }): ReactNode {
  const active = useStore(studio.store, (state) => state.active)
  const opened = useStore(studio.store, (state) => state.opened)
  const dialog = useStore(studio.store, (state) => state.dialog)
  const [sidebar, setSidebar] = useState(window.innerWidth >= 1100)
  useAddress(studio)
  useEffect(() => {
    const key = (event: KeyboardEvent): void => shortcut(studio, event)
    window.addEventListener('keydown', key, true)
    return () => window.removeEventListener('keydown', key, true)
  }, [studio])
  const narrow = useStore(studio.store, (state) => state.narrow)
  // The list of files lies on what it opens.
  useEffect(() => void (narrow && setSidebar(false)), [narrow, active])
  useLeaving(studio)
  useNarrow(studio)
  const doc = studio.doc(active)
  const chart = studio.chart(active)
  const all = useMemo(() => commands(studio), [studio, active, opened, dialog])
  return (
    <div className={`bench${sidebar ? '' : ' no-sidebar'}`}>
      <TopBar studio={studio} sidebar={sidebar} showSidebar={() => setSidebar(true)} />
      {sidebar && <Sidebar studio={studio} hide={() => setSidebar(false)} />}
      <main className="middle">
        <Tabs studio={studio} />
        <Banners studio={studio} />
        <div className="stage">{doc ? <Editor key={doc.file.uri} studio={studio} doc={doc} chart={chart} /> : <Welcome studio={studio} />}</div>
        <Panels studio={studio} />
      </main>
      <Notice studio={studio} />
      <Dialogs studio={studio} commands={all} />
      <Tour />
    </div>
  )
}

// SYNC(narrow): narrow.css.
const NARROW = '(max-width: 800px)'

function useNarrow(studio: Studio): void {
  useEffect(() => {
    const query = window.matchMedia(NARROW)
    const look = (): void => studio.store.set({ narrow: query.matches })
    look()
    query.addEventListener('change', look)
    return () => query.removeEventListener('change', look)
  }, [studio])
}

// What is typed is written before the page is hidden or left; the browser asks while something could be lost.
function useLeaving(studio: Studio): void {
  useEffect(() => {
    const hidden = (): void => void (document.visibilityState === 'hidden' && studio.flush())
    const left = (): void => void studio.flush()
    const leaving = (event: BeforeUnloadEvent): void => void (studio.flush() && event.preventDefault())
    document.addEventListener('visibilitychange', hidden)
    window.addEventListener('pagehide', left)
    window.addEventListener('beforeunload', leaving)
    return () => {
      document.removeEventListener('visibilitychange', hidden)
      window.removeEventListener('pagehide', left)
      window.removeEventListener('beforeunload', leaving)
    }
  }, [studio])
}

function Tabs({ studio }: { studio: Studio }): ReactNode {
  const tabs = useStore(studio.store, (state) => state.tabs)
  const active = useStore(studio.store, (state) => state.active)
  useStore(studio.store, (state) => state.opened)
  if (tabs.length === 0) return null
  return (
    <nav className="tabs" aria-label={words.shell.tabs}>
      {tabs.map((uri) => {
        const file = studio.doc(uri)?.file
        if (!file) return null
        const name = fileName(file)
        return (
          <div key={uri} className={`tab ${file.kind}${uri === active ? ' on' : ''}`}>
            <button
              aria-current={uri === active ? 'page' : undefined}
              title={file.path}
              onClick={() => void studio.open(uri)}
              onAuxClick={(event) => event.button === 1 && studio.close(uri)}
            >
              <Icon name={kindIcon(file)} size={14} />
              {name}
            </button>
            <button className="tab-close" aria-label={words.shell.closeTab(name)} onClick={() => studio.close(uri)}>
              <Icon name="close" size={12} />
            </button>
          </div>
        )
      })}
    </nav>
  )
}

function Editor({ studio, doc, chart }: { studio: Studio; doc: Doc; chart: Chart | undefined }): ReactNode {
  const layout = useStore(studio.store, layoutShown)
  const conflict = useStore(doc.store, (state) => state.sync.conflict !== null)
  const [share, setShare] = useState(() => Number(localStorage.getItem('groundstate-share') ?? 0.6))
  const resize = useCallback((next: number) => {
    const kept = Math.min(0.8, Math.max(0.25, next))
    localStorage.setItem('groundstate-share', String(kept))
    setShare(kept)
  }, [])
  if (conflict) {
    return (
      <Suspense fallback={null}>
        <Conflict studio={studio} doc={doc} />
      </Suspense>
    )
  }
  if (!chart) return <TextPane studio={studio} doc={doc} />
  const both = layout === 'both'
  return (
    <div className="editor" style={both ? { gridTemplateColumns: `minmax(280px, ${share}fr) 5px minmax(240px, ${1 - share}fr)` } : undefined}>
      {layout !== 'text' && (
        <section className="picture-pane">
          <Drawings studio={studio} chart={chart} />
          <Canvas studio={studio} chart={chart} />
          <Inspector studio={studio} chart={chart} />
        </section>
      )}
      {both && <Splitter axis="x" value={Math.round(share * 100)} resize={resize} />}
      {layout !== 'picture' && <TextPane studio={studio} doc={doc} />}
    </div>
  )
}

const PANELS: { panel: Panel; icon: string }[] = [
  { panel: 'problems', icon: 'warning' },
  { panel: 'run', icon: 'play' },
  { panel: 'timeline', icon: 'timeline' },
  { panel: 'check', icon: 'shield' },
  { panel: 'graph', icon: 'states' },
  { panel: 'times', icon: 'clock' },
  { panel: 'code', icon: 'code' },
]

function Panels({ studio }: { studio: Studio }): ReactNode {
  const panel = useStore(studio.store, (state) => state.panel)
  const problems = useStore(studio.store, counted)
  const mild = useStore(studio.store, areWarnings)
  const running = useStore(studio.jobs.store, (state) => state.jobs.some((job) => job.running))
  const session = useStore(studio.runner.store, (state) => state.session !== null)
  const tall = useStore(studio.store, (state) => state.tall && state.panel === 'check')
  const [low, setHeight] = useState(() => Number(localStorage.getItem('groundstate-panel') ?? 250))
  const height = tall ? Math.max(low, window.innerHeight * 0.62) : low
  const resize = useCallback((_: number, event: PointerEvent) => {
    const kept = Math.min(window.innerHeight * 0.7, Math.max(110, window.innerHeight - event.clientY - 32))
    localStorage.setItem('groundstate-panel', String(Math.round(kept)))
    setHeight(kept)
    studio.store.set({ tall: false })
  }, [studio])
  return (
    <section className="panels">
      {panel && <Splitter axis="y" value={Math.round((height / window.innerHeight) * 100)} resize={resize} />}
      <div className="panel-tabs">
        <div className="row" role="tablist" aria-label={words.shell.panelTabs} onKeyDown={tabKey}>
        {PANELS.map(({ panel: one, icon }) => (
          <button key={one} role="tab" aria-selected={panel === one} tabIndex={(panel ?? PANELS[0]?.panel) === one ? 0 : -1} onClick={() => studio.store.set({ panel: panel === one ? null : one })}>
            <Icon name={icon} size={13} />
            {words.shell.panels[one]}
            {one === 'problems' && problems > 0 && <span className={`count${mild ? ' warning' : ''}`}>{problems}</span>}
            {((one === 'check' && running) || (one === 'run' && session)) && <span className="busy-dot" aria-hidden="true" />}
          </button>
        ))}
        </div>
        <span className="grow" />
        {panel && (
          <button className="quiet" title={words.shell.closePanel} aria-label={words.shell.closePanel} onClick={() => studio.store.set({ panel: null })}>
            <Icon name="close" size={14} />
          </button>
        )}
      </div>
      {panel && (
        <div className="panel" role="tabpanel" aria-label={words.shell.panels[panel]} style={{ height }}>
          {panel === 'problems' && <Problems studio={studio} />}
          {panel === 'run' && <RunPanel studio={studio} />}
          {panel === 'timeline' && <TimelinePanel studio={studio} />}
          {panel === 'check' && <CheckPanel studio={studio} />}
          {panel === 'graph' && <GraphPanel studio={studio} />}
          {panel === 'times' && <Times studio={studio} />}
          {panel === 'code' && <CodePanel studio={studio} />}
        </div>
      )}
    </section>
  )
}

function Times({ studio }: { studio: Studio }): ReactNode {
  const chart = useSystem(studio)
  if (chart) return <TimesPanel key={chart.doc.file.uri} studio={studio} chart={chart} />
  return (
    <div className="panel-empty tall">
      <h3>{words.shell.panels.times}</h3>
      <p>{words.system.noSystem}</p>
    </div>
  )
}

const NOTICE_MS = 6000

function Notice({ studio }: { studio: Studio }): ReactNode {
  const notice = useStore(studio.store, (state) => state.notice)
  useEffect(() => {
    if (!notice) return
    const timer = setTimeout(() => studio.store.set({ notice: null }), NOTICE_MS)
    return () => clearTimeout(timer)
  }, [notice, studio])
  if (!notice) return null
  return (
    <div key={notice.count} className={`notice ${notice.tone}`} role={notice.tone === 'refused' ? 'alert' : 'status'}>
      <Icon name={notice.tone === 'refused' ? 'warning' : 'check'} size={15} />
      <span>{notice.text}</span>
      {notice.action && (
        <button className="small" onClick={notice.action.act}>
          {notice.action.name}
        </button>
      )}
      <button className="quiet" aria-label={words.shell.dismiss} onClick={() => studio.store.set({ notice: null })}>
        <Icon name="close" size={13} />
      </button>
    </div>
  )
}
