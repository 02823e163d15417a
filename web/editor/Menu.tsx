// A small list of things to choose from, at a place of the screen.
//
// Owns: its keys (arrows, Enter, Escape), and that it closes when one looks elsewhere.

import { type KeyboardEvent, type ReactNode, useEffect, useRef } from 'react'

export interface Item {
  name: string
  icon?: ReactNode
  key?: string
  danger?: boolean
  act: () => void
}

export interface MenuProps {
  at: { x: number; y: number }
  label: string
  items: (Item | null)[]
  close: () => void
}

export function Menu({ at, label, items, close }: MenuProps): ReactNode {
  const menu = useRef<HTMLDivElement>(null)
  useEffect(() => {
    menu.current?.querySelector('button')?.focus()
    const away = (event: Event): void => {
      if (!menu.current?.contains(event.target as Node)) close()
    }
    window.addEventListener('pointerdown', away, true)
    return () => window.removeEventListener('pointerdown', away, true)
  }, [close])
  const key = (event: KeyboardEvent): void => {
    event.stopPropagation()
    const buttons = [...(menu.current?.querySelectorAll('button') ?? [])]
    const index = buttons.indexOf(document.activeElement as HTMLButtonElement)
    const go = (by: number): void => {
      event.preventDefault()
      buttons[(index + by + buttons.length) % buttons.length]?.focus()
    }
    if (event.key === 'Escape') close()
    if (event.key === 'ArrowDown' || event.key === 'Tab') go(1)
    if (event.key === 'ArrowUp') go(-1)
  }
  const left = Math.min(at.x, window.innerWidth - 240)
  const top = Math.min(at.y, window.innerHeight - 28 * items.length - 24)
  return (
    <div ref={menu} className="menu" role="menu" aria-label={label} style={{ left, top }} onKeyDown={key}>
      {items.map((item, index) =>
        item === null ? (
          <hr key={index} />
        ) : (
          <button
            key={index}
            role="menuitem"
            className={item.danger ? 'danger' : undefined}
            onClick={() => {
              close()
              item.act()
            }}
          >
            <span className="menu-icon">{item.icon}</span>
            <span className="menu-name">{item.name}</span>
            {item.key && <kbd>{item.key}</kbd>}
          </button>
        ),
      )}
    </div>
  )
}
