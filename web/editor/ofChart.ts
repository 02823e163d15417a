// What is done to the model of a chart: only to one that is the chart's, unless the user knows that it is not.
//
// In: a chart, and what is to be done. Out: it is done, with the model; before that the model is built if there is none, and the user is
// asked if the two differ. INVARIANT: a model that may not be the chart's is never taken for it in silence.

import type { File } from '../diagram/protocol'
import type { Act } from '../found-words'
import type { Job } from './jobs'
import type { RecordedInputs } from './run'
import type { Studio } from './studio'

// Whether a chart and its model agree; of an exported project, as it was recorded.
export type Agreement = 'none' | 'agrees' | 'differs' | 'faulty' | 'unknown' | 'recorded'

export interface OfChart {
  what: Act
  chart: File
  act: (model: File, isOlder: boolean) => void
}

export async function buildFirst(studio: Studio, { chart, act }: OfChart): Promise<void> {
  const built = await studio.jobs.run('build', chart)
  if (built?.code !== 0) return
  await studio.look()
  const model = studio.sibling(chart, 'asm')
  if (model) act(model, false)
}

export async function withModel(studio: Studio, asked: OfChart): Promise<void> {
  const { chart, act } = asked
  const model = studio.sibling(chart, 'asm')
  if (!model) return buildFirst(studio, asked)
  await studio.saveAll()
  try {
    const { state } = await studio.server.request<{ state: Agreement }>('studio/model', { path: chart.path })
    if (state === 'none') return await buildFirst(studio, asked)
    if (state === 'agrees' || state === 'recorded') return act(model, false)
    studio.store.set({ dialog: { kind: 'older', asked, model, state } })
  } catch (error) {
    studio.tell((error as Error).message, 'refused')
  }
}

// A run of a chart's model.
export const runOf = (studio: Studio, chart: File, seed: number | null = null, recorded: RecordedInputs | null = null, script: string | null = null): OfChart => ({
  what: 'run',
  chart,
  act: (model, isOlder) => void studio.runner.open(model, seed, recorded, script, { chart, text: studio.doc(chart.uri)?.text ?? null, isOlder }),
})

// Once more what a job did. Of a chart's model the two are compared again, unless neither has changed: then it is decided which one is meant.
export function again(studio: Studio, { id, job, file, chart, isOlder, options }: Job): void {
  const begin = (model: File, isOlder: boolean): void => void studio.jobs.start(job, model, options, chart && { chart, isOlder })
  if (chart && studio.currency.store.get().changed.has(id)) void withModel(studio, { what: job, chart, act: begin })
  else begin(file, isOlder)
}

export const lastName = (path: string): string => path.split('/').at(-1) ?? path
