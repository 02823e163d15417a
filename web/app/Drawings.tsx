// The drawings of a chart, a tab for each; a machine is made, renamed and deleted here.
//
// In: the chart. Out: which drawing is shown; dialogs. Double-click, F2, Delete and the menu of a tab are about its machine.

import { type KeyboardEvent, type MouseEvent, type ReactNode, useState } from 'react'

import type { Drawing } from '../diagram/protocol'
import type { Chart } from '../editor/chart'
import { Icon } from '../editor/icons'
import { Menu } from '../editor/Menu'
import { useStore } from '../editor/store'
import type { Studio } from '../editor/studio'
import { words } from '../words'
import { tabKey } from './tabs'

const ICONS = { pattern: 'instance', system: 'component', machine: 'state' }

export function Drawings({ studio, chart }: { studio: Studio; chart: Chart }): ReactNode {
  const pictures = useStore(chart.store, (state) => state.pictures)
  const shown = useStore(chart.store, (state) => state.shown)
  const [menu, setMenu] = useState<{ drawing: Drawing; at: { x: number; y: number }; from: HTMLElement } | null>(null)
  const drawings = pictures?.drawings ?? []
  const { uri } = chart.doc.file
  const { readOnly } = chart.doc
  const turn = (name: string): void => {
    studio.store.set({ trail: [] })
    chart.turnTo(name)
    void studio.runner.evaluate()
  }
  const ask = (kind: 'renameMachine' | 'deleteMachine', { name }: Drawing): void => {
    if (!readOnly) studio.store.set({ dialog: { kind, uri, name } })
  }
  const keys = (event: KeyboardEvent, drawing: Drawing): void => {
    const kind = ({ F2: 'renameMachine', Delete: 'deleteMachine' } as const)[event.key]
    if (!kind || readOnly) return
    event.preventDefault()
    ask(kind, drawing)
  }
  const open = (event: MouseEvent<HTMLElement>, drawing: Drawing): void => {
    if (readOnly) return
    event.preventDefault()
    // Keys tell no place.
    const { left, bottom } = event.currentTarget.getBoundingClientRect()
    const at = event.type === 'contextmenu' && event.clientX > 0 ? { x: event.clientX, y: event.clientY } : { x: left, y: bottom + 2 }
    setMenu({ drawing, at, from: event.currentTarget })
  }
  const front = drawings.find(({ name }) => name === shown)
  return (
    <div className="drawings">
      <div className="drawing-tabs" role="tablist" aria-label={words.shell.drawings} onKeyDown={tabKey}>
        {drawings.map((drawing) => (
          <button
            key={drawing.name}
            role="tab"
            className={drawing.kind}
            aria-selected={drawing.name === shown}
            tabIndex={drawing.name === shown ? 0 : -1}
            title={drawing.name}
            onClick={() => turn(drawing.name)}
            onDoubleClick={() => ask('renameMachine', drawing)}
            onKeyDown={(event) => keys(event, drawing)}
            onContextMenu={(event) => open(event, drawing)}
          >
            <Icon name={ICONS[drawing.kind]} size={14} />
            {drawing.title || drawing.name}
          </button>
        ))}
      </div>
      {!readOnly && (
        <>
          {front && (
            <button className="quiet" title={words.machines.more} aria-label={words.machines.more} aria-haspopup="menu" onClick={(event) => open(event, front)}>
              <Icon name="more" size={14} />
            </button>
          )}
          <button className="quiet" title={words.canvas.newMachine} aria-label={words.canvas.newMachine} onClick={() => studio.store.set({ dialog: { kind: 'machine', uri } })}>
            <Icon name="plus" size={14} />
          </button>
        </>
      )}
      {menu && (
        <Menu
          at={menu.at}
          label={words.machines.menu(menu.drawing.title || menu.drawing.name)}
          items={[
            { name: words.machines.rename, key: 'F2', icon: <Icon name="text" />, act: () => ask('renameMachine', menu.drawing) },
            { name: words.machines.delete, key: 'Del', danger: true, icon: <Icon name="trash" />, act: () => ask('deleteMachine', menu.drawing) },
          ]}
          close={() => {
            setMenu(null)
            menu.from.focus()
          }}
        />
      )}
    </div>
  )
}
