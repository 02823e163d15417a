// What the scripts of a report's page give, as the studio uses it. SYNC(run data)

declare module '*/report/src/html/draw.js' {
  // A run as its lanes show it; only the scripts look inside.
  export interface LaneRun {
    readonly shown: number
    readonly window: number
    readonly charts?: readonly unknown[]
  }
  export interface LaneDrawing {
    readonly viewOf: unknown
  }
  export function drawingOf(run: LaneRun): LaneDrawing
}

declare module '*/report/src/html/explore.js' {
  import type { LaneDrawing, LaneRun } from '*/report/src/html/draw.js'
  export interface Explored {
    show(start: number, end: number): void
    // From now on this tick is the present one; `mark` draws it.
    place(tick: number | null): void
    mark(): void
    // Goes on with more of the same run.
    take(run: LaneRun, drawing: LaneDrawing): void
    window(): [number, number]
  }
  export interface Heard {
    moved(start: number, end: number): void
    picked?(tick: number): void
  }
  export function explore(root: Document | ShadowRoot, run: LaneRun, drawing: LaneDrawing, heard: Heard): Explored
}

declare module '*/report/src/html/charts.js' {
  import type { LaneDrawing, LaneRun } from '*/report/src/html/draw.js'
  import type { Explored } from '*/report/src/html/explore.js'
  export function lightCharts(root: Document | ShadowRoot, run: LaneRun, drawing: LaneDrawing, explored: Explored): void
}
