// The dialogs in which a machine of a chart gets another name, or goes: with what names it, so that nothing breaks in silence.

import { type FormEvent, type ReactNode, useEffect, useState } from 'react'

import { nameFault } from '../diagram/machines'
import type { Drawing, MachineNames } from '../diagram/protocol'
import { words } from '../words'
import { Places } from './FileDialogs'
import { Buttons, Frame } from './Frame'
import type { Chart } from './chart'
import { deleteMachine, namesOf, renameMachine } from './machines'
import type { Studio } from './studio'

interface Props {
  studio: Studio
  chart: Chart
  drawing: Drawing
  close: () => void
}

// What is asked about the machines of the chart in front; nothing if it has gone meanwhile.
export function MachineDialog({ studio, uri, name, deletes, close }: { studio: Studio; uri: string; name: string; deletes: boolean; close: () => void }): ReactNode {
  const chart = studio.chart(uri)
  const [drawing] = useState(() => chart?.store.get().pictures?.drawings.find((drawing) => drawing.name === name))
  if (!chart || !drawing) return null
  return deletes ? <DeleteMachine studio={studio} chart={chart} drawing={drawing} close={close} /> : <RenameMachine studio={studio} chart={chart} drawing={drawing} close={close} />
}

function useNames({ studio, chart, drawing, close }: Props): MachineNames | null {
  const [names, setNames] = useState<MachineNames | null>(null)
  useEffect(() => {
    let asked = true
    namesOf(studio, chart, drawing.name).then(
      (found) => asked && setNames(found),
      (error: Error) => {
        if (!asked) return
        close()
        studio.tell(error.message, 'refused')
      },
    )
    return () => void (asked = false)
    // One machine is one question.
  }, [studio, chart, drawing.name])
  return names
}

function RenameMachine(props: Props): ReactNode {
  const { studio, chart, drawing, close } = props
  const [name, setName] = useState(drawing.name)
  const [title, setTitle] = useState(drawing.title)
  const names = useNames(props)
  const fault = names && name !== drawing.name ? nameFault(names, name) : null
  const heading = words.machines.renameTitle(drawing.title || drawing.name)
  const isOther = name !== drawing.name || title !== drawing.title
  const good = names !== null && fault === null && isOther
  const submit = (event: FormEvent): void => {
    event.preventDefault()
    if (good) void renameMachine(studio, chart, drawing.name, name, title === drawing.title ? null : title).then((done) => done && close())
  }
  return (
    <Frame label={heading} close={close}>
      <form className="dialog" onSubmit={submit}>
        <h2>{heading}</h2>
        <p className="hint">{words.machines.renameHint}</p>
        <label className="field">
          <span>{words.dialogs.machineName}</span>
          <input autoFocus className="mono" value={name} aria-invalid={fault !== null} onFocus={(event) => event.target.select()} onChange={(event) => setName(event.target.value.trim())} />
        </label>
        <label className="field">
          <span>{words.dialogs.machineText}</span>
          <input value={title} onChange={(event) => setTitle(event.target.value)} />
        </label>
        {fault !== null && name !== '' && (
          <p className="note bad" role="alert">
            {words.machines.faults[fault]}
          </p>
        )}
        {names && name !== drawing.name && fault === null && <Places title={words.machines.follow} places={names.places.filter(({ isOwn }) => !isOwn)} />}
        <Buttons act={words.rename.rename} enabled={good} close={close} />
      </form>
    </Frame>
  )
}

function DeleteMachine(props: Props): ReactNode {
  const { studio, chart, drawing, close } = props
  const names = useNames(props)
  const title = words.machines.deleteTitle(drawing.title || drawing.name)
  return (
    <Frame label={title} close={close}>
      <form
        className="dialog"
        onSubmit={(event) => {
          event.preventDefault()
          close()
          void deleteMachine(studio, chart, drawing.name)
        }}
      >
        <h2>{title}</h2>
        <p className="hint">{words.machines.deleteHint}</p>
        <Places title={words.machines.missed} places={(names?.places ?? []).filter(({ isOwn }) => !isOwn)} />
        <footer className="row">
          <span className="grow" />
          <button type="button" autoFocus onClick={close}>
            {words.dialogs.cancel}
          </button>
          <button type="submit" className="danger" disabled={names === null}>
            {words.machines.deleteButton}
          </button>
        </footer>
      </form>
    </Frame>
  )
}
