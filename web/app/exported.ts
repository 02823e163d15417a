// An exported project: the same requests, answered once and kept in one file beside the page.
//
// Owns: which answers the file has, and playing a recorded run as if it were made now. What is not in it is refused with a sentence. It
// must not know what asks.

import { words } from '../words'

interface Project {
  hello: { files: { path: string; uri: string }[] }
  texts: Record<string, string>
  pictures: Record<string, unknown>
  runs: Record<string, Record<string, unknown>[]>
  results: Record<string, { lines: unknown[]; code: number | null }>
}

type Params = Record<string, unknown> & { textDocument?: { uri: string } }

// The address of the file, if this page is an exported one.
export function exported(): string | null {
  return document.querySelector('meta[name="groundstate-project"]')?.getAttribute('content') ?? null
}

export class Exported {
  private sessions = new Map<number, { states: Record<string, unknown>[]; at: number }>()
  private last = 0

  constructor(
    private readonly project: Project,
    // Where notifications go.
    private readonly tell: (method: string, params: unknown) => void,
  ) {}

  static async load(address: string, tell: (method: string, params: unknown) => void): Promise<Exported> {
    const response = await fetch(address)
    if (!response.ok) throw new Error(`${address}: ${response.status}`)
    return new Exported((await response.json()) as Project, tell)
  }

  answer(method: string, params: Params): unknown {
    const { project } = this
    const uri = params.textDocument?.uri ?? ''
    switch (method) {
      case 'studio/hello':
        return project.hello
      case 'studio/read': {
        const text = project.texts[String(params.path ?? params.uri)]
        if (text === undefined) break
        return { text, hash: '' }
      }
      case 'studio/model':
        return { state: 'recorded' }
      case 'studio/job':
        return this.job(String(params.job), String(params.path))
      case 'initialize':
        return { capabilities: { textDocumentSync: 1 }, serverInfo: { name: 'groundstate' } }
      case 'shutdown':
        return null
      case 'groundstate/chart/picture':
        if (uri in project.pictures) return project.pictures[uri]
        break
      case 'groundstate/session/open': {
        const states = project.runs[uri]
        if (!states) break
        const session = ++this.last
        this.sessions.set(session, { states, at: 0 })
        return this.state(session)
      }
      case 'groundstate/session/step':
      case 'groundstate/session/resume':
        return this.move(params, method.endsWith('resume') ? Infinity : Number(params.steps ?? 1))
      case 'groundstate/session/back':
        return this.move(params, -1)
      case 'groundstate/session/state':
      case 'groundstate/session/breaks':
        return this.state(Number(params.session))
      case 'groundstate/session/evaluate':
        return { values: (params.terms as string[]).map((term) => this.value(Number(params.session), term)) }
      case 'groundstate/session/close':
        this.sessions.delete(Number(params.session))
        return null
    }
    if (method.startsWith('textDocument/')) return null
    throw new Error(words.exported.refused)
  }

  private move(params: Params, steps: number): unknown {
    const session = this.sessions.get(Number(params.session))
    if (session) session.at = Math.max(0, Math.min(session.states.length - 1, session.at + steps))
    return this.state(Number(params.session))
  }

  // What a guard was at this step of the recording; null where that is not in it.
  private value(number: number, term: string): string | null {
    const session = this.sessions.get(number)
    const values = session?.states[session.at]?.['values'] as Record<string, string> | undefined
    return values?.[term] ?? null
  }

  private state(number: number): unknown {
    const session = this.sessions.get(number)
    if (!session) throw new Error(words.exported.refused)
    const state = { ...session.states[session.at], session: number }
    // The recording ends, the machine does not.
    const isLast = session.at === session.states.length - 1
    return isLast ? { ...state, waiting: 'nothing', word: words.exported.end } : state
  }

  // What the job said when the project was exported.
  private job(job: string, path: string): unknown {
    const result = this.project.results[`${job} ${path}`]
    if (!result) throw new Error(words.exported.refused)
    const number = ++this.last
    setTimeout(() => {
      for (const line of result.lines) this.tell('studio/line', { job: number, line })
      this.tell('studio/done', { job: number, code: result.code })
    })
    return { job: number }
  }
}
