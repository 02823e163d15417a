// The messages between the browser and the server: the types of what `groundstate studio` sends and takes.
//
// Owns: names and shapes of requests, answers and notifications; no behaviour. Positions are those of the Language Server
// Protocol: lines from 0, columns in UTF-16 units. Lengths are CSS pixels, to the right and down.

export interface Position {
  line: number
  character: number
}

export interface Range {
  start: Position
  end: Position
}

export interface Place {
  uri: string
  range: Range
}

export interface TextEdit {
  range: Range
  newText: string
}

export type Kind = 'model' | 'scenario' | 'chart' | 'report' | 'verification' | 'coupling'

export interface File {
  path: string
  uri: string
  kind: Kind
}

export interface Template {
  name: string
  title: string
}

export interface Hello {
  version: 1
  name: string
  root: string
  readOnly: boolean
  files: File[]
  library: File[]
  templates: Template[]
}

export interface Conflict {
  hash: string
  theirs: string
  merged: string
}

// What names a file. A place that follows can be given the file's new name.
export interface Named {
  path: string
  range: Range
  follows: boolean
}

export interface Names {
  places: Named[]
  // The folder of its C++; its own, if the user arranged it.
  program: { path: string; isOwn: boolean } | null
}

// What is known of the name of a machine in a chart. Its own places are in its head and its layout.
export interface MachineNames {
  places: { path: string; range: Range; isOwn: boolean }[]
  // The text that it shows, with the blank before it; empty where one would be.
  title: Range
  // What goes with it.
  lines: Range[]
  // Names that it cannot have.
  taken: string[]
}

export interface Renamed {
  path: string
  to: string
  uri: string
}

export type Written = { hash: string; text?: string; conflict?: undefined } | { conflict: Conflict }

export interface Changed {
  path: string
  hash: string
  text: string | null
}

export type JobKind = 'verify' | 'test' | 'build' | 'check' | 'generate' | 'review' | 'mutate' | 'graph' | 'times' | 'refine' | 'program'

// What a program does while it runs, as it wrote it.
export interface Followed {
  words: string
  time_ns: number
  phases: [task: string, phase: string | null][]
}

// Pictures of charts.

export type Figure =
  | 'circle'
  | 'composite'
  | 'hexagon'
  | 'rectangle'
  | 'block'
  | 'enter'
  | 'exit'
  | 'component'
  | 'channel'
  | 'device'

export interface Detail {
  id: string | null
  text: string
  right: string | null
}

export interface Box {
  id: string
  figure: Figure
  dashed: boolean
  initial: boolean
  lines: string[]
  details: Detail[]
  x: number
  y: number
  width: number
  height: number
  label: string
  link: string | null
  refine: null | { by: string | null }
  of: string | null
  // It is the block of a pattern that answers yes or no.
  answers?: boolean
  // The composite state that it stands in.
  within?: string | null
  // Of a composite state.
  composite?: CompositeText | null
  opens: null | { uri: string; name: string }
  range: Range | null
  nameRange: Range | null
}

// What is done whenever a composite state is entered or left.
export interface Doing {
  id: string
  when: 'entry' | 'exit'
  text: string
  link: string | null
}

export interface CompositeText {
  // It is entered where it was left; a location of the model may remember that.
  history: null | { link: string | null }
  doings: Doing[]
  // Its declaration, as it is written.
  source: string
}

export type Branch = 'yes' | 'no' | null

export interface Line {
  from: number
  to: number
  branch: Branch
  points: [number, number][]
  range: Range | null
}

export interface Label {
  of: number
  text: string
  isLink: boolean
  x: number
  y: number
  width: number
  height: number
}

export interface Picture {
  left: number
  top: number
  width: number
  height: number
  boxes: Box[]
  lines: Line[]
  labels: Label[]
}

export interface Drawing {
  name: string
  kind: 'machine' | 'pattern' | 'system'
  title: string
  link: string | null
  range: Range
  placed: boolean
  picture: Picture
  lights: Light[]
  // What the text says of a system's parts; of machines nothing.
  system?: SystemText | null
}

// A property as it is written, and where.
export interface PropertyText {
  text: string
  range: Range
}
export type Property = PropertyText | null

export interface PhaseText {
  verb: 'read' | 'elaborate' | 'write' | null
  subject: string | null
  name: Property
  time: Property
  // Of a reading: how often it brings something new.
  fresh: Property
  machine: Property
  range: Range | null
}

export interface ComponentText {
  part: 'component'
  synchronous: boolean | null
  period: Property
  jitter: Property
  offset: Property
  deadline: Property
  misses: Property
  awaits: Property
  phases: PhaseText[]
}

export interface ChannelText {
  part: 'channel'
  made: 'swinging buffer' | 'queue' | 'shared value' | null
  size: Property
  master: Property
  domain: Property
  from: string | null
  readers: string[]
}

export interface DeviceText {
  part: 'device'
  domain: Property
}

export interface SystemText {
  tick: Property
  processors: Property
  ages: { from: string | null; to: string | null; limit: Property }[]
  parts: Record<string, ComponentText | ChannelText | DeviceText>
}

// Properties of a system's parts; those with a number are of the phase or the age bound of this number.
export type PropertyName =
  | 'timing'
  | 'period'
  | 'jitter'
  | 'offset'
  | 'deadline'
  | 'misses'
  | 'awaits'
  | 'made'
  | 'size'
  | 'master'
  | 'domain'
  | 'tick'
  | 'processors'
  | 'age'
  | 'writer'
  | 'phaseSubject'
  | 'phaseTime'
  | 'phaseName'
  | 'phaseFresh'
  | 'phaseMachine'

// A term, and what is lit by its values: a box, or a line in one.
export interface Light {
  name: string
  term: string
  shapes: { value: string; shape: string }[]
}

export interface Pictures {
  version: 1
  drawings: Drawing[]
  problems: string[]
  // The text has a syntax error, so what is drawn may be what nobody wrote.
  guess?: boolean
}

// Operations on a drawing.

export type Shape = 'state' | 'composite' | 'guard' | 'action' | 'instance' | 'component' | 'channel' | 'sensor' | 'actuator'

export interface Arrow {
  from: string
  branch: Branch
  to: string
}

export interface PastedShape {
  id: string
  shape: Shape
  text: string
  link: string | null
  of: string | null
  at: [number, number]
}

// A composite state with all that it holds; places are those of the shapes in it.
export interface PastedComposite {
  id: string
  source: string
  places: Record<string, [number, number]>
}

export type Operation =
  | { kind: 'move'; places: Record<string, [number, number]> }
  | { kind: 'add'; shape: Shape; at: [number, number]; text?: string; of?: string; from?: string; to?: string }
  | ({ kind: 'connect' } & Arrow)
  | ({ kind: 'disconnect' } & Arrow)
  | ({ kind: 'redirect' } & Arrow & { new: Arrow })
  | { kind: 'delete'; ids: string[] }
  | { kind: 'rename'; id: string; name: string }
  | { kind: 'text'; id: string; text: string | null }
  | { kind: 'link'; id: string; link: string | null }
  | { kind: 'refine'; id: string; refine: null | { by: string | null } }
  | { kind: 'initial'; id: string }
  | { kind: 'nest'; ids: string[]; into: string | null; places?: Record<string, [number, number]> }
  | { kind: 'machine'; name: string; pattern: boolean; title: string }
  | { kind: 'layout' }
  | { kind: 'history'; id: string; history: null | { link: string | null } }
  | { kind: 'addDoing'; id: string; when: Doing['when']; text: string | null }
  | { kind: 'paste'; shapes: PastedShape[]; composites: PastedComposite[]; arrows: Arrow[] }
  | { kind: 'set'; id: string; property: PropertyName; at?: number; value: string | null }
  | { kind: 'addPhase'; id: string; verb: 'read' | 'elaborate' | 'write'; subject: string }
  | { kind: 'removePhase'; id: string; at: number }
  | { kind: 'movePhase'; id: string; at: number; to: number }
  | { kind: 'addAge'; from: string; to: string; limit: string }

export interface Edited {
  edits: TextEdit[]
  select: string[]
}

// Running.

export interface Update {
  location: string
  before: string
  after: string
  at: Place
}

export interface SessionFault {
  id: string
  message: string
  at: Place
  related: { text: string; at: Place }[]
}

export interface SessionState {
  version: number
  session: number
  step: number
  waiting: 'step' | 'input' | 'choice' | 'nothing'
  word: string | null
  offered: string[]
  // The ends of an input's domain that is all integers between them.
  bounds?: [number, number] | null
  at: Place | null
  state: Record<string, string> | [string, string][]
  updates: Update[]
  unchanged: Place[]
  rules: { name: string; at: Place }[]
  faults: SessionFault[]
  next: Place | null
  refused: string | null
  stale: boolean
}
