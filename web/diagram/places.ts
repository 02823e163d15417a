// Which shape of a chart a place in its model speaks of, as the language server says it (docs/editors.md).

import type { Position } from './protocol'

export interface Shapes {
  drawing: string
  state: string | null
  guard: string | null
  action: string | null
  // The declared rule around the place.
  rule: string | null
}

// What a place of a model speaks of, if of anything.
export interface Speaking {
  position: Position
  shapes: Shapes | null
}

// The shape that is meant most of all.
export const meant = (shapes: Shapes): string | null => shapes.action ?? shapes.guard ?? shapes.state
