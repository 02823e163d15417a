// What a review, mutants and scenarios say of places in a model, each with a click to the place.
//
// In: a job's lines. Out: lists. What they mean is in `marks.ts`.

import type { ReactNode } from 'react'

import { words } from '../words'
import { goTo } from './CheckPanel'
import { Icon } from './icons'
import type { Job, LinePlace } from './jobs'
import { type Mutant, coverages, findings, mutants } from './marks'
import type { Studio } from './studio'

// The types of lines that are shown here.
export const MARKED = ['finding', 'meta-property', 'mutant', 'mutation', 'coverage']

const OUTCOMES: Record<string, [string, string]> = {
  holds: ['good', 'check'],
  violated: ['bad', 'cross'],
  unknown: ['unknown', 'question'],
}

function Place({ studio, place, children }: { studio: Studio; place: LinePlace; children: ReactNode }): ReactNode {
  return (
    <button className="link-button told-place" onClick={() => void goTo(studio, place)}>
      {children}
    </button>
  )
}

export function Marked({ studio, job }: { studio: Studio; job: Job }): ReactNode {
  const found = findings(job)
  const all = mutants(job)
  const covered = coverages(job)
  const metas = job.lines.filter((line): line is Record<string, unknown> => typeof line === 'object' && line['type'] === 'meta-property')
  return (
    <>
      {metas.length > 0 && (
        <ul className="verdicts">
          {metas.map((meta) => {
            const [tone, icon] = OUTCOMES[String(meta['outcome'])] ?? ['unknown', 'question']
            const name = String(meta['meta'])
            return (
              <li key={name} className="verdict">
                <span className={`outcome ${tone}`}>
                  <Icon name={icon} size={13} />
                  {words.marks.outcomes[String(meta['outcome'])] ?? String(meta['outcome'])}
                </span>
                {words.marks.metas[name] ?? name}
              </li>
            )
          })}
        </ul>
      )}
      {found.length > 0 && (
        <ul className="verdicts">
          {found.map(({ meta, finding }, index) => (
            <li key={index} className="verdict fault-told">
              <span className="outcome unknown">
                <Icon name="warning" size={13} />
                {meta}
              </span>
              <Place studio={studio} place={finding}>
                {finding.message}
              </Place>
              <span className="faint">{words.check.line(finding.line)}</span>
            </li>
          ))}
        </ul>
      )}
      {all.length > 0 && <Mutants studio={studio} all={all} />}
      {covered.map((model) => (
        <section key={model.model} className="covered" aria-label={words.marks.coverage(model.model)}>
          <h4>{words.marks.coverage(model.model.split('/').at(-1) ?? model.model)}</h4>
          <p className="totals">
            {model.totals.map(({ kind, covered, total }) => (
              <span key={kind}>
                {kind} <b>{covered}</b> / {total}
              </span>
            ))}
          </p>
          <ul className="verdicts">
            {model.uncovered.map((item, index) => (
              <li key={index} className="verdict fault-told">
                <span className="outcome unknown">
                  <Icon name="question" size={13} />
                  {words.marks.open}
                </span>
                <Place studio={studio} place={item}>
                  {words.marks.uncovered(item.what, item.rule)}
                </Place>
                <span className="faint">{words.check.line(item.line)}</span>
              </li>
            ))}
          </ul>
        </section>
      ))}
    </>
  )
}

function Mutants({ studio, all }: { studio: Studio; all: Mutant[] }): ReactNode {
  const of = (outcome: string): number => all.filter((mutant) => mutant.outcome === outcome).length
  const survived = all.filter((mutant) => mutant.outcome === 'survived')
  return (
    <section className="covered" aria-label={words.jobs.mutate}>
      <p className="totals">{words.marks.score(of('killed'), survived.length, of('equivalent'), of('unknown') + of('not-compiled'))}</p>
      <ul className="verdicts">
        {survived.map((mutant, index) => (
          <li key={index} className="verdict fault-told">
            <span className="outcome bad">
              <Icon name="mutant" size={13} />
              {words.marks.survives}
            </span>
            <div>
              <Place studio={studio} place={mutant}>
                {mutant.operator}
              </Place>
              <code className="mutation">
                <del>{mutant.before.join('\n').trim()}</del>
                <ins>{mutant.after.join('\n').trim() || words.marks.nothing}</ins>
              </code>
            </div>
          </li>
        ))}
      </ul>
    </section>
  )
}
