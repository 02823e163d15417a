// The properties of what is selected: name, text, link, refinement, initial state, pattern; an arrow's ends.
//
// In: the drawing and the selection. Out: operations, renamings. It shows nothing while nothing is selected.

import { type ReactNode, useEffect, useId, useState } from 'react'

import { arrowOf, frames } from '../diagram/gestures'
import { faultsOn } from '../diagram/pick'
import type { Box, Drawing, Operation } from '../diagram/protocol'
import { words } from '../words'
import type { Chart } from './chart'
import { CompositeFields } from './CompositeFields'
import { Switch, TextField } from './Field'
import { Icon } from './icons'
import { deleteSelected } from './keys'
import { linkOffers } from './offers'
import { Told, useOperation } from './operating'
import { breakTerm } from './shown'
import { useStore } from './store'
import type { Studio } from './studio'
import { SystemFields } from './SystemFields'

const WIDTH = 236
const HEIGHT = 480

export function Inspector({ studio, chart }: { studio: Studio; chart: Chart }): ReactNode {
  const drawing = useStore(chart.store, () => chart.drawing)
  const selection = useStore(chart.store, (state) => state.selection)
  const [folded, setFolded] = useState(false)
  // A shape that is renamed keeps its fields, and what is being typed in them.
  const [renamed, setRenamed] = useState<{ from: string; to: string } | null>(null)
  // It does not lie on the shape that it speaks of.
  const [aside, setAside] = useState(false)
  const id = selection.boxes.length === 1 ? selection.boxes[0] : undefined
  useEffect(() => {
    // A shape that was just made is on the page a little later.
    const look = (): void => {
      const node = id === undefined ? null : document.querySelector(`.react-flow__node[data-id="${CSS.escape(id)}"]`)
      const pane = node?.closest('.picture-pane')
      if (!node || !pane) return setAside(false)
      const [shape, whole] = [node.getBoundingClientRect(), pane.getBoundingClientRect()]
      const covered = shape.right > whole.right - WIDTH - 20 && shape.top < whole.top + HEIGHT
      setAside(covered && shape.left > whole.left + WIDTH + 90)
    }
    look()
    const timer = setTimeout(look, 60)
    return () => clearTimeout(timer)
  }, [id])
  if (!drawing || (selection.boxes.length === 0 && selection.lines.length === 0)) return null
  const boxes = drawing.picture.boxes.filter((box) => selection.boxes.includes(box.id))
  const [box] = boxes
  const title = boxes.length > 1 ? words.inspector.several(boxes.length) : box ? words.spoken.figure[box.figure] : words.inspector.arrow
  return (
    <aside className={`inspector${folded ? ' folded' : ''}${aside ? ' aside' : ''}`} aria-label={words.inspector.label}>
      <header>
        <h2>{title}</h2>
        {!chart.doc.readOnly && (
          <button className="quiet" title={words.inspector.delete} aria-label={words.inspector.delete} onClick={() => deleteSelected(chart)}>
            <Icon name="trash" />
          </button>
        )}
        <button
          className="quiet"
          title={folded ? words.inspector.unfold : words.inspector.fold}
          aria-label={folded ? words.inspector.unfold : words.inspector.fold}
          aria-expanded={!folded}
          onClick={() => setFolded(!folded)}
        >
          <span className={`turn${folded ? '' : ' open'}`}>
            <Icon name="chevron" size={14} />
          </span>
        </button>
      </header>
      {!folded && boxes.length === 1 && box && (
        <OneBox
          key={renamed?.to === box.id ? renamed.from : box.id}
          studio={studio}
          chart={chart}
          drawing={drawing}
          box={box}
          naming={(to) => setRenamed((old) => ({ from: old?.to === box.id ? old.from : box.id, to }))}
        />
      )}
      {!folded && boxes.length === 0 && <OneLine drawing={drawing} index={selection.lines[0] ?? -1} />}
    </aside>
  )
}

interface OneBoxProps {
  studio: Studio
  chart: Chart
  drawing: Drawing
  box: Box
  naming: (name: string) => void
}

function OneBox({ studio, chart, drawing, box, naming }: OneBoxProps): ReactNode {
  const readOnly = chart.doc.readOnly
  const faults = useStore(studio.store, (state) => state.faults.get(chart.doc.file.uri))
  const breaks = useStore(studio.runner.store, (state) => state.breaks)
  const fault = faults ? faultsOn(drawing, faults).get(box.id) : undefined
  const term = breakTerm(drawing, box.id)
  const ends = box.figure === 'enter' || box.figure === 'exit'
  const system = drawing.kind === 'system'
  const links = !system && !ends && box.figure !== 'composite'
  const acting = useOperation({ chart })
  const rename = (name: string): Promise<boolean> => {
    naming(name)
    return acting.act('name', { kind: 'rename', id: box.id, name }, { select: true })
  }
  const set = (operation: Operation): Promise<boolean> => acting.act(operation.kind, operation)
  const told = (key: string): ReactNode => <Told reason={acting.refused.get(key) ?? null} />
  return (
    <div className="fields">
      {fault && (
        <p className={`fault-note ${fault.severity}`} role="alert">
          {fault.message}
        </p>
      )}
      {!ends && (
        <div className="property">
          <TextField name="name" label={words.inspector.name} value={box.id} mono readOnly={readOnly || !box.nameRange} commit={rename} />
          {told('name')}
        </div>
      )}
      {!ends && box.figure !== 'channel' && (
        <div className="property">
          <TextField
            name="text"
            label={words.inspector.text}
            value={box.label}
            placeholder={box.figure === 'block' ? '' : box.lines.join(' ')}
            readOnly={readOnly}
            commit={(text) => set({ kind: 'text', id: box.id, text: text === '' ? null : text })}
          />
          {told('text')}
        </div>
      )}
      {links && (
        <div className="property">
          <LinkField studio={studio} chart={chart} drawing={drawing} box={box} readOnly={readOnly} commit={(link) => set({ kind: 'link', id: box.id, link: link === '' ? null : link })} />
          {told('link')}
        </div>
      )}
      {(box.figure === 'circle' || box.figure === 'composite') && (
        <Switch
          label={words.inspector.initial}
          on={box.initial}
          disabled={readOnly || box.initial || drawing.kind === 'pattern'}
          flip={() => void set({ kind: 'initial', id: box.id })}
        />
      )}
      {told('initial')}
      {!system && !ends && box.nameRange && (box.within || frames(drawing, box).length > 0) && (
        <Within chart={chart} drawing={drawing} box={box} readOnly={readOnly} />
      )}
      {box.composite && <CompositeFields chart={chart} id={box.id} composite={box.composite} />}
      {(box.figure === 'hexagon' || box.figure === 'rectangle') && (
        <>
          <Switch
            label={words.inspector.refine}
            on={box.refine !== null}
            disabled={readOnly}
            flip={() => void set({ kind: 'refine', id: box.id, refine: box.refine ? null : { by: null } })}
          />
          {box.refine && (
            <TextField
              name="by"
              label={words.inspector.refineBy}
              value={box.refine.by ?? ''}
              placeholder={words.inspector.refineByHint}
              mono
              readOnly={readOnly}
              commit={(by) => set({ kind: 'refine', id: box.id, refine: { by: by === '' ? null : by } })}
            />
          )}
          {told('refine')}
        </>
      )}
      {box.of !== null && (
        <div className="pair">
          <span className="key">{words.inspector.pattern}</span>
          <code>{box.of}</code>
          {box.opens && (
            <button className="small" onClick={() => box.opens && void studio.enter(box.opens.uri, box.opens.name)}>
              {words.inspector.open}
            </button>
          )}
        </div>
      )}
      {box.of === null && box.opens && (
        <div className="pair">
          <span className="key">{words.system.machine}</span>
          <code>{box.opens.name}</code>
          <button className="small" onClick={() => box.opens && void studio.enter(box.opens.uri, box.opens.name)}>
            {words.inspector.open}
          </button>
        </div>
      )}
      {system && drawing.system && <SystemFields key={box.id} studio={studio} chart={chart} id={box.id} system={drawing.system} />}
      {box.details.length > 0 && system && !drawing.system && (
        <div className="details">
          <span className="key">{words.inspector.details}</span>
          <ul>
            {box.details.map((detail, index) => (
              <li key={index}>
                <span>{detail.text}</span>
                <span className="right">{detail.right}</span>
              </li>
            ))}
          </ul>
        </div>
      )}
      {term !== null && (
        <Switch label={words.inspector.breakpoint} on={breaks.includes(term)} disabled={false} flip={() => studio.runner.toggleBreak(term)} />
      )}
      {box.range && (
        <button className="small wide" onClick={() => box.range && void studio.open(chart.doc.file.uri, { range: box.range })}>
          <Icon name="text" size={14} />
          {words.inspector.inText}
        </button>
      )}
    </div>
  )
}

// The composite state that a shape stands in.
function Within({ chart, drawing, box, readOnly }: { chart: Chart; drawing: Drawing; box: Box; readOnly: boolean }): ReactNode {
  const id = useId()
  return (
    <div className="field">
      <label htmlFor={id}>{words.inspector.within}</label>
      <select
        id={id}
        value={box.within ?? ''}
        disabled={readOnly}
        onChange={(event) => void chart.operate({ kind: 'nest', ids: [box.id], into: event.target.value === '' ? null : event.target.value })}
      >
        <option value="">{words.inspector.withinNone}</option>
        {frames(drawing, box).map((frame) => (
          <option key={frame} value={frame}>
            {frame}
          </option>
        ))}
      </select>
    </div>
  )
}

function OneLine({ drawing, index }: { drawing: Drawing; index: number }): ReactNode {
  const line = drawing.picture.lines[index]
  const arrow = line && arrowOf(drawing, line)
  if (!arrow) return null
  return (
    <div className="fields">
      <div className="pair">
        <span className="key">{words.inspector.from}</span>
        <code>{arrow.from}</code>
      </div>
      {arrow.branch && (
        <div className="pair">
          <span className="key">{words.inspector.branch}</span>
          <code>{arrow.branch}</code>
        </div>
      )}
      <div className="pair">
        <span className="key">{words.inspector.to}</span>
        <code>{arrow.to}</code>
      </div>
    </div>
  )
}

function LinkField({ studio, chart, drawing, box, readOnly, commit }: { studio: Studio; chart: Chart; drawing: Drawing; box: Box; readOnly: boolean; commit: (link: string) => Promise<boolean> }): ReactNode {
  const [offers, setOffers] = useState<string[]>([])
  const id = useId()
  // What it stands for without a link of its own, as the picture says it.
  const shown = drawing.picture.labels.find((label) => label.isLink && drawing.picture.boxes[label.of] === box)
  const given = shown?.text.replace(/^\{|\}$/g, '') ?? ''
  return (
    <>
      <TextField
        name="link"
        label={words.inspector.link}
        value={box.link ?? ''}
        placeholder={given || words.inspector.linkHint[box.figure] || ''}
        mono
        readOnly={readOnly}
        list={id}
        commit={commit}
        focused={() => void linkOffers(studio, chart, box).then(setOffers)}
      />
      <datalist id={id}>
        {offers.map((offer) => (
          <option key={offer} value={offer} />
        ))}
      </datalist>
    </>
  )
}
