// The dialog that begins something: a folder from a template, or an empty chart in a folder that is there.

import { type FormEvent, type ReactNode, useState } from 'react'

import { emptyChart, folderOf, foldersOf } from '../diagram/names'
import { words } from '../words'
import { Buttons, Frame } from './Frame'
import { useStore } from './store'
import type { Studio } from './studio'

export const NAME = /^[A-Za-z]\w*$/

// No template has this name.
const CHART = ''

export function NewProject({ studio, close }: { studio: Studio; close: () => void }): ReactNode {
  const templates = useStore(studio.store, (state) => state.hello?.templates) ?? []
  const files = useStore(studio.store, (state) => state.files)
  const front = studio.doc(studio.store.get().active)
  const [template, setTemplate] = useState(templates[0]?.name ?? CHART)
  const [folder, setFolder] = useState(front && !studio.isLibrary(front.file.uri) ? folderOf(front.file.path) : '')
  const [name, setName] = useState('')
  const good = NAME.test(name)
  const submit = (event: FormEvent): void => {
    event.preventDefault()
    if (!good) return
    const made = template === CHART ? studio.write(`${folder}${name}.chart`, emptyChart(name)) : studio.create(template, name)
    void made.then((done) => done && close())
  }
  const card = (value: string, title: string, hint: string): ReactNode => (
    <label key={value} className={`card${value === template ? ' on' : ''}`}>
      <input type="radio" name="template" checked={value === template} onChange={() => setTemplate(value)} />
      <b>{title}</b>
      <span>{hint}</span>
    </label>
  )
  return (
    <Frame label={words.dialogs.newTitle} close={close}>
      <form className="dialog" onSubmit={submit}>
        <h2>{words.dialogs.newTitle}</h2>
        <div className="cards" role="radiogroup" aria-label={words.dialogs.newTitle}>
          {templates.map((known) => card(known.name, known.name, known.title))}
          {card(CHART, words.files.emptyChart, words.files.emptyChartHint)}
        </div>
        <label className="field">
          <span>{words.dialogs.newName}</span>
          <input autoFocus className="mono" value={name} placeholder={words.dialogs.newNameHint} onChange={(event) => setName(event.target.value)} />
        </label>
        {template === CHART && (
          <label className="field">
            <span>{words.files.folder}</span>
            <select value={folder} onChange={(event) => setFolder(event.target.value)}>
              {foldersOf(files).map((path) => (
                <option key={path} value={path}>
                  {path === '' ? words.files.top(studio.hello.name) : path.slice(0, -1)}
                </option>
              ))}
            </select>
          </label>
        )}
        {name !== '' && !good && <p className="note bad">{words.dialogs.badName}</p>}
        <Buttons act={words.dialogs.create} enabled={good} close={close} />
      </form>
    </Frame>
  )
}
