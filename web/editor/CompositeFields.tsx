// The properties of a composite state: whether it is entered where it was left, and what is done on entering and leaving it.
//
// In: what the text says of it. Out: operations. A refusal is told at the field that it is about.

import { type FormEvent, type ReactNode, useState } from 'react'

import type { CompositeText, Doing } from '../diagram/protocol'
import { words } from '../words'
import type { Chart } from './chart'
import { Switch, TextField } from './Field'
import { Icon } from './icons'
import { type Acting, Told, useOperation } from './operating'

interface Context {
  chart: Chart
  id: string
}

export function CompositeFields({ chart, id, composite }: Context & { composite: CompositeText }): ReactNode {
  const acting = useOperation({ chart })
  const { history } = composite
  const { readOnly } = chart.doc
  return (
    <>
      <Switch
        label={words.composite.history}
        on={history !== null}
        disabled={readOnly}
        flip={() => void acting.act('history', { kind: 'history', id, history: history ? null : { link: null } })}
      />
      {history && (
        <div className="property">
          <TextField
            name="history"
            label={words.composite.remembers}
            value={history.link ?? ''}
            placeholder={words.composite.remembersNone}
            mono
            readOnly={readOnly}
            commit={(link) => acting.act('history', { kind: 'history', id, history: { link: link === '' ? null : link } })}
          />
          <Told reason={acting.refused.get('history') ?? null} />
        </div>
      )}
      <section className="phases" aria-label={words.composite.doings}>
        <span className="key">{words.composite.doings}</span>
        <ol>
          {composite.doings.map((doing) => (
            <OneDoing key={doing.id} chart={chart} acting={acting} doing={doing} />
          ))}
        </ol>
        {!readOnly && <NewDoing id={id} acting={acting} />}
        <Told reason={acting.refused.get('new') ?? null} />
      </section>
    </>
  )
}

function OneDoing({ chart, acting, doing }: { chart: Chart; acting: Acting; doing: Doing }): ReactNode {
  const { readOnly } = chart.doc
  const { id } = doing
  return (
    <li>
      <div className="phase-head">
        <span className="phase-name">
          {words.composite.when[doing.when]} {id}
        </span>
        {!readOnly && (
          <button
            type="button"
            className="quiet tiny"
            title={words.composite.remove(id)}
            aria-label={words.composite.remove(id)}
            onClick={() => void acting.act(id, { kind: 'delete', ids: [id] })}
          >
            <Icon name="trash" size={12} />
          </button>
        )}
      </div>
      <div className="two">
        <div className="property">
          <TextField
            name={`text-${id}`}
            label={words.inspector.text}
            value={doing.text}
            readOnly={readOnly}
            commit={(text) => acting.act(id, { kind: 'text', id, text: text === '' ? null : text })}
          />
        </div>
        <div className="property">
          <TextField
            name={`link-${id}`}
            label={words.inspector.link}
            value={doing.link ?? ''}
            placeholder={words.inspector.linkHint['rectangle']}
            mono
            readOnly={readOnly}
            commit={(link) => acting.act(id, { kind: 'link', id, link: link === '' ? null : link })}
          />
        </div>
      </div>
      <Told reason={acting.refused.get(id) ?? null} />
    </li>
  )
}

function NewDoing({ id, acting }: { id: string; acting: Acting }): ReactNode {
  const [when, setWhen] = useState<Doing['when']>('entry')
  const [text, setText] = useState('')
  const wanted = text.trim()
  const add = (event: FormEvent): void => {
    event.preventDefault()
    if (wanted !== '') void acting.act('new', { kind: 'addDoing', id, when, text: wanted }).then((done) => done && setText(''))
  }
  return (
    <form className="new-phase" onSubmit={add}>
      <select aria-label={words.composite.moment} value={when} onChange={(event) => setWhen(event.target.value as Doing['when'])}>
        {(['entry', 'exit'] as const).map((one) => (
          <option key={one} value={one}>
            {words.composite.when[one]}
          </option>
        ))}
      </select>
      <input aria-label={words.composite.newText} placeholder={words.composite.newHint} value={text} onChange={(event) => setText(event.target.value)} />
      <button type="submit" className="quiet" title={words.composite.add} aria-label={words.composite.add} disabled={wanted === ''}>
        <Icon name="plus" size={13} />
      </button>
    </form>
  )
}
