// A field with its label: committed by Enter or by leaving it; and a switch.
//
// In: a value. Out: what was typed instead. What is refused stays in the field to be mended; whoever commits says why (`operating`).

import { type FormEvent, type ReactNode, useEffect, useId, useState } from 'react'

interface FieldProps {
  name: string
  label: string
  value: string
  placeholder?: string
  mono?: boolean
  readOnly: boolean
  list?: string
  commit: (value: string) => Promise<boolean>
  focused?: () => void
}

// A field that is committed by Enter or by leaving it. Escape puts the value back.
export function TextField({ name, label, value, placeholder, mono, readOnly, list, commit, focused }: FieldProps): ReactNode {
  const id = useId()
  const [text, setText] = useState(value)
  const [refused, setRefused] = useState<string | null>(null)
  useEffect(() => setText(value), [value])
  const send = async (): Promise<void> => {
    const next = text.trim()
    if (next === value) return setText(value)
    // Leaving the field does not ask once more.
    if (next !== refused) setRefused((await commit(next)) ? null : next)
  }
  const submit = (event: FormEvent): void => {
    event.preventDefault()
    void send()
  }
  return (
    <form className="field" onSubmit={submit}>
      <label htmlFor={id}>{label}</label>
      <input
        id={id}
        name={name}
        className={mono ? 'mono' : undefined}
        value={text}
        placeholder={placeholder}
        readOnly={readOnly}
        list={list}
        aria-invalid={refused !== null && text.trim() === refused}
        spellCheck={false}
        autoComplete="off"
        onFocus={focused}
        onChange={(event) => setText(event.target.value)}
        onBlur={() => void send()}
        onKeyDown={(event) => {
          if (event.key !== 'Escape') return
          setText(value)
          event.currentTarget.closest<HTMLElement>('.editor')?.querySelector<HTMLElement>('.canvas')?.focus()
        }}
      />
    </form>
  )
}

export function Switch({ label, on, disabled, flip }: { label: string; on: boolean; disabled: boolean; flip: () => void }): ReactNode {
  return (
    <button type="button" role="switch" aria-checked={on} className="switch" disabled={disabled} onClick={flip}>
      <span>{label}</span>
      <span className="track" aria-hidden="true">
        <span className="thumb" />
      </span>
    </button>
  )
}
