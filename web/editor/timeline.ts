// The timeline of a run: asked for again as the run goes on, drawn by the scripts of a report's page in a tree of its own.
//
// Owns: the shadow tree, when it is asked for, the window that is looked at. In: the runner's session. INVARIANT: one request at a
// time; what comes for another session is dropped.

import { type LaneRun, drawingOf } from '../../crates/report/src/html/draw.js'
import { type Explored, explore } from '../../crates/report/src/html/explore.js'
import type { SessionState } from '../diagram/protocol'
import type { Studio } from './studio'

// While a run goes on, its lanes are asked for so often.
const APART_MS = 250

interface Lanes {
  steps: number
  // After so many steps is the state that the first tick shows: 0 or 1.
  first: number
  empty: boolean
  markup: string
  run: LaneRun
  style: string
}

export type Shown = 'nothing' | 'empty' | 'lanes' | { refused: string }

export class Timeline {
  private readonly root: ShadowRoot
  private explored: Explored | null = null
  private session = -1
  private first = 1
  private asking = false
  // Of which moment the lanes are.
  private known = ''
  private gone = false

  constructor(
    private readonly studio: Studio,
    host: HTMLElement,
    private readonly told: (shown: Shown) => void,
  ) {
    this.root = host.shadowRoot ?? host.attachShadow({ mode: 'open' })
  }

  // The run is at this moment now.
  at(session: SessionState): void {
    if (session.session !== this.session) {
      this.session = session.session
      this.explored = null
      this.known = ''
    }
    void this.look()
  }

  end(): void {
    this.gone = true
  }

  private present(): SessionState | null {
    const { session } = this.studio.runner.store.get()
    return session && session.session === this.session && !this.gone ? session : null
  }

  private async look(): Promise<void> {
    const session = this.present()
    if (this.asking || !session) return
    const moment = `${session.session} ${session.step} ${session.waiting}`
    if (moment === this.known) return
    this.asking = true
    try {
      const lanes = await this.studio.server.request<Lanes | null>('groundstate/session/timeline', { session: session.session })
      this.known = moment
      if (this.present()?.session === session.session) this.show(lanes, session.step)
    } catch (error) {
      this.known = moment
      if (this.present()) this.told({ refused: (error as Error).message })
    }
    setTimeout(() => {
      this.asking = false
      void this.look()
    }, APART_MS)
  }

  private show(lanes: Lanes | null, step: number): void {
    if (!lanes || lanes.steps === 0) return this.told('nothing')
    if (lanes.empty) return this.told('empty')
    // Before the first drawing, so that it has a width.
    this.told('lanes')
    const drawing = drawingOf(lanes.run)
    this.first = lanes.first
    if (this.explored) {
      this.renew(lanes.markup)
      this.explored.take(lanes.run, drawing)
    } else {
      const sheet = new CSSStyleSheet()
      sheet.replaceSync(lanes.style + OWN)
      this.root.adoptedStyleSheets = [sheet]
      // The server escapes names and strings of the model, as in the page of a report.
      this.root.innerHTML = `<div class="live">${lanes.markup}</div>`
      const picked = (tick: number): void => void this.studio.runner.goTo(Math.floor(tick) + this.first)
      this.explored = explore(this.root, lanes.run, drawing, { moved: () => {}, picked })
    }
    this.explored.place(step >= lanes.first ? step - lanes.first : null)
    this.explored.mark()
  }

  // What the scripts do not draw: the overview and the legends.
  private renew(markup: string): void {
    const made = document.createElement('template')
    made.innerHTML = markup
    const overview = made.content.getElementById('overview')
    if (overview) this.root.getElementById('overview')?.replaceWith(overview)
    const legends = made.content.querySelectorAll('.legend')
    const old = this.root.querySelectorAll('.legend')
    const place = this.root.getElementById('controls')
    old.forEach((list) => list.remove())
    legends.forEach((list) => place?.before(list))
  }
}

// The page's look, as a panel has it.
const OWN = `
:host { display: block; height: 100%; overflow: auto; }
section { border: 0; margin: 0; padding: 8px 16px 16px; display: flex; flex-direction: column; }
/* The lanes first: what the colours mean stands below them. */
.legend { order: 1; }
section > h2, .hint, details.numbers { display: none; }
.controls { margin-bottom: 6px; }
.controls button { padding: 2px 9px; }
.legend { margin: 8px 0 0; }
`
