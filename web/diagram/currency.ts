// Whether what was found of texts still holds of them: which ones are others now.
//
// In: the texts that a job looked at, as they were when it began, and what is known of each now. Out: the paths of those that are others.
// INVARIANT: a text that became what it was is no other one.

export interface Looked {
  path: string
  // Of the file; null if there was none.
  hash: string | null
  // The text itself, if it was open.
  text: string | null
}

export interface Known {
  // Of the file as it was seen last; null if there is none.
  hash: string | null
  // What the editor holds, if it is open, and whether the file holds it, too.
  text: string | null
  saved: boolean
}

export function changedOf(looked: readonly Looked[], known: (path: string) => Known | undefined): string[] {
  const isOther = (before: Looked): boolean => {
    const now = known(before.path)
    if (!now) return false
    if (now.text !== null && before.text !== null) return now.text !== before.text
    return !now.saved || now.hash !== before.hash
  }
  return looked.filter(isOther).map(({ path }) => path)
}
