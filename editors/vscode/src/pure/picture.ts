// A chart's drawings, as `groundstate/chart/picture` answers: which shape the cursor is in, which text a shape is, which shapes a
// state lights.
//
// In: the answer, positions, the values of locations. Out: shapes and ranges. A range is null where the text of this file has no such
// thing: what is imported is not lit by the cursor. It must not know VS Code.

export interface Position {
  line: number;
  character: number;
}

export interface Range {
  start: Position;
  end: Position;
}

export interface Box {
  id: string;
  figure: string;
  label: string;
  x: number;
  y: number;
  width: number;
  height: number;
  range: Range | null;
  nameRange: Range | null;
}

export interface Line {
  from: number;
  to: number;
  points: [number, number][];
  range: Range | null;
}

export interface Lights {
  term: string;
  shapes: { value: string; shape: string }[];
}

export interface Drawing {
  name: string;
  kind: string;
  title: string;
  range: Range | null;
  svg: string;
  picture: { left: number; top: number; width: number; height: number; boxes: Box[]; lines: Line[] };
  lights: Lights[];
}

export interface Answer {
  version: number;
  problems: string[];
  drawings: Drawing[];
}

// The version of the request that this extension speaks.
export const VERSION = 1;

// A part of a picture: a shape by its id, or an arrow by its number.
export interface Part {
  drawing: string;
  shape?: string;
  line?: number;
}

const before = (a: Position, b: Position) => a.line < b.line || (a.line === b.line && a.character <= b.character);

const holds = (range: Range | null, at: Position): range is Range =>
  range !== null && before(range.start, at) && before(at, range.end);

// A place as large as its text is long; inner ones are smaller.
const extent = ({ start, end }: Range) => (end.line - start.line) * 10_000 + end.character - start.character;

// The innermost shape or arrow that a place of the text is in, in each drawing that it is in.
export function partsAt(drawings: Drawing[], at: Position): Part[] {
  const found: Part[] = [];
  for (const { name, picture } of drawings) {
    let best: { part: Part; size: number } | undefined;
    const consider = (part: Part, range: Range | null) => {
      if (!holds(range, at)) return;
      const size = extent(range);
      if (!best || size < best.size) best = { part, size };
    };
    for (const { id, range } of picture.boxes) consider({ drawing: name, shape: id }, range);
    picture.lines.forEach(({ range }, line) => consider({ drawing: name, line }, range));
    if (best) found.push(best.part);
  }
  return found;
}

// The text of a shape, by its name if it has one, or of an arrow.
export function textOf(drawings: Drawing[], part: Part): Range | null {
  const picture = drawings.find(({ name }) => name === part.drawing)?.picture;
  if (!picture) return null;
  if (part.line !== undefined) return picture.lines[part.line]?.range ?? null;
  const box = picture.boxes.find(({ id }) => id === part.shape);
  return box ? (box.nameRange ?? box.range) : null;
}

// The values of locations: of `mode`, of `mode(crane1)`.
export type State = ReadonlyMap<string, string>;

// The function of a location or a term: `arm` of `arm(crane1)`.
export const functionOf = (term: string): string => /^\s*([A-Za-z_]\w*)/.exec(term)?.[1] ?? "";

const compact = (text: string): string => text.replace(/\s+/g, "");

// Whether a location is what a term stands for: the same function, and the same arguments unless the term has variables.
function isOf(location: string, term: string): boolean {
  if (functionOf(location) !== functionOf(term)) return false;
  return term.includes("$") || /\(.*\(/.test(term) || compact(location) === compact(term);
}

export interface Lit extends Part {
  // The agents in it, if the machine has any.
  agents: string[];
}

// The shapes that a state lights.
export function lit(drawings: Drawing[], state: State): Lit[] {
  const found = new Map<string, Lit>();
  for (const drawing of drawings) {
    for (const { term, shapes } of drawing.lights) {
      const byValue = new Map(shapes.map(({ value, shape }) => [value, shape]));
      for (const [location, value] of state) {
        const shape = byValue.get(value);
        if (shape === undefined || !isOf(location, term)) continue;
        const key = `${drawing.name}\n${shape}`;
        const known = found.get(key) ?? { drawing: drawing.name, shape, agents: [] };
        const agent = drawing.kind === "system" ? "" : (/^[^(]*\((.*)\)\s*$/.exec(location)?.[1] ?? "");
        if (agent && !known.agents.includes(agent)) known.agents.push(agent);
        found.set(key, known);
      }
    }
  }
  return [...found.values()];
}

// The functions that light something.
export function functionsOf(drawings: Drawing[]): Set<string> {
  return new Set(drawings.flatMap(({ lights }) => lights.map(({ term }) => functionOf(term))).filter(Boolean));
}

// What the page draws of a drawing: the picture as an image, and where its parts are.
export interface Shown {
  name: string;
  image: string;
  view: [number, number, number, number];
  boxes: { id: string; figure: string; label: string; x: number; y: number; width: number; height: number; hasText: boolean }[];
  lines: { points: [number, number][]; hasText: boolean }[];
}

export function shown(drawing: Drawing): Shown {
  const { left, top, width, height, boxes, lines } = drawing.picture;
  return {
    name: drawing.name,
    image: `data:image/svg+xml;base64,${Buffer.from(drawing.svg).toString("base64")}`,
    view: [left, top, Math.ceil(width), Math.ceil(height)],
    boxes: boxes.map(({ id, figure, label, x, y, width, height, range }) => {
      return { id, figure, label, x, y, width, height, hasText: range !== null };
    }),
    lines: lines.map(({ points, range }) => ({ points, hasText: range !== null })),
  };
}
