// The list of problems: faults of the open folder, those of the file in front first. A click leads to the place.

import { type ReactNode, useMemo } from 'react'

import type { Fault } from '../diagram/pick'
import { words } from '../words'
import { Icon } from './icons'
import { useStore } from './store'
import type { Studio, StudioState } from './studio'

const ORDER = { error: 0, warning: 1, info: 2, hint: 3 }

// How many faults there are to mend.
export const counted = (state: StudioState): number => ofFiles(state).length

// Whether all of them are warnings.
export const areWarnings = (state: StudioState): boolean => ofFiles(state).every(({ severity }) => severity === 'warning')

const ofFiles = ({ faults, files }: StudioState): Fault[] =>
  files.flatMap(({ uri }) => (faults.get(uri) ?? []).filter(({ severity }) => severity === 'error' || severity === 'warning'))

export function Problems({ studio }: { studio: Studio }): ReactNode {
  const faults = useStore(studio.store, (state) => state.faults)
  const active = useStore(studio.store, (state) => state.active)
  const files = useStore(studio.store, (state) => state.files)
  const pictures = studio.chart(active)?.store.get().pictures?.problems ?? []
  const groups = useMemo(() => {
    const known = new Map(files.map((file) => [file.uri, file]))
    const all: { path: string; uri: string; faults: Fault[] }[] = []
    for (const [uri, list] of faults) {
      const file = known.get(uri)
      const told = list.filter((fault) => fault.severity !== 'hint')
      if (file && told.length > 0) all.push({ path: file.path, uri, faults: told.sort((a, b) => ORDER[a.severity] - ORDER[b.severity] || a.range.start.line - b.range.start.line) })
    }
    return all.sort((a, b) => Number(b.uri === active) - Number(a.uri === active) || a.path.localeCompare(b.path))
  }, [active, faults, files])
  if (groups.length === 0 && pictures.length === 0) {
    return (
      <div className="panel-empty">
        <Icon name="check" size={18} />
        {words.problems.none}
      </div>
    )
  }
  return (
    <ul className="problems">
      {pictures.map((problem, index) => (
        <li key={index} className="problem">
          <span className="severity warning">
            <Icon name="picture" size={14} />
          </span>
          <span>{problem}</span>
        </li>
      ))}
      {groups.map((group) => (
        <li key={group.uri}>
          <h3>{group.path}</h3>
          <ul>
            {group.faults.map((fault, index) => (
              <li key={index}>
                <button className="problem" onClick={() => void studio.open(group.uri, { range: fault.range })}>
                  <span className={`severity ${fault.severity}`} aria-label={fault.severity}>
                    <Icon name={fault.severity === 'error' ? 'cross' : 'warning'} size={13} />
                  </span>
                  <span className="message">{fault.message}</span>
                  <span className="place">
                    {fault.range.start.line + 1}:{fault.range.start.character + 1}
                  </span>
                </button>
              </li>
            ))}
          </ul>
        </li>
      ))}
    </ul>
  )
}
