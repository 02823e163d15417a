// What a session tells (docs/editors.md, "How does an editor run a model?"), as sections of a view and as notes at lines.
//
// In: the answer to a request of a session. Out: rows and notes. It must not know VS Code.

export interface Position {
  line: number;
  character: number;
}

export interface Place {
  uri: string;
  range: { start: Position; end: Position };
}

export interface SessionState {
  version: number;
  session: number;
  step: number;
  waiting: "step" | "input" | "choice" | "nothing";
  word: string | null;
  offered: string[];
  at: Place | null;
  state: Record<string, string>;
  updates: { location: string; before: string; after: string; at: Place }[];
  unchanged: Place[];
  rules: { name: string; at: Place }[];
  faults: { id: string; message: string; at: Place; related: { text: string; at: Place }[] }[];
  next: Place | null;
  refused: string | null;
  stale: boolean;
}

// The version of the requests that this extension speaks.
export const VERSION = 1;

export type RowKind = "location" | "update" | "rule" | "fault" | "offer" | "text";

export interface Row {
  kind: RowKind;
  label: string;
  detail: string;
  at?: Place;
  // Of an offer: its number.
  index?: number;
}

export interface Section {
  title: string;
  rows: Row[];
}

// What a session waits for, in a sentence.
export function headline(state: SessionState): string {
  const made = `step ${state.step}`;
  switch (state.waiting) {
    case "input":
      return `${made}: ${state.word} is asked for`;
    case "choice":
      return `${made}: a choice is asked for`;
    case "nothing":
      return `${made}: the run has ended (${state.word ?? ""})`;
    default:
      return made;
  }
}

export function sections(state: SessionState): Section[] {
  const all: Section[] = [];
  const add = (title: string, rows: Row[]) => {
    if (rows.length) all.push({ title, rows });
  };
  const faults = state.faults.flatMap((fault): Row[] => [
    { kind: "fault", label: fault.message, detail: fault.id, at: fault.at },
    ...fault.related.map((one): Row => ({ kind: "fault", label: one.text, detail: "", at: one.at })),
  ]);
  add("Wrong", faults);
  const asked = state.waiting === "input" ? `${state.word} is` : "Choose";
  add(asked, state.offered.map((label, index): Row => ({ kind: "offer", label, detail: "", index, ...(state.at ? { at: state.at } : {}) })));
  add(
    "Last updates",
    state.updates.map((one): Row => ({ kind: "update", label: one.location, detail: `${one.before} → ${one.after}`, at: one.at })),
  );
  add("Rules that ran", state.rules.map((one): Row => ({ kind: "rule", label: one.name, detail: "", at: one.at })));
  add("State", Object.entries(state.state).map(([label, detail]): Row => ({ kind: "location", label, detail })));
  return all;
}

export interface Note {
  uri: string;
  line: number;
  text: string;
  kind: "update" | "unchanged" | "fault" | "next";
}

const MANY = 200;

// What is shown at the end of lines: of a line, a fault hides what else it has, and updates hide that one changed nothing.
export function notes(state: SessionState): Note[] {
  const at = new Map<string, Note>();
  const rank = { next: 0, unchanged: 1, update: 2, fault: 3 };
  const add = (place: Place, text: string, kind: Note["kind"]) => {
    const line = place.range.start.line;
    const key = `${place.uri}:${line}`;
    const known = at.get(key);
    if (known && rank[known.kind] > rank[kind]) return;
    if (known && known.kind === kind && known.text !== text) {
      if (known.text.length < MANY) known.text += `, ${text}`;
      return;
    }
    if (at.size < MANY || known) at.set(key, { uri: place.uri, line, text, kind });
  };
  if (state.next) add(state.next, "next", "next");
  state.unchanged.forEach((place) => add(place, "as it was", "unchanged"));
  state.updates.forEach((one) => add(one.at, `${one.location}: ${one.before} → ${one.after}`, "update"));
  for (const fault of state.faults) {
    add(fault.at, fault.message, "fault");
    fault.related.forEach((one) => add(one.at, one.text, "fault"));
  }
  return [...at.values()];
}

export type Send = (method: string, params: object) => Promise<unknown>;

// A session, by its requests. Requests are made one after the other.
export class Session {
  private last: Promise<unknown> = Promise.resolve();
  state: SessionState | undefined;

  constructor(private readonly send: Send) {}

  async open(uri: string, seed?: number): Promise<SessionState> {
    return this.request("open", { textDocument: { uri }, ...(seed === undefined ? {} : { seed }) });
  }

  request(method: string, params: object = {}): Promise<SessionState> {
    const made = this.last.then(async () => {
      const session = this.state && method !== "open" ? { session: this.state.session } : {};
      const state = (await this.send(`groundstate/session/${method}`, { ...session, ...params })) as SessionState;
      if (state && state.version !== VERSION) {
        throw new Error(`groundstate speaks version ${state.version} of sessions, the extension version ${VERSION}`);
      }
      this.state = state ?? undefined;
      return state;
    });
    this.last = made.catch(() => undefined);
    return made;
  }

  async close(): Promise<void> {
    if (this.state) await this.request("close").catch(() => undefined);
    this.state = undefined;
  }
}
