// What is told above the files: that the program is not there, and what to do; texts of an earlier page that are in no file.
//
// In: the studio. Out: nothing but what the buttons do. INVARIANT: what is said to be kept is kept (`rescue`).

import type { ReactNode } from 'react'

import { Icon } from '../editor/icons'
import { lastName } from '../editor/ofChart'
import { isLost } from '../editor/server'
import { useStore } from '../editor/store'
import type { Studio } from '../editor/studio'
import { words } from '../words'

export function Banners({ studio }: { studio: Studio }): ReactNode {
  return (
    <>
      <Lost studio={studio} />
      <Waiting studio={studio} />
    </>
  )
}

// The folder as a shell takes it.
function folderOf(root: string): string {
  const path = decodeURIComponent(root.replace(/^file:\/\//, ''))
  return /^[\w./-]+$/.test(path) ? path : `'${path.replaceAll("'", "'\\''")}'`
}

async function copy(studio: Studio, name: string, text: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text)
    studio.tell(words.lost.copied(name))
  } catch {
    studio.tell(words.lost.noClipboard, 'refused')
  }
}

function Lost({ studio }: { studio: Studio }): ReactNode {
  const online = useStore(studio.store, (state) => state.online)
  const active = useStore(studio.store, (state) => state.active)
  useStore(studio.store, (state) => state.opened)
  if (!isLost(online)) return null
  const doc = studio.doc(active)
  return (
    <div className="banner" role="alert">
      <Icon name="warning" size={14} />
      <p>
        {online === 'unknown' ? (
          words.lost.other
        ) : (
          <>
            {words.lost.gone} {words.lost.start} <code>{words.lost.command(folderOf(studio.hello.root), location.port)}</code>
          </>
        )}{' '}
        {words.lost.open}
      </p>
      {doc && !doc.readOnly && (
        <button className="small" onClick={() => void copy(studio, lastName(doc.file.path), doc.mine ?? doc.text)}>
          {words.lost.copy}
        </button>
      )}
    </div>
  )
}

function Waiting({ studio }: { studio: Studio }): ReactNode {
  const waiting = useStore(studio.rescue.store, (state) => state.waiting)
  const files = useStore(studio.store, (state) => state.files)
  const online = useStore(studio.store, (state) => state.online)
  if (waiting.length === 0 || online !== 'open') return null
  const writeAgain = async (path: string): Promise<void> => {
    const text = studio.rescue.kept(path)?.text ?? ''
    if (await studio.write(path, text)) studio.rescue.drop(path)
  }
  return (
    <div className="banner" role="status">
      <Icon name="warning" size={14} />
      <p>{words.kept.waiting(waiting.map(lastName))}</p>
      {waiting.map((path) => {
        const file = files.find((file) => file.path === path)
        const name = lastName(path)
        return (
          <span key={path} className="row">
            <button className="small" onClick={() => void (file ? studio.open(file.uri) : writeAgain(path))}>
              {file ? words.kept.open(name) : words.kept.write(name)}
            </button>
            <button className="small" onClick={() => studio.rescue.drop(path)}>
              {words.kept.discard(name)}
            </button>
          </span>
        )
      })}
    </div>
  )
}
