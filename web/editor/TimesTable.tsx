// The times of a system: of each task its load, blocking and response, and how old data can get.
//
// In: what `groundstate chart times` tells. Out: tables. It decides nothing: whether a deadline is met is the analysis' own word.

import type { ReactNode } from 'react'

import { words } from '../words'
import type { SystemTimes, TaskTimes } from './jobs'

// Milliseconds as a chart writes them, as exactly as they are.
const shown = (ns: number | null): string => (ns === null ? '' : `${ns / 1e6} ms`)
const span = ([least, most]: [number, number]): string => (least === most ? shown(least) : `${least / 1e6}..${shown(most)}`)

export function TimesTables({ all }: { all: SystemTimes[] }): ReactNode {
  return all.map((times) => (
    <section key={times.system} className="times" aria-label={words.times.table(times.system)}>
      <p className="faint-note">
        {times.system}: {words.times.processors(times.processors, times.load)}
      </p>
      <table>
        <thead>
          <tr>
            {[words.times.task, words.times.priority, words.times.period, words.times.execution, words.times.load].map((word) => (
              <th key={word} scope="col">
                {word}
              </th>
            ))}
            {[words.times.blocking, words.times.response, words.times.deadline, words.times.verdict].map((word) => (
              <th key={word} scope="col">
                {word}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {times.tasks.map((task) => (
            <TaskRow key={task.name} task={task} />
          ))}
        </tbody>
      </table>
      {times.ages.length > 0 && <Bounds caption={words.times.ages} heads={[words.times.from, words.times.to]} all={times.ages.map((age) => ({ ...age, names: [age.from, age.to] }))} />}
      {times.fresh.length > 0 && <Bounds caption={words.times.fresh} heads={[words.times.reader, words.times.channel]} all={times.fresh.map((one) => ({ ...one, names: [one.reader, one.channel] }))} />}
    </section>
  ))
}

function TaskRow({ task }: { task: TaskTimes }): ReactNode {
  const { missed } = task
  const bad = missed === null ? task.verdict === 'misses' : missed.within === false
  const tone = task.verdict === 'meets' || missed?.within === true ? 'good' : bad ? 'bad' : 'unknown'
  return (
    <tr>
      <th scope="row">{task.name}</th>
      <td>{task.priority}</td>
      <td>{task.period_ns === null ? words.times.notPeriodic : shown(task.period_ns)}</td>
      <td>{span(task.execution_ns)}</td>
      <td>{task.load?.toFixed(2) ?? ''}</td>
      <td>{shown(task.blocking_ns)}</td>
      <td>{shown(task.response_ns)}</td>
      <td>{shown(task.deadline_ns)}</td>
      <td>
        {task.verdict !== null && <span className={`outcome ${tone}`}>{words.times.verdicts[task.verdict] ?? task.verdict}</span>}{' '}
        <span className="faint">
          {task.reason} {missed && words.times.mayMiss(missed.most, missed.allowed, missed.cycles)}
        </span>
      </td>
    </tr>
  )
}

function Kept({ within, reason }: { within: boolean | null; reason: string | null }): ReactNode {
  return (
    <td>
      <span className={`outcome ${within === true ? 'good' : 'unknown'}`}>{within === true ? words.times.within : words.times.notShown}</span>{' '}
      <span className="faint">{reason}</span>
    </td>
  )
}

interface Bounded {
  names: [string, string]
  most_ns: number | null
  limit_ns: number | null
  within: boolean | null
  reason: string | null
}

// What is bounded, with the longest time that it can take; its two names have the first two heads.
function Bounds({ caption, heads, all }: { caption: string; heads: [string, string]; all: Bounded[] }): ReactNode {
  return (
    <table>
      <caption>{caption}</caption>
      <thead>
        <tr>
          {[...heads, words.times.most, words.times.bound, words.times.kept].map((word) => (
            <th key={word} scope="col">
              {word}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {all.map(({ names, most_ns, limit_ns, within, reason }) => (
          <tr key={names.join(' ')}>
            <th scope="row">{names[0]}</th>
            <td>{names[1]}</td>
            <td>{shown(most_ns)}</td>
            <td>{shown(limit_ns)}</td>
            <Kept within={within} reason={reason} />
          </tr>
        ))}
      </tbody>
    </table>
  )
}
