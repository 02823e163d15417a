// Colours of C++ in the reader, by its words alone.

import { StreamLanguage } from '@codemirror/language'

import { styles } from './language'

const KEYWORDS = new Set(
  `alignas auto bool break case catch char char32_t class const constexpr continue default delete do double else enum explicit extern
   false final for friend if inline int long mutable namespace new noexcept nullptr operator override private protected public return
   short signed sizeof static struct switch template this throw true try typedef typename union unsigned using virtual void volatile while`
    .split(/\s+/),
)

interface State {
  comment: boolean
}

const language = StreamLanguage.define<State>({
  name: 'cpp',
  startState: () => ({ comment: false }),
  token: (stream, state) => {
    if (state.comment) {
      if (stream.match(/^.*?\*\//)) state.comment = false
      else stream.skipToEnd()
      return 'comment'
    }
    if (stream.sol() && stream.match(/^\s*#\s*\w+/)) {
      if (stream.match(/^\s*[<"][^>"]*[>"]/)) return 'labelName'
      return 'labelName'
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
    if (stream.match(/^"(\\.|[^"\\])*"?/) || stream.match(/^'(\\.|[^'\\])*'?/)) return 'string'
    if (stream.match(/^\d[\w.']*/)) return 'number'
    const name = stream.match(/^[A-Za-z_]\w*/) as RegExpMatchArray | null
    if (name) return KEYWORDS.has(name[0]) ? 'keyword' : /^[A-Z][A-Z0-9_]+$/.test(name[0]) ? 'atom' : /^[A-Z]/.test(name[0]) ? 'typeName' : 'variableName'
    if (stream.match(/^(::|->|[=<>+*/^&|!-]+)/)) return 'operator'
    const letter = stream.next()
    return letter && '{}[]()'.includes(letter) ? 'bracket' : null
  },
})

export const cpp = [language, styles]
