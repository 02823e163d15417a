// Colours of AsmetaL, Avalla, chart and coupling texts in the editor, by their words alone.
//
// Owns: a stream tokenizer for the four, and the styles of its tokens. What a name stands for, only the language server knows.

import { HighlightStyle, StreamLanguage, type StringStream, syntaxHighlighting } from '@codemirror/language'
import type { Extension } from '@codemirror/state'
import { tags } from '@lezer/highlight'

import type { Kind } from '../diagram/protocol'

const words = (text: string): Set<string> => new Set(text.split(/\s+/))

const LITERALS = words('true false undef self')
const CONTROL = words(
  `if then else elseif endif switch case otherwise endswitch let endlet par endpar seq endseq choose forall exist exists unique
   with do ifnone extend iterate enditerate while whilerec skip in notin and or xor not implies iff mod import load`,
)
const DECLARING = words(
  `asm module scenario export signature definitions function rule domain enum anydomain subsetof agent invariant over main
   default init macro turbo static dynamic derived monitored controlled shared out local abstract basic
   CTLSPEC LTLSPEC JUSTICE FAIRNESS COMPASSION INVAR`,
)
const SCENARIO = words('check strict set step until within exec pick begin end execblock expect')
const CHART = words(
  `chart machine endmachine pattern endpattern control initial composite state endstate history entry abort guard action instance of sequence to refine by layout
   endlayout at system endsystem tick processors within component endcomponent synchronous asynchronous period jitter offset deadline misses every fresh awaits all any read write
   elaborate as channel from swinging buffer queue shared value master sensor actuator enter exit yes no`,
)

interface State {
  comment: boolean
  braces: number
  // The line begins with a word of charts: others in it are words, too. Paths and places begin with names.
  declares: boolean
  begun: boolean
}

const COUPLING = words('abstract concrete couple same segment diagrams variant fair free input allow waiting overflow')

const STOPS = words('enter exit yes no')

// Within the braces of a link, a chart holds AsmetaL. Names may be words of charts: in a path, `read` is a name.
function chartWord(stream: StringStream, text: string, state: State): string {
  if (!state.begun) state.declares = (CHART.has(text) || text === 'import') && !stream.match(/^\s*(->|yes\b|no\b|at\b|,)/, false)
  const first = !state.begun
  state.begun = true
  if (STOPS.has(text)) return 'atom'
  if (!state.declares) return text === 'at' ? 'keyword' : 'variableName'
  if (first) return 'keyword'
  if (/(^|\s)(of|as|by|from|to|master|awaits|state|guard|action|instance|component|channel|machine|pattern|read|write|elaborate)\s+$/.test(stream.string.slice(0, stream.start)))
    return text === 'refine' ? 'keyword' : 'variableName'
  return CHART.has(text) ? 'keyword' : 'variableName'
}

function word(stream: StringStream, text: string, kind: Kind, state: State): string | null {
  if (kind === 'chart' && state.braces === 0) return chartWord(stream, text, state)
  if (LITERALS.has(text)) return 'atom'
  if (kind === 'coupling' && COUPLING.has(text)) return 'keyword'
  if (CONTROL.has(text) || DECLARING.has(text)) return 'keyword'
  if (kind === 'scenario' && SCENARIO.has(text)) return 'keyword'
  if (/^(r|inv|ctlSpec|ltlSpec)_/.test(text)) return 'labelName'
  if (/^[A-Z]{2}[A-Z0-9_]*$/.test(text)) return 'atom'
  if (/^[A-Z]/.test(text)) return 'typeName'
  return 'variableName'
}

function token(stream: StringStream, state: State, kind: Kind): string | null {
  if (state.comment) {
    if (stream.match(/^.*?\*\//)) state.comment = false
    else stream.skipToEnd()
    return 'comment'
  }
  if (stream.eatSpace()) return null
  if (stream.match('//')) {
    stream.skipToEnd()
    return 'comment'
  }
  if (stream.match('/*')) {
    state.comment = true
    return 'comment'
  }
  if (stream.match(/^"(\\.|[^"\\])*"?/)) return 'string'
  if (stream.match(/^\$[A-Za-z_]\w*/)) return 'dollar'
  if (stream.match(/^\d+(\.\d+)?n?/)) return 'number'
  const name = stream.match(/^[A-Za-z_]\w*/) as RegExpMatchArray | null
  if (name) return word(stream, name[0], kind, state)
  if (stream.match(/^(:=|<-|->|!=|<=|>=|[=<>+*/^-])/)) return 'operator'
  const letter = stream.next()
  if (letter === '{') state.braces++
  if (letter === '}') state.braces = Math.max(0, state.braces - 1)
  return letter && '{}[]()'.includes(letter) ? 'bracket' : null
}

function language(kind: Kind): StreamLanguage<State> {
  return StreamLanguage.define<State>({
    name: kind,
    startState: () => ({ comment: false, braces: 0, declares: false, begun: false }),
    copyState: (state) => ({ ...state }),
    token: (stream, state) => {
      // Braces do not reach over lines in charts, and elsewhere they have no meaning here.
      if (stream.sol()) {
        state.braces = 0
        state.begun = false
      }
      return token(stream, state, kind)
    },
    tokenTable: { dollar: tags.special(tags.variableName) },
    languageData: { commentTokens: { line: '//', block: { open: '/*', close: '*/' } } },
  })
}

const LANGUAGES = { model: language('model'), scenario: language('scenario'), chart: language('chart'), coupling: language('coupling') }

const STYLE = HighlightStyle.define([
  { tag: tags.keyword, color: 'var(--code-keyword)' },
  { tag: tags.comment, color: 'var(--faint)', fontStyle: 'italic' },
  { tag: tags.string, color: 'var(--code-string)' },
  { tag: tags.number, color: 'var(--code-number)' },
  { tag: tags.atom, color: 'var(--code-atom)' },
  { tag: tags.typeName, color: 'var(--code-type)' },
  { tag: tags.labelName, color: 'var(--code-rule)' },
  { tag: tags.special(tags.variableName), color: 'var(--code-variable)' },
  { tag: tags.operator, color: 'var(--soft)' },
  { tag: tags.bracket, color: 'var(--soft)' },
])

export const styles: Extension = syntaxHighlighting(STYLE)

export function coloured(kind: Kind): Extension {
  const known = kind === 'report' || kind === 'verification' ? null : LANGUAGES[kind]
  return [known ?? [], styles]
}

// What the language client calls it.
export const languageId = (kind: Kind): string =>
  kind === 'chart' ? 'groundstate-chart' : kind === 'scenario' ? 'avalla' : kind === 'model' ? 'asmetal' : 'yaml'
