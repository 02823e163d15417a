// State outside of React that components can watch.
//
// Owns: `Store`, a value with listeners, and the hook that reads a part of it. INVARIANT: a value is replaced, never changed in
// place, so equality tells whether it is new.

import { useSyncExternalStore } from 'react'

export class Store<T> {
  private listeners = new Set<() => void>()

  constructor(private value: T) {}

  get = (): T => this.value

  set(change: Partial<T> | ((value: T) => Partial<T>)): void {
    const part = typeof change === 'function' ? change(this.value) : change
    const known = this.value as Record<string, unknown>
    if (Object.entries(part as Record<string, unknown>).every(([key, value]) => Object.is(known[key], value))) return
    this.value = { ...this.value, ...part }
    for (const listener of [...this.listeners]) listener()
  }

  subscribe = (listener: () => void): (() => void) => {
    this.listeners.add(listener)
    return () => this.listeners.delete(listener)
  }
}

// A part of a store; the component is drawn again when that part is another. `pick` must not build a new object each time.
export function useStore<T, P>(store: Store<T>, pick: (value: T) => P): P {
  return useSyncExternalStore(store.subscribe, () => pick(store.get()))
}
