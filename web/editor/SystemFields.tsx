// The properties of a system's parts: periods and deadlines, phases with their times, what channels are made of.
//
// In: what the text says of a part, with the place of each property. Out: operations. A fault of the text, or a refusal, is told at the
// field that it is about.

import { type FormEvent, type ReactNode, useId, useState } from 'react'

import { faultsAt } from '../diagram/pick'
import type { ChannelText, ComponentText, DeviceText, Operation, Property, PropertyName, Range, SystemText } from '../diagram/protocol'
import { words } from '../words'
import type { Chart } from './chart'
import { TextField } from './Field'
import { Icon } from './icons'
import { type Acting, Told, useOperation } from './operating'
import { useStore } from './store'
import type { Studio } from './studio'

interface Context {
  studio: Studio
  chart: Chart
  id: string
}

// What the text's faults say of a place.
export function useFaults(studio: Studio, chart: Chart): (range: Range | null | undefined) => string | null {
  const faults = useStore(studio.store, (state) => state.faults.get(chart.doc.file.uri))
  return (range) => (range && faults ? (faultsAt(faults, range)[0]?.message ?? null) : null)
}

interface PropertyFieldProps extends Context {
  acting: Acting
  property: PropertyName
  at?: number
  label: string
  value: Property
  placeholder?: string
  list?: string[]
}

export function PropertyField({ studio, chart, id, acting, property, at, label, value, placeholder, list }: PropertyFieldProps): ReactNode {
  const fault = useFaults(studio, chart)
  const offers = useId()
  const key = `${property} ${at ?? ''}`
  return (
    <div className="property">
      <TextField
        name={at === undefined ? property : `${property}-${at}`}
        label={label}
        value={value?.text ?? ''}
        placeholder={placeholder}
        mono
        readOnly={chart.doc.readOnly}
        list={list ? offers : undefined}
        commit={(text) => acting.act(key, { kind: 'set', id, property, ...(at === undefined ? {} : { at }), value: text === '' ? null : text })}
      />
      {list && (
        <datalist id={offers}>
          {list.map((offer) => (
            <option key={offer} value={offer} />
          ))}
        </datalist>
      )}
      <Told reason={acting.refused.get(key) ?? fault(value?.range)} />
    </div>
  )
}

export function SystemFields({ studio, chart, id, system }: Context & { system: SystemText }): ReactNode {
  const part = system.parts[id]
  const acting = useOperation({ chart })
  if (!part) return null
  const all = { studio, chart, id, acting }
  switch (part.part) {
    case 'component':
      return <ComponentFields {...all} part={part} system={system} />
    case 'channel':
      return <ChannelFields {...all} part={part} system={system} />
    case 'device':
      return <DomainField {...all} part={part} />
  }
}

const DomainField = (all: Context & { acting: Acting; part: ChannelText | DeviceText }): ReactNode => (
  <PropertyField {...all} property="domain" label={words.system.domain} value={all.part.domain} placeholder={words.system.domainHint} list={['Boolean', 'Integer', 'Real']} />
)

function Choice<Value extends string>({ label, value, values, disabled, pick }: { label: string; value: Value | null; values: [Value, string][]; disabled: boolean; pick: (value: Value) => void }): ReactNode {
  const id = useId()
  return (
    <div className="field">
      <label htmlFor={id}>{label}</label>
      <select id={id} value={value ?? ''} disabled={disabled} onChange={(event) => pick(event.target.value as Value)}>
        {value === null && <option value="" />}
        {values.map(([one, shown]) => (
          <option key={one} value={one}>
            {shown}
          </option>
        ))}
      </select>
    </div>
  )
}

function ComponentFields({ part, system, ...all }: Context & { acting: Acting; part: ComponentText; system: SystemText }): ReactNode {
  const { id, acting, chart } = all
  const channels = Object.entries(system.parts).filter(([, other]) => other.part === 'channel')
  const read = channels.filter(([, other]) => other.part === 'channel' && other.readers.includes(id)).map(([name]) => name)
  const names = read.join(', ')
  const awaited = read.length > 1 ? [...read, `all ${names}`, `any ${names}`] : read
  const timing = part.synchronous === null ? null : part.synchronous ? ('synchronous' as const) : ('asynchronous' as const)
  return (
    <>
      <Choice
        label={words.system.timing}
        value={timing}
        values={[
          ['synchronous', words.system.synchronous],
          ['asynchronous', words.system.asynchronous],
        ]}
        disabled={chart.doc.readOnly}
        pick={(value) => void acting.act('timing', { kind: 'set', id, property: 'timing', value })}
      />
      <Told reason={acting.refused.get('timing') ?? null} />
      {part.synchronous === true && (
        <div className="three">
          <PropertyField {...all} property="period" label={words.system.period} value={part.period} />
          <PropertyField {...all} property="jitter" label={words.system.jitter} value={part.jitter} placeholder="0 ms" />
          <PropertyField {...all} property="offset" label={words.system.offset} value={part.offset} placeholder="0 ms" />
          <PropertyField {...all} property="deadline" label={words.system.deadline} value={part.deadline} placeholder={part.period?.text ?? ''} />
        </div>
      )}
      {part.synchronous === true && <PropertyField {...all} property="misses" label={words.system.misses} value={part.misses} placeholder={words.system.missesNone} />}
      {part.synchronous === false && <PropertyField {...all} property="awaits" label={words.system.awaits} value={part.awaits} placeholder={words.system.awaitsNone} list={awaited} />}
      <Phases {...all} part={part} channels={channels.map(([name, other]) => ({ name, other: other as ChannelText }))} />
    </>
  )
}

function Phases({ part, channels, ...all }: Context & { acting: Acting; part: ComponentText; channels: { name: string; other: ChannelText }[] }): ReactNode {
  const { studio, chart, id, acting } = all
  const fault = useFaults(studio, chart)
  const { readOnly } = chart.doc
  const button = (icon: string, title: string, operation: Operation, enabled: boolean): ReactNode => (
    <button type="button" className="quiet tiny" title={title} aria-label={title} disabled={!enabled} onClick={() => void acting.act('phases', operation)}>
      <Icon name={icon} size={12} />
    </button>
  )
  return (
    <section className="phases" aria-label={words.inspector.details}>
      <span className="key">{words.inspector.details}</span>
      <ol>
        {part.phases.map((phase, at) => {
          const name = `${words.system.verbs[phase.verb ?? 'elaborate']} ${phase.subject ?? ''}`
          const told = [phase.time, phase.name, phase.machine, phase.fresh].some((property) => property && fault(property.range))
          return (
            <li key={`${at} ${name}`}>
              <div className="phase-head">
                {phase.verb !== 'elaborate' && phase.subject !== null && !readOnly ? (
                  <span className="phase-name">
                    {words.system.verbs[phase.verb ?? 'read']}{' '}
                    <select
                      className="mono"
                      aria-label={words.system.about(name)}
                      value={phase.subject}
                      onChange={(event) => void acting.act('phases', { kind: 'set', id, property: 'phaseSubject', at, value: event.target.value })}
                    >
                      {[...new Set([phase.subject, ...channels.filter(({ other }) => (phase.verb === 'write' ? other.from === id : other.from !== id)).map(({ name }) => name)])].map((channel) => (
                        <option key={channel}>{channel}</option>
                      ))}
                    </select>
                  </span>
                ) : (
                  <span className="phase-name">{name}</span>
                )}
                {!readOnly && (
                  <>
                    {button('up', words.system.earlier(name), { kind: 'movePhase', id, at, to: at - 1 }, at > 0)}
                    {button('lower', words.system.later(name), { kind: 'movePhase', id, at, to: at + 1 }, at < part.phases.length - 1)}
                    {button('trash', words.system.removePhase(name), { kind: 'removePhase', id, at }, true)}
                  </>
                )}
              </div>
              <div className="two">
                <PropertyField {...all} property="phaseTime" at={at} label={words.system.time} value={phase.time} placeholder={words.system.timeNone} />
                {phase.verb === 'elaborate' ? (
                  <PropertyField {...all} property="phaseMachine" at={at} label={words.system.machine} value={phase.machine} placeholder={words.system.machineNone} />
                ) : (
                  <PropertyField {...all} property="phaseName" at={at} label={words.system.phaseName} value={phase.name} placeholder={words.system.phaseNameNone} />
                )}
              </div>
              {phase.verb === 'read' && <PropertyField {...all} property="phaseFresh" at={at} label={words.system.fresh} value={phase.fresh} placeholder={words.system.freshNone} />}
              {!told && <Told reason={fault(phase.range)} />}
            </li>
          )
        })}
      </ol>
      <Told reason={acting.refused.get('phases') ?? null} />
      {!readOnly && <NewPhase id={id} acting={acting} channels={channels} />}
    </section>
  )
}

function NewPhase({ id, acting, channels }: { id: string; acting: Acting; channels: { name: string; other: ChannelText }[] }): ReactNode {
  const [verb, setVerb] = useState<'read' | 'elaborate' | 'write'>('elaborate')
  const [subject, setSubject] = useState('')
  const fitting = channels.filter(({ other }) => (verb === 'read' ? other.readers.includes(id) : other.from === id)).map(({ name }) => name)
  const wanted = verb === 'elaborate' ? subject.trim() : fitting.includes(subject) ? subject : (fitting[0] ?? '')
  const add = (event: FormEvent): void => {
    event.preventDefault()
    if (wanted !== '') void acting.act('phases', { kind: 'addPhase', id, verb, subject: wanted }).then((done) => done && setSubject(''))
  }
  return (
    <form className="new-phase" onSubmit={add}>
      <select aria-label={words.system.newPhase} value={verb} onChange={(event) => setVerb(event.target.value as typeof verb)}>
        {(['read', 'elaborate', 'write'] as const).map((one) => (
          <option key={one} value={one}>
            {words.system.verbs[one]}
          </option>
        ))}
      </select>
      {verb === 'elaborate' ? (
        <input className="mono" aria-label={words.system.newName} placeholder={words.system.newName} value={subject} onChange={(event) => setSubject(event.target.value)} />
      ) : (
        <select aria-label={words.system.channel} value={wanted} disabled={fitting.length === 0} onChange={(event) => setSubject(event.target.value)}>
          {fitting.length === 0 && <option value="">{words.system.noChannel}</option>}
          {fitting.map((name) => (
            <option key={name}>{name}</option>
          ))}
        </select>
      )}
      <button type="submit" className="quiet" title={words.system.addPhase} aria-label={words.system.addPhase} disabled={wanted === ''}>
        <Icon name="plus" size={13} />
      </button>
    </form>
  )
}

function ChannelFields({ part, system, ...all }: Context & { acting: Acting; part: ChannelText; system: SystemText }): ReactNode {
  const { id, acting, chart } = all
  const components = Object.entries(system.parts).flatMap(([name, other]) => (other.part === 'component' ? [name] : []))
  // Each component is at one end at most.
  const free = (end: string | null): [string, string][] => components.filter((name) => name === end || (name !== part.from && !part.readers.includes(name))).map((name) => [name, name])
  const ends = [part.from, ...part.readers].filter((end) => end !== null)
  return (
    <>
      <Choice
        label={words.system.writer}
        value={part.from}
        values={free(part.from)}
        disabled={chart.doc.readOnly}
        pick={(value) => void acting.act('ends', { kind: 'set', id, property: 'writer', value })}
      />
      {part.readers.map((reader, index) => (
        <Choice
          key={reader}
          label={part.readers.length > 1 ? words.system.reader(index + 1) : words.system.readers}
          value={reader}
          values={free(reader)}
          disabled={chart.doc.readOnly}
          pick={(to) => void acting.act('ends', { kind: 'redirect', from: id, branch: null, to: reader, new: { from: id, branch: null, to } })}
        />
      ))}
      <Told reason={acting.refused.get('ends') ?? null} />
      <Choice
        label={words.system.made}
        value={part.made}
        values={[
          ['swinging buffer', words.system.buffer],
          ['queue', words.system.queue],
          ['shared value', words.system.shared],
        ]}
        disabled={chart.doc.readOnly}
        pick={(value) => void acting.act('made', { kind: 'set', id, property: 'made', value })}
      />
      <Told reason={acting.refused.get('made') ?? null} />
      <div className="two">
        {part.made !== 'shared value' && <PropertyField {...all} property="size" label={part.made === 'queue' ? words.system.messages : words.system.arrays} value={part.size} />}
        {part.made === 'swinging buffer' && <PropertyField {...all} property="master" label={words.system.master} value={part.master} placeholder={words.system.masterNone} list={ends} />}
      </div>
      <DomainField {...all} part={part} />
    </>
  )
}

// A number of the system itself, beside its table of times.
export function SystemNumbers({ studio, chart, id, system }: Context & { system: SystemText }): ReactNode {
  const acting = useOperation({ chart })
  const all = { studio, chart, id, acting }
  return (
    <div className="system-numbers">
      <PropertyField {...all} property="tick" label={words.system.tick} value={system.tick} placeholder="1 ms" />
      <PropertyField {...all} property="processors" label={words.system.processors} value={system.processors} placeholder="1" />
      {system.ages.map((age, at) => (
        <PropertyField key={at} {...all} property="age" at={at} label={words.system.age(age.from ?? '', age.to ?? '')} value={age.limit} />
      ))}
      {!chart.doc.readOnly && <NewAge acting={acting} system={system} />}
    </div>
  )
}

function NewAge({ acting, system }: { acting: Acting; system: SystemText }): ReactNode {
  const [from, setFrom] = useState('')
  const [to, setTo] = useState('')
  const [limit, setLimit] = useState('')
  const ends = Object.entries(system.parts)
    .filter(([, part]) => part.part !== 'channel')
    .map(([name]) => name)
  const add = (event: FormEvent): void => {
    event.preventDefault()
    const operation: Operation = { kind: 'addAge', from, to, limit: limit.trim() }
    void acting.act('addAge', operation).then((done) => done && [setFrom, setTo, setLimit].forEach((set) => set('')))
  }
  const end = (label: string, value: string, set: (value: string) => void): ReactNode => (
    <select aria-label={label} value={value} onChange={(event) => set(event.target.value)}>
      <option value="">{label}</option>
      {ends.map((name) => (
        <option key={name}>{name}</option>
      ))}
    </select>
  )
  return (
    <form className="new-age" onSubmit={add} aria-label={words.system.newAge}>
      <span className="key">{words.system.newAge}</span>
      <div className="row">
        {end(words.times.from, from, setFrom)}
        {end(words.times.to, to, setTo)}
        <input className="mono" aria-label={words.times.bound} placeholder="50 ms" value={limit} onChange={(event) => setLimit(event.target.value)} />
        <button type="submit" className="quiet" title={words.system.addAge} aria-label={words.system.addAge} disabled={from === '' || to === '' || limit.trim() === ''}>
          <Icon name="plus" size={13} />
        </button>
      </div>
      <Told reason={acting.refused.get('addAge') ?? null} />
    </form>
  )
}
