// What is shown while no file is open: the charts and models of the folder, or how to begin.

import type { ReactNode } from 'react'

import type { File } from '../diagram/protocol'
import { Icon } from '../editor/icons'
import { useStore } from '../editor/store'
import type { Studio } from '../editor/studio'
import { words } from '../words'
import { fileName } from './Sidebar'

const SHOWN = 12

export function Welcome({ studio }: { studio: Studio }): ReactNode {
  const files = useStore(studio.store, (state) => state.files)
  const hello = useStore(studio.store, (state) => state.hello)
  const charts = files.filter((file) => file.kind === 'chart')
  const models = files.filter((file) => file.kind === 'model' && !charts.some((chart) => chart.path.replace(/chart$/, 'asm') === file.path))
  const empty = charts.length + models.length === 0
  const gallery = (hello?.library ?? []).filter((file) => file.kind === 'chart')
  const start = (): void => studio.store.set({ dialog: { kind: 'new' } })
  return (
    <div className="welcome">
      <div className="welcome-inner">
        <span className="mark" aria-hidden="true" />
        <h1>{empty ? words.welcome.emptyTitle : words.welcome.title(hello?.name ?? '')}</h1>
        <p>{empty ? words.welcome.emptyHint : words.welcome.hint}</p>
        <div className="row">
          {!studio.hello.readOnly && (
            <button className="primary" onClick={start}>
              <Icon name="plus" />
              {words.welcome.start}
            </button>
          )}
          <button onClick={() => window.dispatchEvent(new Event('groundstate-tour'))}>
            <Icon name="flag" />
            {words.welcome.tour}
          </button>
        </div>
        <Cards studio={studio} title={words.welcome.charts} files={charts} />
        <Cards studio={studio} title={words.welcome.models} files={models} />
        <Cards studio={studio} title={words.shell.library} files={gallery} />
      </div>
    </div>
  )
}

function Cards({ studio, title, files }: { studio: Studio; title: string; files: File[] }): ReactNode {
  if (files.length === 0) return null
  return (
    <section>
      <h2>{title}</h2>
      <ul className="welcome-files">
        {files.slice(0, SHOWN).map((file) => (
          <li key={file.uri}>
            <button className={`file-card ${file.kind}`} onClick={() => void studio.open(file.uri)}>
              <Icon name={file.kind === 'chart' ? 'chart' : 'model'} size={18} />
              <span>
                <b>{fileName(file).replace(/\.\w+$/, '')}</b>
                <small>{file.path.split('/').slice(0, -1).join('/') || fileName(file)}</small>
              </span>
            </button>
          </li>
        ))}
      </ul>
    </section>
  )
}
