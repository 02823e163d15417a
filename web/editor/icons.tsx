// The icons of the studio: 16 px, strokes in the colour of the text.

import type { ReactNode } from 'react'

const PATHS: Record<string, string> = {
  chart: 'M4.5 2.5a2 2 0 1 0 0 4 2 2 0 0 0 0-4ZM11.5 9.5a2 2 0 1 0 0 4 2 2 0 0 0 0-4ZM4.5 6.5v3a2 2 0 0 0 2 2h3',
  model: 'M3.5 2.5h6l3 3v8h-9zM9.5 2.5v3h3M5.5 8.5h5M5.5 11h3.5',
  scenario: 'M3 4l1.2 1.2L6.5 3M3 8.5l1.2 1.2 2.3-2.2M3 13l1.2 1.2 2.3-2.2M9 4.5h4M9 9h4M9 13h4',
  yaml: 'M3.5 2.5h9v11h-9zM6 6h4M6 8.5h4M6 11h2.5',
  library: 'M3 3h2.5v10H3zM6.7 3h2.5v10H6.7zM10.2 3.6l2.3-.6 1.6 9.6-2.3.5z',
  folder: 'M2.5 4.5v8h11v-6.500h-6l-1.5-2z',
  plus: 'M8 3.500v9M3.5 8h9',
  close: 'M4.5 4.500l7 7M11.5 4.500l-7 7',
  search: 'M7 3a4 4 0 1 0 0 8 4 4 0 0 0 0-8ZM10 10l3.3 3.3',
  sun: 'M8 5.200a2.8 2.8 0 1 0 0 5.6 2.8 2.8 0 0 0 0-5.600ZM8 1.800v1.400M8 12.800v1.400M1.8 8h1.400M12.8 8h1.400M3.6 3.600l1 1M11.4 11.400l1 1M3.6 12.400l1-1M11.4 4.600l1-1',
  moon: 'M13 9.500A5.5 5.5 0 1 1 6.5 3a4.5 4.5 0 0 0 6.5 6.500Z',
  auto: 'M8 2.500a5.5 5.5 0 1 0 0 11 5.5 5.5 0 0 0 0-11ZM8 2.500v11M8 5h3.800M8 8h5M8 11h3.8',
  play: 'M5 3.200v9.600l7.5-4.800z',
  pause: 'M5 3.500v9M11 3.500v9',
  states: 'M4 8m-2 0a2 2 0 1 0 4 0a2 2 0 1 0-4 0M12 4m-2 0a2 2 0 1 0 4 0a2 2 0 1 0-4 0M12 12m-2 0a2 2 0 1 0 4 0a2 2 0 1 0-4 0M5.8 7.1 10.2 4.900M5.800 8.900l4.400 2.200M12 6v4',
  mutant: 'M8 5.500a3 3.500 0 0 1 3 3.500v1.500a3 3 0 0 1-6 0V9a3 3.500 0 0 1 3-3.500M8 5.500V13.500M6 5.800 4.500 3.500M10 5.800l1.500-2.300M5 8.500H2.500M11 8.500h2.500M5.200 11.500 3 13.500M10.800 11.500l2.200 2',
  refine: 'M5.5 2.500h5v3h-5zM2.5 10.500h4v3h-4zM9.5 10.500h4v3h-4zM8 5.500v2M4.5 10.500 8 7.500l3.500 3',
  timeline: 'M2.5 3v10.500h11M5 5.500h4M7 8h5M5 10.500h3',
  step: 'M4 3.500v9l6-4.500zM12 3.500v9',
  back: 'M12 3.500v9l-6-4.500zM4 3.500v9',
  restart: 'M3.2 8a4.8 4.8 0 1 0 1.6-3.600M3 2.500v2.800h2.8',
  stop: 'M4.5 4.500h7v7h-7z',
  record: 'M8 4.500a3.5 3.5 0 1 0 0 7 3.5 3.5 0 0 0 0-7Z',
  check: 'M3.5 8.500l3 3 6-7',
  cross: 'M4.5 4.500l7 7M11.5 4.500l-7 7',
  question: 'M6 6.200a2 2 0 1 1 3 1.700c-.7.4-1 .8-1 1.600M8 12v.2',
  undo: 'M4 6.500h5.500a3 3 0 0 1 0 6H6.500M6.3 3.800L3.6 6.500l2.7 2.7',
  redo: 'M12 6.500H6.500a3 3 0 0 0 0 6h3M9.7 3.800l2.7 2.7-2.7 2.7',
  fit: 'M2.8 6v-3.200H6M10 2.800h3.200V6M13.2 10v3.200H10M6 13.200H2.800V10',
  layout: 'M6 2.500h4v3H6zM2.5 10.500h4v3h-4zM9.5 10.500h4v3h-4zM8 5.500V8M4.5 10.500V8h7v2.5',
  both: 'M2.5 3.500h11v9h-11zM8 3.500v9',
  picture: 'M2.5 3.500h11v9h-11zM5.5 6.200a1.3 1.3 0 1 0 0 2.6 1.3 1.3 0 0 0 0-2.600ZM9 6h3v3H9zM6.8 7.500H9',
  text: 'M2.5 3.500h11v9h-11zM5 6h6M5 8h6M5 10h3.5',
  left: 'M2.5 2.500v11M5 4.500h8v2.500H5zM5 9h5v2.500H5z',
  right: 'M13.5 2.500v11M3 4.500h8v2.500H3zM6 9h5v2.500H6z',
  centre: 'M8 2v12M3.5 4.500h9v2.500h-9zM5.5 9h5v2.500h-5z',
  top: 'M2.5 2.500h11M4.5 5v8H7V5zM9 5v5h2.500V5z',
  bottom: 'M2.5 13.500h11M4.5 3v8H7V3zM9 6v5h2.500V6z',
  middle: 'M2 8h12M4.5 3.500v9H7v-9zM9 5.500v5h2.500v-5z',
  across: 'M2.5 2.500v11M13.5 2.500v11M6.5 4.500h3v7h-3z',
  down: 'M2.5 2.500h11M2.5 13.500h11M4.5 6.500v3h7v-3z',
  state: 'M8 3a5 5 0 1 0 0 10A5 5 0 0 0 8 3Z',
  guard: 'M5 3.800h6l3 4.2-3 4.200H5L2 8z',
  action: 'M2.5 4.500h11v7h-11z',
  composite: 'M4.500 2.500h7a2 2 0 0 1 2 2v7a2 2 0 0 1-2 2h-7a2 2 0 0 1-2-2v-7a2 2 0 0 1 2-2M8 6.200m-2.200 2.300a2.200 2.200 0 1 0 4.400 0a2.200 2.200 0 1 0-4.400 0',
  instance: 'M2.5 4.500h11v7h-11zM4.7 4.500v7M11.3 4.500v7',
  component: 'M2.5 3.500h11v9h-11zM2.5 7h11M10 5.200h2',
  channel: 'M4.5 5.500h7a2.5 2.5 0 0 1 0 5h-7a2.5 2.5 0 0 1 0-5Z',
  sensor: 'M2.5 5h7v6h-7zM11 8h3M12.5 6.500L14 8l-1.5 1.5',
  actuator: 'M6.5 5h7v6h-7zM2 8h4.500M5 6.500L6.5 8 5 9.5',
  up: 'M4.5 9.500L8 6l3.5 3.500',
  lower: 'M4.5 6.500L8 10l3.5-3.500',
  cursor: 'M4 2.800l8.2 5.2-3.7.8-1.8 3.500z',
  trash: 'M3.5 4.500h9M6.5 4.500v-2h3v2M4.8 4.500l.6 9h5.200l.6-9M6.8 7v4M9.2 7v4',
  warning: 'M8 2.800l6 10.400H2zM8 6.500v3.300M8 11.500v.2',
  chevron: 'M6 4.500L9.5 8 6 11.5',
  more: 'M4 8h.01M8 8h.01M12 8h.01',
  bolt: 'M8.8 2L4 9h3.500L7 14l5-7.500H8.400z',
  clock: 'M8 2.500a5.500 5.500 0 1 0 0 11a5.500 5.500 0 1 0 0-11M8 5v3.200l2.200 1.500',
  shield: 'M8 2.300l5 1.900v3.600c0 3-2.1 5-5 6-2.9-1-5-3-5-6V4.200zM5.8 8l1.6 1.6 2.9-3',
  beaker: 'M6.3 2.500v4L3 12.700c-.2.5.1.8.6.800h8.800c.5 0 .8-.3.6-.8L9.7 6.500v-4M5.3 2.500h5.400M5 9.500h6',
  hammer: 'M9 3.500l3.5 3.500M7.2 5.300L10 2.500l3.5 3.5-2.8 2.800zM8.5 6.800l-5.8 5.7',
  compare: 'M6 3H2.500v10H6M10 3h3.500v10H10M8 1.500v13',
  code: 'M5.5 4.500L2 8l3.5 3.500M10.5 4.500L14 8l-3.5 3.5',
  keyboard: 'M1.8 4.500h12.400v7H1.800zM4 6.800h.01M6.6 6.800h.01M9.3 6.800h.01M12 6.800h.01M5 9.300h6',
  sidebar: 'M2.5 3.500h11v9h-11zM6 3.500v9',
  flag: 'M4 14V2.500M4 3h8l-1.8 2.700L12 8.500H4',
}

export type IconName = keyof typeof PATHS & string

const FILLED = new Set(['play', 'step', 'back', 'stop', 'record'])

export function Icon({ name, size = 16 }: { name: string; size?: number }): ReactNode {
  const filled = FILLED.has(name)
  return (
    <svg className="icon" width={size} height={size} viewBox="0 0 16 16" aria-hidden="true">
      <path
        d={PATHS[name] ?? ''}
        fill={filled ? 'currentColor' : 'none'}
        stroke="currentColor"
        strokeWidth={name === 'more' ? 2 : 1.35}
        strokeLinecap="round"
        strokeLinejoin="round"
      />
    </svg>
  )
}
