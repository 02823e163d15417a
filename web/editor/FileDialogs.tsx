// The dialogs in which a file gets another name, or goes: with what names it, so that nothing breaks in silence.

import { type FormEvent, type ReactNode, useEffect, useState } from 'react'

import { companions, endingOf, isFileName, linesOf, stemOf } from '../diagram/names'
import type { File, Named, Names } from '../diagram/protocol'
import { words } from '../words'
import { Buttons, Frame } from './Frame'
import { lastName } from './ofChart'
import type { Studio } from './studio'

interface Props {
  studio: Studio
  file: File
  close: () => void
}

function useNames(studio: Studio, files: readonly File[]): Names[] | null {
  const [names, setNames] = useState<Names[] | null>(null)
  const key = files.map(({ path }) => path).join('\n')
  useEffect(() => {
    let asked = true
    studio.files.names(files).then(
      (found) => asked && setNames(found),
      (error: Error) => studio.tell(error.message, 'refused'),
    )
    return () => void (asked = false)
    // The same files are the same question.
  }, [studio, key])
  return names
}

// Places by file, without those in the files themselves.
export function Places({ title, places }: { title: string; places: readonly Pick<Named, 'path' | 'range'>[] }): ReactNode {
  if (places.length === 0) return null
  return (
    <section className="named">
      <h3>{title}</h3>
      <ul>
        {linesOf(places).map(({ path, lines }) => (
          <li key={path}>
            <span className="mono">{path}</span> <span className="faint">{words.files.lines(lines)}</span>
          </li>
        ))}
      </ul>
    </section>
  )
}

function Program({ names }: { names: readonly Names[] }): ReactNode {
  const program = names.find(({ program }) => program)?.program
  return program ? <p className="note">{program.isOwn ? words.files.ownProgram(program.path) : words.files.program(program.path)}</p> : null
}

export function RenameFile({ studio, file, close }: Props): ReactNode {
  const [stem, setStem] = useState(stemOf(file.path))
  const [along, setAlong] = useState(true)
  const belongs = companions(studio.store.get().files, file)
  const all = along ? [file, ...belongs] : [file]
  const names = useNames(studio, all)
  const good = isFileName(file, stem)
  const title = words.files.renameTitle(lastName(file.path))
  const submit = (event: FormEvent): void => {
    event.preventDefault()
    if (good) void studio.files.rename(all, stem).then((done) => done && close())
  }
  const own = new Set(all.map(({ path }) => path))
  const places = (names ?? []).flatMap((one) => one.places)
  return (
    <Frame label={title} close={close}>
      <form className="dialog" onSubmit={submit}>
        <h2>{title}</h2>
        <label className="field">
          <span>{words.dialogs.newName}</span>
          <span className="row with-ending">
            <input autoFocus className="mono" value={stem} onFocus={(event) => event.target.select()} onChange={(event) => setStem(event.target.value)} />
            <span className="mono faint">{endingOf(file.path)}</span>
          </span>
        </label>
        {!good && stem !== '' && <p className="note bad">{file.kind === 'model' || file.kind === 'chart' ? words.dialogs.badName : words.files.badName}</p>}
        {belongs.length > 0 && (
          <label className="row choice">
            <input type="checkbox" checked={along} onChange={(event) => setAlong(event.target.checked)} />
            <span>{words.files.along(belongs.map(({ path }) => lastName(path)))}</span>
          </label>
        )}
        {names && (
          <>
            <Places title={words.files.follow} places={places.filter(({ follows, path }) => follows && !own.has(path))} />
            <Places title={words.files.stay} places={places.filter(({ follows }) => !follows)} />
            <Program names={names} />
          </>
        )}
        <Buttons act={words.rename.rename} enabled={good && names !== null && stem !== stemOf(file.path)} close={close} />
      </form>
    </Frame>
  )
}

export function DeleteFile({ studio, file, close }: Props): ReactNode {
  const names = useNames(studio, [file])
  const title = words.files.deleteTitle(lastName(file.path))
  const places = (names?.[0]?.places ?? []).filter(({ path }) => path !== file.path)
  return (
    <Frame label={title} close={close}>
      <form
        className="dialog"
        onSubmit={(event) => {
          event.preventDefault()
          close()
          void studio.files.remove(file)
        }}
      >
        <h2>{title}</h2>
        <p className="hint">{words.files.deleteHint}</p>
        <Places title={words.files.missed} places={places} />
        <footer className="row">
          <span className="grow" />
          <button type="button" autoFocus onClick={close}>
            {words.dialogs.cancel}
          </button>
          <button type="submit" className="danger" disabled={names === null}>
            {words.files.delete}
          </button>
        </footer>
      </form>
    </Frame>
  )
}
