// The C++ beside a chart or a model: which files there are, whether they are current, which one is shown, and its lines ↔ the model's.
//
// Owns: the list of the file in front, the text that is shown, the lines that are marked. It asks again when a text is saved, when a job
// has ended, and when another file is in front. INVARIANT: what is shown says whether it is of the texts as they are now.

import type { Position } from '../diagram/protocol'
import { type GeneratedLine, type MappedLine, generatedFor, modelFor } from '../diagram/sourcemap'
import { Store } from './store'
import type { Studio } from './studio'

export interface Generated {
  folder: string
  files: string[]
  lines: MappedLine[]
  state: 'none' | 'current' | 'older' | 'unknown'
  // The texts that are others now.
  changed: string[]
}

export interface CodeState {
  // Of which file it is.
  uri: string | null
  generated: Generated | null
  refused: string | null
  file: string | null
  text: string
  // Lines that stand for what is selected in the model.
  marked: number[]
  // Counts selections in the model, so that the view scrolls to them.
  revealed: number
}

const AFTER_MS = 500

const NONE: CodeState = { uri: null, generated: null, refused: null, file: null, text: '', marked: [], revealed: 0 }

export class Code {
  readonly store = new Store<CodeState>(NONE)
  private asked = 0
  private timer: ReturnType<typeof setTimeout> | undefined

  constructor(private readonly studio: Studio) {
    studio.server.on('studio/changed', () => this.later())
  }

  // Looks again when the texts have come to rest.
  later(): void {
    clearTimeout(this.timer)
    this.timer = setTimeout(() => {
      if (this.studio.store.get().panel === 'code') void this.look(this.studio.store.get().active)
    }, AFTER_MS)
  }

  private path(uri: string): string | null {
    const file = this.studio.file(uri)
    return file && !this.studio.isLibrary(uri) && (file.kind === 'chart' || file.kind === 'model') ? file.path : null
  }

  // Looks at what lies beside a file, also again.
  async look(uri: string | null): Promise<void> {
    const path = uri === null ? null : this.path(uri)
    const before = this.store.get()
    const number = ++this.asked
    if (uri === null || path === null) return this.store.set(NONE)
    try {
      const generated = await this.studio.server.request<Generated>('studio/generated', { path })
      if (number !== this.asked) return
      const same = before.uri === uri
      const kept = same && before.file !== null && generated.files.includes(before.file) ? before.file : this.first(generated)
      this.store.set({ uri, generated, refused: null, ...(same ? {} : { marked: [] }) })
      await this.open(kept)
    } catch (error) {
      if (number === this.asked) this.store.set({ ...NONE, uri, refused: (error as Error).message })
    }
  }

  // The file that most lines of the model lead to.
  private first({ files, lines }: Generated): string | null {
    const counts = new Map<string, number>()
    for (const { file } of lines) counts.set(file, (counts.get(file) ?? 0) + 1)
    const ranked = files.filter((file) => counts.has(file)).sort((a, b) => (counts.get(b) ?? 0) - (counts.get(a) ?? 0))
    return ranked[0] ?? files.find((file) => /\.(hpp|cpp)$/.test(file)) ?? files[0] ?? null
  }

  async open(file: string | null): Promise<void> {
    const { uri } = this.store.get()
    const path = uri === null ? null : this.path(uri)
    if (file === null || path === null) return this.store.set({ file: null, text: '', marked: [] })
    try {
      const { text } = await this.studio.server.request<{ text: string }>('studio/generated', { path, file })
      if (this.store.get().uri !== uri) return
      const { file: before, marked } = this.store.get()
      this.store.set({ file, text, marked: before === file ? marked : [] })
    } catch (error) {
      this.store.set({ file, text: '', marked: [], refused: (error as Error).message })
    }
  }

  // What is selected in a text of the model: its lines are marked, in the file that is shown if it has some.
  async select(uri: string, at: Position): Promise<void> {
    const { generated, file } = this.store.get()
    const model = this.studio.file(uri)?.path
    if (!generated || model === undefined) return
    const found: GeneratedLine[] = generatedFor(generated.lines, model, at).filter((line) => generated.files.includes(line.file))
    const to = found.some((line) => line.file === file) ? file : (found[0]?.file ?? file)
    if (to !== file) await this.open(to)
    if (this.store.get().file !== to) return
    const marked = found.filter((line) => line.file === to).map(({ line }) => line)
    this.store.set((state) => ({ marked, revealed: state.revealed + (marked.length > 0 ? 1 : 0) }))
  }

  // A line of C++: the place that it stands for comes before the eyes.
  async lead(line: number): Promise<void> {
    const { generated, file, text } = this.store.get()
    if (!generated || file === null) return
    const place = modelFor(generated.lines, file, line, text.split('\n'))
    const to = place && this.studio.fileAt(place.model)
    if (!place || !to) return
    await this.studio.show({ uri: to.uri, range: place.range }, false)
    this.studio.chart(to.uri)?.cursor(place.range.start)
  }
}
