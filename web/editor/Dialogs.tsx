// The dialogs, each with the frame of its own file or of this one: new drawing, rename, keys, what is to be decided.

import { type FormEvent, type ReactNode, useState } from 'react'

import type { File } from '../diagram/protocol'
import { status } from '../diagram/sync'
import { words } from '../words'
import { DeleteFile, RenameFile } from './FileDialogs'
import { Buttons, Frame } from './Frame'
import { MachineDialog } from './MachineDialogs'
import { NAME, NewProject } from './NewProject'
import { Icon } from './icons'
import { type OfChart, buildFirst, lastName } from './ofChart'
import { type Command, Search } from './Search'
import { useStore } from './store'
import type { Studio } from './studio'

export function Dialogs({ studio, commands }: { studio: Studio; commands: Command[] }): ReactNode {
  const dialog = useStore(studio.store, (state) => state.dialog)
  const close = (): void => studio.store.set({ dialog: null })
  if (!dialog) return null
  switch (dialog.kind) {
    case 'search':
      return (
        <Frame label={words.search.label} close={close} wide>
          <Search studio={studio} commands={commands} close={close} />
        </Frame>
      )
    case 'new':
      return <NewProject studio={studio} close={close} />
    case 'machine':
      return <NewMachine studio={studio} uri={dialog.uri} close={close} />
    case 'renameMachine':
    case 'deleteMachine':
      return <MachineDialog studio={studio} uri={dialog.uri} name={dialog.name} deletes={dialog.kind === 'deleteMachine'} close={close} />
    case 'rename':
      return <Rename studio={studio} dialog={dialog} close={close} />
    case 'renameFile':
      return <RenameFile studio={studio} file={dialog.file} close={close} />
    case 'deleteFile':
      return <DeleteFile studio={studio} file={dialog.file} close={close} />
    case 'older':
      return <Older studio={studio} asked={dialog.asked} model={dialog.model} state={dialog.state} close={close} />
    case 'closing':
      return <Closing studio={studio} uri={dialog.uri} close={close} />
    case 'keys':
      return <Keys close={close} />
  }
}

function NewMachine({ studio, uri, close }: { studio: Studio; uri: string; close: () => void }): ReactNode {
  const [name, setName] = useState('')
  const [title, setTitle] = useState('')
  const [pattern, setPattern] = useState(false)
  const good = NAME.test(name)
  const submit = (event: FormEvent): void => {
    event.preventDefault()
    if (!good) return
    close()
    void studio.chart(uri)?.operate({ kind: 'machine', name, pattern, title })
  }
  const choice = (value: boolean, label: string, hint: string): ReactNode => (
    <label className={`card${value === pattern ? ' on' : ''}`}>
      <input type="radio" name="kind" checked={value === pattern} onChange={() => setPattern(value)} />
      <b>{label}</b>
      <span>{hint}</span>
    </label>
  )
  return (
    <Frame label={words.dialogs.machineTitle} close={close}>
      <form className="dialog" onSubmit={submit}>
        <h2>{words.dialogs.machineTitle}</h2>
        <div className="cards" role="radiogroup" aria-label={words.dialogs.machineKind}>
          {choice(false, words.dialogs.machine, words.dialogs.machineHint)}
          {choice(true, words.dialogs.pattern, words.dialogs.patternHint)}
        </div>
        <label className="field">
          <span>{words.dialogs.machineName}</span>
          <input autoFocus className="mono" value={name} placeholder={words.dialogs.newNameHint} onChange={(event) => setName(event.target.value)} />
        </label>
        <label className="field">
          <span>{words.dialogs.machineText}</span>
          <input value={title} onChange={(event) => setTitle(event.target.value)} />
        </label>
        {name !== '' && !good && <p className="note bad">{words.dialogs.badName}</p>}
        <Buttons act={words.dialogs.create} enabled={good} close={close} />
      </form>
    </Frame>
  )
}

// The model of a chart is not the one that it would be built to: which one is meant?
function Older({ studio, asked, model, state, close }: { studio: Studio; asked: OfChart; model: File; state: 'differs' | 'faulty' | 'unknown'; close: () => void }): ReactNode {
  const [build, takeOld] = words.older.acts[asked.what]
  const title = words.older.differs(lastName(asked.chart.path), lastName(model.path))
  const done = (act: () => void) => () => {
    close()
    act()
  }
  const old = done(() => asked.act(model, true))
  return (
    <Frame label={title} close={close}>
      <div className="dialog">
        <h2>{title}</h2>
        <p className="hint">{words.older.hints[state]}</p>
        <footer className="row wrap">
          <span className="grow" />
          <button onClick={close}>{words.dialogs.cancel}</button>
          <button onClick={old}>{takeOld}</button>
          {state === 'faulty' ? (
            <button className="primary" autoFocus onClick={done(() => studio.store.set({ panel: 'problems' }))}>
              {words.older.faults}
            </button>
          ) : (
            !studio.hello.readOnly && (
              <button className="primary" autoFocus onClick={done(() => void buildFirst(studio, asked))}>
                {build}
              </button>
            )
          )}
        </footer>
      </div>
    </Frame>
  )
}

// A text that is in no file is to be closed.
function Closing({ studio, uri, close }: { studio: Studio; uri: string; close: () => void }): ReactNode {
  const doc = studio.doc(uri)
  if (!doc) return null
  const title = words.kept.closing(lastName(doc.file.path))
  return (
    <Frame label={title} close={close}>
      <div className="dialog">
        <h2>{title}</h2>
        <p className="hint">{words.kept.closingHint[status(doc.store.get().sync)]}</p>
        <footer className="row wrap">
          <span className="grow" />
          <button
            onClick={() => {
              close()
              studio.discard(uri)
            }}
          >
            {words.kept.discardText}
          </button>
          <button className="primary" autoFocus onClick={close}>
            {words.kept.keep}
          </button>
        </footer>
      </div>
    </Frame>
  )
}

interface RenameDialog {
  old: string
  uri: string
  at: { line: number; character: number }
}

function Rename({ studio, dialog, close }: { studio: Studio; dialog: RenameDialog; close: () => void }): ReactNode {
  const [name, setName] = useState(dialog.old)
  const submit = (event: FormEvent): void => {
    event.preventDefault()
    void studio.rename(dialog.uri, dialog.at, name.trim()).then((done) => done && close())
  }
  return (
    <Frame label={words.rename.title(dialog.old)} close={close}>
      <form className="dialog" onSubmit={submit}>
        <h2>{words.rename.title(dialog.old)}</h2>
        <p className="hint">{words.rename.hint}</p>
        <label className="field">
          <span>{words.dialogs.newName}</span>
          <input autoFocus className="mono" value={name} onFocus={(event) => event.target.select()} onChange={(event) => setName(event.target.value)} />
        </label>
        <Buttons act={words.rename.rename} enabled={name.trim() !== '' && name.trim() !== dialog.old} close={close} />
      </form>
    </Frame>
  )
}

function Keys({ close }: { close: () => void }): ReactNode {
  return (
    <Frame label={words.dialogs.keysTitle} close={close} wide>
      <div className="dialog">
        <header className="row">
          <h2>{words.dialogs.keysTitle}</h2>
          <span className="grow" />
          <button className="quiet" aria-label={words.shell.dismiss} onClick={close}>
            <Icon name="close" />
          </button>
        </header>
        <div className="key-columns">
          {words.keys.map(([where, keys]) => (
            <section key={where}>
              <h3>{where}</h3>
              <dl>
                {keys.map(([key, meaning]) => (
                  <div key={key}>
                    <dt>
                      <kbd>{key}</kbd>
                    </dt>
                    <dd>{meaning}</dd>
                  </div>
                ))}
              </dl>
            </section>
          ))}
        </div>
      </div>
    </Frame>
  )
}
