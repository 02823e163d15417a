// Controls for inputs: sliders for integers between two bounds, and files of recorded inputs.
//
// In: the bounds that the engine told. Out: values as AsmetaL writes them. What a file of inputs means, the engine decides.

import { type ReactNode, useEffect, useRef, useState } from 'react'

import type { File } from '../diagram/protocol'
import { words } from '../words'
import type { RecordedInputs } from './run'
import type { Studio } from './studio'

// With fewer values, a button for each is quicker.
export const SLIDES = 6

export const slides = (bounds: [number, number] | null | undefined): boolean => !!bounds && bounds[1] - bounds[0] >= SLIDES

interface SliderProps {
  location: string
  value: number
  bounds: [number, number]
  done: (value: number) => void
  moved?: (value: number) => void
}

// A slider and a field for the same number. It is given when the slider is let go of, or the field is left.
export function Slider({ location, value, bounds: [least, most], done, moved }: SliderProps): ReactNode {
  const [now, setNow] = useState(value)
  const range = useRef<HTMLInputElement>(null)
  const [given, telling] = [useRef(value), useRef(done)]
  given.current = value
  telling.current = done
  useEffect(() => setNow(value), [value])
  // React's own event comes with each movement.
  useEffect(() => {
    const input = range.current
    const change = (): void => {
      const next = Number(input?.value)
      if (next !== given.current) telling.current(next)
    }
    input?.addEventListener('change', change)
    return () => input?.removeEventListener('change', change)
  }, [])
  const move = (next: number): void => {
    setNow(next)
    moved?.(next)
  }
  const leave = (): void => {
    const next = Math.min(most, Math.max(least, Math.round(now)))
    move(next)
    if (next !== value) done(next)
  }
  return (
    <span className="slider">
      <input ref={range} type="range" min={least} max={most} step={1} value={now} aria-label={location} onChange={(event) => move(Number(event.target.value))} />
      <input
        type="number"
        className="mono"
        min={least}
        max={most}
        value={now}
        aria-label={`${location}, ${words.run.value}`}
        onChange={(event) => move(Number(event.target.value))}
        onBlur={leave}
        onKeyDown={(event) => event.key === 'Enter' && leave()}
      />
    </span>
  )
}

// An integer that a step waits for.
export function AskedNumber({ location, bounds, give }: { location: string; bounds: [number, number]; give: (value: string) => void }): ReactNode {
  const [value, setValue] = useState(Math.min(bounds[1], Math.max(bounds[0], 0)))
  return (
    <div className="row">
      <Slider location={location} value={value} bounds={bounds} done={setValue} moved={setValue} />
      <button type="button" onClick={() => give(String(value))}>
        {words.run.give}
      </button>
    </div>
  )
}

// A run that takes its inputs from a file beside the model.
export function RecordedStart({ studio, file, busy, begin }: { studio: Studio; file: File; busy: boolean; begin: (inputs: RecordedInputs) => void }): ReactNode {
  const [files, setFiles] = useState<string[]>([])
  const [chosen, setChosen] = useState('')
  useEffect(() => {
    let gone = false
    studio.server
      .request<{ files: string[] }>('studio/inputs', { path: file.path })
      .then(({ files }) => !gone && setFiles(files))
      // An exported project has none.
      .catch(() => undefined)
    return () => {
      gone = true
    }
  }, [studio, file.path])
  const wanted = files.includes(chosen) ? chosen : (files[0] ?? null)
  if (wanted === null) return null
  const name = (path: string): string => path.split('/').at(-1) ?? path
  const start = async (): Promise<void> => {
    const inputs = await studio.runner.inputs(wanted)
    if (inputs) begin(inputs)
  }
  return (
    <span className="row">
      <button disabled={busy} onClick={() => void start()}>
        {words.run.withInputs} {files.length === 1 ? name(wanted) : ''}
      </button>
      {files.length > 1 && (
        <select aria-label={words.run.chooseInputs} value={wanted} onChange={(event) => setChosen(event.target.value)}>
          {files.map((path) => (
            <option key={path} value={path}>
              {name(path)}
            </option>
          ))}
        </select>
      )}
    </span>
  )
}
