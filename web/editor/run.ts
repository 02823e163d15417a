// Running a model by hand or at a speed: one session of the server, its states, breakpoints, what is recorded.
//
// Owns: the session and its last answer, inputs that were set, values of guards. INVARIANT: the engine
// alone makes steps; here nothing is computed but when to ask for the next.

import { freeName } from '../diagram/record'
import { closedTerm, controlOf, isControl, stateOf } from '../diagram/light'
import type { Drawing, File, SessionState } from '../diagram/protocol'
import { words } from '../words'
import { runOf, withModel } from './ofChart'
import { Store } from './store'
import type { Studio } from './studio'

export interface RunState {
  file: File | null
  session: SessionState | null
  busy: boolean
  playing: boolean
  // Steps a second; 0 is as fast as can be.
  speed: number
  // Inputs that keep a value until they are set again.
  sets: ReadonlyMap<string, string>
  breaks: readonly string[]
  // Why it paused at a breakpoint.
  broke: string | null
  // Terms with their values in this state.
  values: ReadonlyMap<string, string | null>
  seed: number | null
  // A file of inputs that the run takes.
  recorded: RecordedInputs | null
  // The chart in front when the run of its model began, its text then, and whether the model is known not to be the chart's.
  of: RunOf | null
  // The scenario that is played, if it is in no file.
  script: string | null
  // What the server calls that text.
  scriptUri: string
}

export interface RunOf {
  chart: File
  text: string | null
  isOlder: boolean
}

export interface RecordedInputs {
  name: string
  text: string
}

const NONE: RunState = {
  file: null,
  session: null,
  busy: false,
  playing: false,
  speed: 4,
  sets: new Map(),
  breaks: [],
  broke: null,
  values: new Map(),
  seed: null,
  recorded: null,
  of: null,
  script: null,
  scriptUri: '',
}

const FAST_STEPS = 200

export class Runner {
  readonly store = new Store<RunState>(NONE)
  private timer: ReturnType<typeof setTimeout> | undefined
  private readonly offered = new Map<string, string[]>()
  private readonly ends = new Map<string, [number, number]>()

  constructor(private readonly studio: Studio) {}

  // Begins a run of a model or a scenario.
  async open(file: File, seed: number | null = null, recorded: RecordedInputs | null = null, script: string | null = null, of: RunOf | null = null): Promise<void> {
    await this.close()
    this.store.set({ busy: true, file, seed, recorded, script, of })
    this.studio.store.set({ panel: 'run' })
    this.studio.besideModel(file.uri)
    try {
      const params = {
        textDocument: { uri: file.uri },
        begins: true,
        ...(seed === null ? {} : { seed }),
        ...(recorded === null ? {} : { inputs: recorded }),
        ...(script === null ? {} : { scenario: script }),
      }
      const session = await this.studio.ask<SessionState>('groundstate/session/open', params)
      this.store.set({ sets: new Map(), broke: null, scriptUri: session.next?.uri ?? '' })
      this.took(session)
    } catch (error) {
      this.store.set({ file: null })
      this.studio.tell((error as Error).message, 'refused')
    } finally {
      this.store.set({ busy: false })
    }
  }

  // What an input may be, as it was offered when it was asked for.
  offers(location: string): string[] {
    return this.offered.get(location) ?? []
  }

  // The ends of an input's domain, as they were told when it was asked for.
  bounds(location: string): [number, number] | null {
    return this.ends.get(location) ?? null
  }

  private took(session: SessionState): void {
    if (session.waiting === 'input' && session.word && session.bounds) this.ends.set(session.word, session.bounds)
    if (session.waiting === 'input' && session.word && session.offered.length > 0) this.offered.set(session.word, session.offered)
    this.store.set({ session })
    if (session.refused) this.studio.tell(session.refused, 'refused')
    this.marks(session)
    this.follow(session)
    void this.evaluate()
  }

  private async ask(method: string, params: object): Promise<SessionState | null> {
    const { session } = this.store.get()
    if (!session) return null
    this.store.set({ busy: true })
    try {
      const answer = await this.studio.server.request<SessionState>(`groundstate/session/${method}`, {
        session: session.session,
        ...params,
      })
      this.took(answer)
      return answer
    } catch (error) {
      this.pause()
      this.studio.tell((error as Error).message, 'refused')
      return null
    } finally {
      this.store.set({ busy: false })
    }
  }

  async step(): Promise<SessionState | null> {
    this.store.set({ broke: null })
    return this.ask('step', { steps: 1 })
  }

  async back(): Promise<void> {
    this.pause()
    await this.ask('back', {})
    this.store.set({ broke: null })
  }

  // Goes to a step: back, or on from here.
  async goTo(step: number): Promise<void> {
    this.pause()
    for (;;) {
      const { session } = this.store.get()
      if (!session || session.step === step || session.refused !== null) return
      if (session.step > step) await this.back()
      else if (session.waiting !== 'step' || !(await this.step())) return
      const now = this.store.get().session
      if (now && now.session === session.session && now.step === session.step) return
    }
  }

  async set(location: string, value: string | null): Promise<void> {
    const sets = new Map(this.store.get().sets)
    if (value === null) sets.delete(location)
    else sets.set(location, value)
    const answer = await this.ask('set', { location, value })
    if (answer && !answer.refused) this.store.set({ sets })
  }

  async answer(value: string): Promise<void> {
    await this.ask('answer', { value })
  }

  async choose(candidate: number): Promise<void> {
    await this.ask('choose', { candidate })
  }

  play(): void {
    if (this.store.get().playing) return
    this.store.set({ playing: true })
    void this.tick()
  }

  private async tick(): Promise<void> {
    const { playing, speed, session } = this.store.get()
    if (!playing || !session) return
    const begun = performance.now()
    const answer = speed === 0 ? await this.fast() : await this.step()
    if (!this.store.get().playing) return
    const over = !answer || answer.waiting !== 'step' || answer.faults.length > 0 || answer.refused !== null
    if (over || (await this.broken())) return this.pause()
    const wait = speed === 0 ? 0 : Math.max(0, 1000 / speed - (performance.now() - begun))
    this.timer = setTimeout(() => void this.tick(), wait)
  }

  private async fast(): Promise<SessionState | null> {
    const { breaks } = this.store.get()
    if (breaks.length === 0) return this.ask('step', { steps: FAST_STEPS })
    await this.studio.server.request('groundstate/session/breaks', { session: this.store.get().session?.session, terms: breaks })
    return this.ask('resume', { steps: FAST_STEPS })
  }

  // Whether a breakpoint's term is true now.
  private async broken(): Promise<boolean> {
    const { breaks, session } = this.store.get()
    if (breaks.length === 0 || !session) return false
    try {
      const { values } = await this.studio.server.request<{ values: (string | null)[] }>('groundstate/session/evaluate', {
        session: session.session,
        terms: breaks,
      })
      const index = values.indexOf('true')
      if (index >= 0) this.store.set({ broke: breaks[index] ?? null })
      return index >= 0
    } catch {
      return false
    }
  }

  pause(): void {
    clearTimeout(this.timer)
    this.store.set({ playing: false })
  }

  setSpeed(speed: number): void {
    this.store.set({ speed })
  }

  toggleBreak(term: string): void {
    this.store.set(({ breaks }) => ({
      breaks: breaks.includes(term) ? breaks.filter((known) => known !== term) : [...breaks, term],
    }))
  }

  async restart(): Promise<void> {
    const { file, session, seed, recorded, script, of } = this.store.get()
    // A file of inputs may be another by now.
    const inputs = (recorded && (await this.inputs(recorded.name))) ?? recorded
    // Of the same texts it is decided which model is meant.
    const isSame = of !== null && this.studio.doc(of.chart.uri)?.text === of.text && session?.stale === false
    if (of && !isSame) await withModel(this.studio, runOf(this.studio, of.chart, seed, inputs, script))
    else if (file) await this.open(file, seed, inputs, script, of)
  }

  // The text of a file of inputs.
  async inputs(file: string): Promise<RecordedInputs | null> {
    try {
      const { text } = await this.studio.server.request<{ text: string }>('studio/inputs', { file })
      return { name: file, text }
    } catch (error) {
      this.studio.tell((error as Error).message, 'refused')
      return null
    }
  }

  async close(): Promise<void> {
    this.pause()
    const { session } = this.store.get()
    this.clearMarks()
    this.store.set({ session: null, file: null, values: new Map(), broke: null, script: null })
    if (!session) return
    this.studio.store.set({ beside: 'chart' })
    try {
      await this.studio.server.request('groundstate/session/close', { session: session.session })
    } catch {
      // It is gone already.
    }
  }

  lost(): void {
    this.pause()
    this.clearMarks()
    this.store.set({ session: null, file: null, values: new Map() })
  }

  // What the session did so far as a scenario beside the model.
  async record(): Promise<void> {
    const { file, script } = this.store.get()
    if (!file || file.kind !== 'model') return
    const folder = file.path.slice(0, file.path.lastIndexOf('/') + 1)
    const model = file.path.slice(folder.length).replace(/\.asm$/, '')
    const taken = this.studio.store
      .get()
      .files.filter((other) => other.path.startsWith(folder))
      .map((other) => other.path.slice(folder.length).replace(/\.[^.]*$/, ''))
    const name = freeName(model, taken)
    const text = script ?? (await this.written(name, `${model}.asm`))
    if (text === null) return
    if (await this.studio.write(`${folder}${name}.avalla`, text))
      this.studio.tell(words.run.recorded(name))
  }

  // The run as the server writes it: with what was given and chosen, by hand or at random.
  private async written(name: string, model: string): Promise<string | null> {
    try {
      const params = { session: this.store.get().session?.session, name, model }
      return (await this.studio.server.request<{ text: string }>('groundstate/session/scenario', params)).text
    } catch (error) {
      this.studio.tell((error as Error).message, 'refused')
      return null
    }
  }

  // Guards of the drawings that are shown.

  private guardTerms(): string[] {
    const { session } = this.store.get()
    const terms = new Set<string>()
    if (!session) return []
    for (const drawing of this.shown())
      for (const box of drawing.picture.boxes) for (const { term } of guardTerms(drawing, box, session)) terms.add(term)
    return [...terms].slice(0, 200)
  }

  private shown(): Drawing[] {
    const { active, tabs } = this.studio.store.get()
    const uris = active === null ? tabs : [active]
    return uris.map((uri) => this.studio.chart(uri)?.drawing).filter((drawing) => drawing !== null && drawing !== undefined)
  }

  // Asks for the values of the guards on the canvas.
  async evaluate(): Promise<void> {
    const { session } = this.store.get()
    const terms = this.guardTerms()
    if (!session || terms.length === 0) return
    try {
      const { values } = await this.studio.server.request<{ values: (string | null)[] }>('groundstate/session/evaluate', {
        session: session.session,
        terms,
      })
      if (this.store.get().session?.session !== session.session) return
      this.store.set({ values: new Map(terms.map((term, index) => [term, values[index] ?? null])) })
    } catch {
      this.store.set({ values: new Map() })
    }
  }

  // What the last step wrote, on the lines of the open texts.
  private marks(session: SessionState): void {
    for (const doc of this.studio.openDocs) {
      const here = <T extends { uri: string }>(place: T): boolean => place.uri === doc.file.uri
      doc.ran([
        ...session.unchanged.filter(here).map(({ range }) => ({ range, kind: 'same' as const })),
        ...session.updates.filter(({ at }) => here(at)).map(({ at }) => ({ range: at.range, kind: 'changed' as const })),
        ...session.faults.filter(({ at }) => here(at)).map(({ at }) => ({ range: at.range, kind: 'fault' as const })),
        ...(session.next && here(session.next) ? [{ range: session.next.range, kind: 'next' as const }] : []),
      ])
    }
  }

  // A text that was opened meanwhile.
  markAgain(): void {
    const { session } = this.store.get()
    if (session) this.marks(session)
  }

  // In a step by hand, the first line that it wrote comes into view.
  private follow(session: SessionState): void {
    const first = session.faults[0]?.at ?? session.next ?? session.updates[0]?.at
    const doc = first && this.studio.doc(first.uri)
    if (!first || !doc || this.store.get().playing || !doc.view.dom.isConnected || doc.view.hasFocus) return
    doc.scrollTo(first.range)
  }

  private clearMarks(): void {
    for (const doc of this.studio.openDocs) doc.ran([])
  }
}

// The terms that say whether a guard holds, one for each agent if it speaks of one.
export function guardTerms(
  drawing: Drawing,
  box: Drawing['picture']['boxes'][number],
  session: SessionState,
): { term: string; agent: string }[] {
  const closed = closedTerm(box)
  if (closed !== null) return [{ term: closed, agent: '' }]
  const control = controlOf(drawing)
  if (box.figure !== 'hexagon' || control === null) return []
  const variables = new Set([...(box.link ?? '').matchAll(/\$\w+/g)].map(([name]) => name))
  if (box.link === null || box.link === '') return control.includes('$') ? [] : [{ term: box.id, agent: '' }]
  const [variable] = variables
  if (variables.size !== 1 || variable === undefined || !control.includes(variable)) return []
  const out: { term: string; agent: string }[] = []
  for (const [location] of stateOf(session)) {
    const agent = /^[^(]*\((.*)\)$/.exec(location)?.[1]
    if (agent === undefined || agent === '' || !isControl(location, control)) continue
    out.push({ term: box.link.split(variable).join(agent), agent })
  }
  return out.slice(0, 8)
}
