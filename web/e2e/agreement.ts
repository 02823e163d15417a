// What a chart's text declares, and what its picture shows, in the same words: for tests that hold one to the other.
//
// In: a text, or a page. Out: shapes by their names, arrows by what their ends show, as the page says them. The account of the text is
// made by regular expressions of its own, since it judges the program's.

import type { Page } from 'playwright-core'

export interface Seen {
  shapes: string[]
  arrows: string[]
}

interface Arrow {
  from: string
  branch: string
  to: string
}

const sorted = (all: Iterable<string>): string[] => [...all].sort()

const uncommented = (text: string): string => text.replace(/\/\/.*/g, '')

// Names with what they show. Words of several lines are shown with blanks between.
function shapes(text: string, words: string): Map<string, string> {
  const found = uncommented(text).matchAll(new RegExp(`^\\t+(?:initial )?(?:${words}) (\\w+)(?: "([^"]*)")?`, 'gm'))
  return new Map([...found].map(([, name, shown]) => [name ?? '', shown ?? '']))
}

function paths(text: string): Arrow[] {
  return uncommented(text)
    .split('\n')
    .filter((line) => /^\t+\w+(?: yes| no)? -> /.test(line))
    .flatMap((line) => {
      const stops = line.trim().split(' -> ')
      return stops.slice(1).map((stop, index) => {
        const [from = '', branch = ''] = (stops[index] ?? '').split(' ')
        return { from, branch, to: stop.split(' ')[0] ?? '' }
      })
    })
}

function channels(text: string): Arrow[] {
  const found = uncommented(text).matchAll(/^\tchannel (\w+) from (\w+) to (\w+(?:, \w+)*)/gm)
  return [...found].flatMap(([, name = '', from = '', readers = '']) => [
    { from, branch: '', to: name },
    ...readers.split(', ').map((to) => ({ from: name, branch: '', to })),
  ])
}

const KINDS = 'state|composite state|guard|action|component|sensor|actuator|channel'

export function told(text: string, shown: ReadonlyMap<string, string>): Seen {
  const say = ({ from, branch, to }: Arrow): string => `Arrow from ${shown.get(from) ?? from}${branch ? `, ${branch},` : ''} to ${shown.get(to) ?? to}`
  return { shapes: names(text), arrows: sorted(new Set([...paths(text), ...channels(text)].map(say))) }
}

export const names = (text: string): string[] => sorted(shapes(text, KINDS).keys())

// What the page shows, and what each shape on it says of itself.
export async function seen(page: Page): Promise<Seen & { shown: Map<string, string> }> {
  const found = await page.evaluate(() => {
    const nodes = [...document.querySelectorAll('.react-flow__node')]
    const arrows = [...document.querySelectorAll('.lines [role="img"]')]
    // `State First, initial, to Ready`: what it shows is behind its kind.
    const said = (label: string): string => (label.split(/, (?:initial|to be refined|if yes|if no|to )/)[0] ?? '').replace(/^(?:State|Composite state|Guard|Action|Component|Channel|Device) /, '')
    return {
      shapes: nodes.map((node) => [node.getAttribute('data-id') ?? '', said(node.getAttribute('aria-label') ?? '')] as const),
      arrows: arrows.map((arrow) => arrow.getAttribute('aria-label') ?? ''),
    }
  })
  return { shapes: sorted(found.shapes.map(([id]) => id)), arrows: sorted(new Set(found.arrows)), shown: new Map(found.shapes) }
}

// Who reads and who writes a channel of the text, by its ends and by the phases.
export function phases(text: string): { ends: string[]; phases: string[] } {
  const ends = channels(text).map(({ from, to }) => `${from} ${to}`)
  const own = [...uncommented(text).matchAll(/^\tcomponent (\w+)[^]*?^\tendcomponent/gm)].flatMap(([whole, name = '']) =>
    [...whole.matchAll(/^\t\t(read|write) (\w+)/gm)].map(([, verb, channel = '']) => (verb === 'write' ? `${name} ${channel}` : `${channel} ${name}`)),
  )
  return { ends: sorted(new Set(ends)), phases: sorted(new Set(own)) }
}
