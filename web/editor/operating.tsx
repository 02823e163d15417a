// Operations that fields ask for: what is said against one is told at the field that asked.
//
// In: operations with a key of their field. Out: whether they were done, and what was refused, by the key.

import { type ReactNode, useState } from 'react'

import type { Operation } from '../diagram/protocol'
import type { Chart } from './chart'

export interface Acting {
  refused: ReadonlyMap<string, string>
  act: (key: string, operation: Operation, options?: { select: boolean }) => Promise<boolean>
}

export function useOperation({ chart }: { chart: Chart }): Acting {
  const [refused, setRefused] = useState<ReadonlyMap<string, string>>(new Map())
  const act = async (key: string, operation: Operation, { select } = { select: false }): Promise<boolean> => {
    setRefused(new Map())
    const done = await chart.operate(operation, { select, refused: (reason) => setRefused(new Map([[key, reason]])) })
    return done !== null
  }
  return { refused, act }
}

export function Told({ reason }: { reason: string | null }): ReactNode {
  if (reason === null) return null
  return (
    <p className="field-fault" role="alert">
      {reason}
    </p>
  )
}
