// What the editor needs of a connection to the server; `app/connection.ts` is one.

export interface Transport {
  send(message: string): void
  subscribe(handler: (message: string) => void): void
  unsubscribe(handler: (message: string) => void): void
}

export interface Server {
  readonly online: 'connecting' | 'open' | 'closed'
  readonly transport: Transport
  request<Result>(method: string, params: unknown): Promise<Result>
  on<Params>(method: string, handler: (params: Params) => void): void
  watch(watcher: (online: 'connecting' | 'open' | 'closed') => void): void
}
