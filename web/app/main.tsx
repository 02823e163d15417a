// Where the page begins: colours, the connection, the first question to the server, then the workbench.
//
// The workbench comes as a part of its own, so that the frame is there at once.

import { type ReactNode, StrictMode, Suspense, lazy, useEffect, useState } from 'react'
import { createRoot } from 'react-dom/client'

import type { Hello } from '../diagram/protocol'
import { words } from '../words'
import './colours.css'
import './frame.css'
import { isLost } from '../editor/server'
import { Connection } from './connection'
import { setTheme, theme } from './theme'

setTheme(theme())

const Workbench = lazy(() => import('./Workbench'))

const connection = new Connection(`${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/ws`)

function Page(): ReactNode {
  const [hello, setHello] = useState<Hello | null>(null)
  const [lost, setLost] = useState(false)
  useEffect(() => {
    if (hello) return
    const ask = (): void => {
      connection.request<Hello>('studio/hello', {}).then(setHello, () => setLost(true))
    }
    connection.watch((online) => {
      if (online === 'open') ask()
      if (isLost(online)) setLost(true)
    })
    if (connection.online === 'open') ask()
  }, [hello])
  if (!hello) {
    return (
      <main className="waiting" aria-busy={!lost}>
        <span className="mark" aria-hidden="true" />
        {lost ? <p>{words.shell.lost}</p> : <p className="unseen">{words.shell.connecting}</p>}
      </main>
    )
  }
  return (
    <Suspense fallback={<main className="waiting" aria-busy="true"><span className="mark" aria-hidden="true" /></main>}>
      <Workbench server={connection} hello={hello} />
    </Suspense>
  )
}

connection.open()
const root = document.getElementById('root')
if (root) {
  createRoot(root).render(
    <StrictMode>
      <Page />
    </StrictMode>,
  )
}
