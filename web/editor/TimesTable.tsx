// The times of a system: of each task its load, blocking and response, and how old data can get.
//
// In: what `groundstate chart times` tells. Out: tables. It decides nothing: whether a deadline is met is the analysis' own word.

import type { ReactNode } from 'react'

import { words } from '../words'
import type { AgeTimes, FreshTimes, SystemTimes, TaskTimes } from './jobs'

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
      {times.ages.length > 0 && <Ages ages={times.ages} />}
      {times.fresh.length > 0 && <Fresh all={times.fresh} />}
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

function Fresh({ all }: { all: FreshTimes[] }): ReactNode {
  return (
    <table>
      <caption>{words.times.fresh}</caption>
      <thead>
        <tr>
          {[words.times.reader, words.times.channel, words.times.most, words.times.bound, words.times.kept].map((word) => (
            <th key={word} scope="col">
              {word}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {all.map((one) => (
          <tr key={`${one.reader} ${one.channel}`}>
            <th scope="row">{one.reader}</th>
            <td>{one.channel}</td>
            <td>{shown(one.most_ns)}</td>
            <td>{shown(one.limit_ns)}</td>
            <Kept within={one.within} reason={one.reason} />
          </tr>
        ))}
      </tbody>
    </table>
  )
}

function Ages({ ages }: { ages: AgeTimes[] }): ReactNode {
  return (
    <table>
      <caption>{words.times.ages}</caption>
      <thead>
        <tr>
          {[words.times.from, words.times.to, words.times.most, words.times.bound, words.times.kept].map((word) => (
            <th key={word} scope="col">
              {word}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {ages.map((age) => (
          <tr key={`${age.from} ${age.to}`}>
            <th scope="row">{age.from}</th>
            <td>{age.to}</td>
            <td>{shown(age.most_ns)}</td>
            <td>{shown(age.limit_ns)}</td>
            <Kept within={age.within} reason={age.reason} />
          </tr>
        ))}
      </tbody>
    </table>
  )
}
