// The language client's transport, without refusals that mean nothing to the user: an answer that was given up because the text
// changed, or because nobody waits for it, is no answer, as the protocol wants it.

import type { Transport } from './server'

const GIVEN_UP = /"code":\s*-32(801|800|802)\b/

export function quiet(transport: Transport): Transport {
  const wrapped = new Map<(message: string) => void, (message: string) => void>()
  return {
    send: (message) => transport.send(message),
    subscribe(handler) {
      const heard = (message: string): void => {
        if (!GIVEN_UP.test(message)) return handler(message)
        const { id, error } = JSON.parse(message) as { id?: number; error?: object }
        handler(error === undefined ? message : JSON.stringify({ jsonrpc: '2.0', id, result: null }))
      }
      wrapped.set(handler, heard)
      transport.subscribe(heard)
    },
    unsubscribe(handler) {
      const heard = wrapped.get(handler)
      if (heard) transport.unsubscribe(heard)
      wrapped.delete(handler)
    },
  }
}
