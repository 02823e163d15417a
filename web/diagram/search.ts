// Finding by a few letters: names whose letters hold those of the question in its order.
//
// In: a question and texts. Out: a score, higher is better, and which letters were met; null if it does not fit.

export interface Match {
  score: number
  at: number[]
}

const begins = (text: string, index: number): boolean => {
  const before = text[index - 1]
  if (before === undefined || /[^A-Za-z0-9]/.test(before)) return true
  return /[a-z0-9]/.test(before) && /[A-Z]/.test(text[index] ?? '')
}

export function match(question: string, text: string): Match | null {
  const wanted = question.toLowerCase().replace(/\s+/g, '')
  if (wanted === '') return { score: 0, at: [] }
  const lower = text.toLowerCase()
  // As it is typed, with the blanks between its words, or without.
  for (const part of [question.trim().toLowerCase(), wanted]) {
    const whole = lower.indexOf(part)
    if (whole < 0) continue
    const at = Array.from(part, (_, index) => whole + index)
    return { score: 1000 + (begins(text, whole) ? 200 : 0) - whole - text.length / 10, at }
  }
  // What is taken at the beginning of a word may leave too few letters for the rest.
  return scattered(wanted, text, true) ?? scattered(wanted, text, false)
}

function scattered(wanted: string, text: string, prefersWords: boolean): Match | null {
  const lower = text.toLowerCase()
  const at: number[] = []
  let score = 0
  let from = 0
  for (const letter of wanted) {
    let found = -1
    // The beginning of a word is preferred to the next letter.
    for (let index = lower.indexOf(letter, from); index >= 0; index = lower.indexOf(letter, index + 1)) {
      if (found < 0) found = index
      if (begins(text, index)) {
        found = index
        break
      }
      if (!prefersWords || index - from > 40) break
    }
    if (found < 0) return null
    score += begins(text, found) ? 20 : 5
    if (at.at(-1) === found - 1) score += 10
    at.push(found)
    from = found + 1
  }
  return { score: score - text.length / 10, at }
}

export interface Found<T> {
  item: T
  match: Match
}

export function search<T>(question: string, items: readonly T[], text: (item: T) => string, limit = 40): Found<T>[] {
  const found: Found<T>[] = []
  for (const item of items) {
    const fits = match(question, text(item))
    if (fits) found.push({ item, match: fits })
  }
  if (question.trim() !== '') found.sort((a, b) => b.match.score - a.match.score)
  return found.slice(0, limit)
}
