// The WebSocket to the server: one connection, begun again when it breaks.
//
// Owns: JSON-RPC requests with names of their own (`s1`, `s2`, …), so that the language client's numbers do not meet them;
// notifications by method; the transport that the language client takes. It must not know what the messages mean.

import { type Online, isLost } from '../editor/server'
import { words } from '../words'
import { Exported, exported } from './exported'

interface Waiting {
  resolve: (result: unknown) => void
  reject: (error: Error) => void
}

interface Message {
  id?: string | number | null
  method?: string
  params?: unknown
  result?: unknown
  error?: { code: number; message: string; data?: unknown }
}

// A request that the server refused, with a sentence for the user.
export class Refused extends Error {
  constructor(
    message: string,
    readonly code: number,
  ) {
    super(message)
  }
}

const FIRST_DELAY_MS = 250
const LAST_DELAY_MS = 4000
// What a studio answers to a page that has not its token.
const FORBIDDEN = 403

export class Connection {
  private socket: WebSocket | null = null
  private count = 0
  private delay = FIRST_DELAY_MS
  private waiting = new Map<string, Waiting>()
  private handlers = new Map<string, Set<(params: never) => void>>()
  private raw = new Set<(message: string) => void>()
  private watchers = new Set<(online: Online) => void>()
  online: Online = 'connecting'

  // Answers instead of a server, where the page is an exported project.
  private kept: Exported | null = null

  constructor(private readonly address: string) {}

  open(): void {
    const project = exported()
    if (project !== null) {
      void Exported.load(project, (method, params) => this.received(JSON.stringify({ method, params }))).then(
        (kept) => {
          this.kept = kept
          this.tell('open')
        },
        () => this.tell('closed'),
      )
      return
    }
    const socket = new WebSocket(this.address)
    this.socket = socket
    socket.onopen = () => {
      this.delay = FIRST_DELAY_MS
      this.tell('open')
    }
    socket.onmessage = (event) => this.received(String(event.data))
    socket.onclose = () => {
      if (this.socket !== socket) return
      this.socket = null
      for (const { reject } of this.waiting.values()) reject(new Refused(words.shell.connectionLost, 0))
      this.waiting.clear()
      if (this.online !== 'unknown') this.tell('closed')
      void this.askWhy()
      setTimeout(() => this.open(), this.delay)
      this.delay = Math.min(this.delay * 2, LAST_DELAY_MS)
    }
  }

  // A WebSocket does not say why it was refused; the page's own address does.
  private async askWhy(): Promise<void> {
    const status = await fetch('/', { method: 'HEAD', cache: 'no-store' }).then(
      (response) => response.status,
      () => null,
    )
    if (isLost(this.online)) this.tell(status === FORBIDDEN ? 'unknown' : 'closed')
  }

  private tell(online: Online): void {
    if (online === this.online) return
    this.online = online
    for (const watcher of this.watchers) watcher(online)
  }

  watch(watcher: (online: Online) => void): void {
    this.watchers.add(watcher)
  }

  private received(text: string): void {
    const message = JSON.parse(text) as Message
    if (message.method === undefined && typeof message.id === 'string') {
      const waiting = this.waiting.get(message.id)
      this.waiting.delete(message.id)
      if (message.error) waiting?.reject(new Refused(message.error.message, message.error.code))
      else waiting?.resolve(message.result)
      return
    }
    const handlers = message.method !== undefined ? this.handlers.get(message.method) : undefined
    if (handlers && message.id === undefined) {
      for (const handler of handlers) handler(message.params as never)
      return
    }
    for (const listener of [...this.raw]) listener(text)
  }

  private async ask(kept: Exported, method: string, params: unknown): Promise<unknown> {
    try {
      return kept.answer(method, (params ?? {}) as Record<string, unknown>)
    } catch (error) {
      throw new Refused(error instanceof Error ? error.message : String(error), 0)
    }
  }

  request<Result>(method: string, params: unknown): Promise<Result> {
    if (this.kept) return this.ask(this.kept, method, params) as Promise<Result>
    const socket = this.socket
    if (!socket || socket.readyState !== WebSocket.OPEN) return Promise.reject(new Refused(words.shell.connectionLost, 0))
    const id = `s${++this.count}`
    return new Promise<Result>((resolve, reject) => {
      this.waiting.set(id, { resolve: resolve as (result: unknown) => void, reject })
      socket.send(JSON.stringify({ jsonrpc: '2.0', id, method, params }))
    })
  }

  // What the language client asks of an exported project.
  private sent(kept: Exported, text: string): void {
    const message = JSON.parse(text) as Message
    if (message.id === undefined || message.id === null || message.method === undefined) return
    const { id } = message
    void this.ask(kept, message.method, message.params).then(
      (result) => this.received(JSON.stringify({ jsonrpc: '2.0', id, result: result ?? null })),
      (error: Refused) => this.received(JSON.stringify({ jsonrpc: '2.0', id, error: { code: -32803, message: error.message } })),
    )
  }

  on<Params>(method: string, handler: (params: Params) => void): void {
    const known = this.handlers.get(method) ?? new Set()
    known.add(handler as (params: never) => void)
    this.handlers.set(method, known)
  }

  // What the language client speaks through. While there is no connection, what it sends is lost: it begins anew afterwards.
  readonly transport = {
    send: (message: string): void => {
      if (this.kept) this.sent(this.kept, message)
      if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(message)
    },
    subscribe: (listener: (message: string) => void): void => void this.raw.add(listener),
    unsubscribe: (listener: (message: string) => void): void => void this.raw.delete(listener),
  }
}
