// What the editor needs of a connection to the server; `app/connection.ts` is one.

export interface Transport {
  send(message: string): void
  subscribe(handler: (message: string) => void): void
  unsubscribe(handler: (message: string) => void): void
}

// Without a connection: nobody answers, or somebody who does not know this page. That is a studio that was started anew.
export type Online = 'connecting' | 'open' | 'closed' | 'unknown'

export const isLost = (online: Online): boolean => online === 'closed' || online === 'unknown'

export interface Server {
  readonly online: Online
  readonly transport: Transport
  request<Result>(method: string, params: unknown): Promise<Result>
  on<Params>(method: string, handler: (params: Params) => void): void
  watch(watcher: (online: Online) => void): void
}
