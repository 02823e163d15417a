// The address of what is in front: `#/path/of/file.chart/drawing`. Back and forward lead between files and drawings.

import { useEffect } from 'react'

import type { Studio } from '../editor/studio'
import { useStore } from '../editor/store'

const encoded = (path: string): string => path.split('/').map(encodeURIComponent).join('/')

async function follow(studio: Studio): Promise<void> {
  const hash = decodeURIComponent(location.hash.replace(/^#\/?/, ''))
  if (hash === '') return
  const { files, hello } = studio.store.get()
  const file = files.find((file) => hash === file.path || hash.startsWith(`${file.path}/`)) ?? hello?.library.find((file) => hash === file.path || hash.startsWith(`${file.path}/`))
  if (!file) return
  const drawing = hash.slice(file.path.length + 1)
  await studio.open(file.uri, drawing === '' ? {} : { drawing })
}

export function useAddress(studio: Studio): void {
  const active = useStore(studio.store, (state) => state.active)
  useEffect(() => {
    const go = (): void => void follow(studio)
    go()
    window.addEventListener('hashchange', go)
    return () => window.removeEventListener('hashchange', go)
  }, [studio])
  useEffect(() => {
    const file = active === null ? undefined : studio.file(active)
    const chart = studio.chart(active)
    if (!file) return
    const write = (): void => {
      const shown = chart?.store.get().shown
      const hash = `#/${encoded(file.path)}${shown ? `/${encodeURIComponent(shown)}` : ''}`
      document.title = `${file.path.split('/').at(-1)} · Groundstate`
      if (location.hash === hash) return
      // The first drawing that shows itself is no step of its own.
      if (location.hash.startsWith(`#/${encoded(file.path)}`) && !location.hash.startsWith(`#/${encoded(file.path)}/`)) history.replaceState(null, '', hash)
      else history.pushState(null, '', hash)
    }
    write()
    return chart?.store.subscribe(write)
  }, [active, studio])
}
