// What a refinement check found: the verdict, what it rests on, and where it fails: both runs as lanes and charts on one axis, and side by
// side in words.
//
// Owns: a shadow tree with a part of a report's page. In: a job's line of type `refinement`.

import { type ReactNode, useEffect, useRef } from 'react'

import { lightCharts } from '../../crates/report/src/html/charts.js'
import { type LaneRun, drawingOf } from '../../crates/report/src/html/draw.js'
import { explore } from '../../crates/report/src/html/explore.js'
import { words } from '../words'
import { Icon } from './icons'
import type { Job } from './jobs'

// The type of the line that is shown here.
export const REFINEMENT = 'refinement'

interface Part {
  markup: string
  run: LaneRun | null
  style: string
}

interface Refinement {
  verdict: 'refines' | 'does-not-refine' | 'unknown' | 'vacuous'
  reasons?: string[]
  coupling: string[]
  left_out?: string[]
  diagrams?: { abstract: number; concrete: number; places?: number }[]
  assumed?: { model: string; name: string; from?: string }[]
  waiting_allowed?: boolean
  overflow_allowed?: boolean
  pairs: number
  open_pairs: number
  properties?: { name: string; standing: string; form?: string; reason?: string }[]
  page?: Part
}

const TONES = {
  refines: ['good', 'check'],
  'does-not-refine': ['bad', 'cross'],
  unknown: ['unknown', 'question'],
  vacuous: ['unknown', 'question'],
} as const

export function refinementOf(job: Job): Refinement | null {
  const line = job.lines.findLast((line) => typeof line === 'object' && line['type'] === REFINEMENT)
  return line ? (line as unknown as Refinement) : null
}

export function Refined({ found }: { found: Refinement }): ReactNode {
  const [tone, icon] = TONES[found.verdict]
  const { refined } = words
  const assumed = [
    ...(found.waiting_allowed ? [refined.waiting] : []),
    ...(found.overflow_allowed ? [refined.overflow] : []),
    ...(found.assumed ?? []).map(({ model, name, from }) => `${name} (${[model, from].filter(Boolean).join(', ')})`),
  ]
  const diagrams = (found.diagrams ?? []).map(({ abstract, concrete, places }) => `${abstract}:${concrete} ${refined.places(places ?? 0)}`)
  return (
    <section className="refined" aria-label={words.jobs.refine}>
      <p className="verdict">
        <span className={`outcome ${tone}`}>
          <Icon name={icon} size={13} />
          {refined.verdicts[found.verdict]}
        </span>
        <span>{(found.reasons ?? []).join('; ')}</span>
        <span className="faint">{refined.pairs(found.pairs, found.open_pairs)}</span>
      </p>
      {found.verdict !== 'does-not-refine' && <Told title={refined.observed} lines={found.coupling} />}
      {(found.left_out ?? []).length > 0 && found.verdict !== 'does-not-refine' && <Told title={refined.leftOut} lines={found.left_out ?? []} />}
      {diagrams.length > 0 && <Told title={refined.diagrams} lines={[diagrams.join(', ')]} />}
      {assumed.length > 0 && <Told title={refined.assumed} lines={assumed} />}
      {(found.properties ?? []).length > 0 && (
        <Told title={refined.properties} lines={(found.properties ?? []).map(({ name, standing, form, reason }) => `${name}: ${refined.standings[standing] ?? standing}: ${form ?? reason ?? ''}`)} />
      )}
      {found.page && found.page.markup !== '' && <PagePart part={found.page} />}
    </section>
  )
}

function Told({ title, lines }: { title: string; lines: string[] }): ReactNode {
  return (
    <div className="refined-told">
      <h4>{title}</h4>
      <ul>
        {lines.map((line, index) => (
          <li key={index}>
            <code>{line}</code>
          </li>
        ))}
      </ul>
    </div>
  )
}

function PagePart({ part }: { part: Part }): ReactNode {
  const host = useRef<HTMLDivElement>(null)
  useEffect(() => {
    if (!host.current) return
    const root = host.current.shadowRoot ?? host.current.attachShadow({ mode: 'open' })
    const sheet = new CSSStyleSheet()
    sheet.replaceSync(part.style + OWN)
    root.adoptedStyleSheets = [sheet]
    // The server escapes names and strings of the models, as in the page of a report.
    root.innerHTML = `<div class="live">${part.markup}</div>`
    if (!part.run) return
    const drawing = drawingOf(part.run)
    const explored = explore(root, part.run, drawing, { moved: () => {} })
    if (part.run.charts) lightCharts(root, part.run, drawing, explored)
  }, [part])
  return <div ref={host} className="refined-page" />
}

// The page's look, as a panel has it.
const OWN = `
:host { display: block; }
section { border: 0; margin: 0; padding: 10px 0 6px; }
section > h2 { font-size: 13px; margin: 0 0 4px; }
.hint, details.numbers, #steps > .lead { display: none; }
.controls button, .moment button { padding: 2px 9px; }
.charts { grid-template-columns: repeat(auto-fit, minmax(280px, 1fr)); }
`
