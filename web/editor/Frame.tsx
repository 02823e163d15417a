// The frame that all dialogs have, and the buttons at the end of those that make something.

import { type ReactNode, useEffect, useRef } from 'react'

import { words } from '../words'

export function Frame({ label, close, wide, children }: { label: string; close: () => void; wide?: boolean; children: ReactNode }): ReactNode {
  const dialog = useRef<HTMLDialogElement>(null)
  useEffect(() => {
    dialog.current?.showModal()
  }, [])
  return (
    <dialog
      ref={dialog}
      className={wide ? 'frame wide' : 'frame'}
      aria-label={label}
      onClose={close}
      onPointerDown={(event) => event.target === dialog.current && dialog.current?.close()}
    >
      {children}
    </dialog>
  )
}

export function Buttons({ act, enabled, close }: { act: string; enabled: boolean; close: () => void }): ReactNode {
  return (
    <footer className="row">
      <span className="grow" />
      <button type="button" onClick={close}>
        {words.dialogs.cancel}
      </button>
      <button type="submit" className="primary" disabled={!enabled}>
        {act}
      </button>
    </footer>
  )
}
