// Parts of the view of a state: what its step read and chose, and a location with its value.

import type { ReactNode } from 'react'

import type { Frame } from '../diagram/light'
import { words } from '../words'

// What a step read and chose.
export function Read({ frame }: { frame: Frame }): ReactNode {
  return (
    <>
      {frame.inputs.length > 0 && (
        <p className="choices">
          {words.check.inputs}: <code>{frame.inputs.map(([location, value]) => `${location} = ${value}`).join(', ')}</code>
        </p>
      )}
      {frame.choices.length > 0 && (
        <p className="choices">
          {words.check.choices}: <code>{frame.choices.join(', ')}</code>
        </p>
      )}
    </>
  )
}

export function Row({ frame, location }: { frame: Frame; location: string }): ReactNode {
  const value = frame.state.get(location) ?? ''
  const before = frame.changed.get(location)
  return (
    <tr className={before === undefined ? undefined : 'changed'}>
      <th scope="row" title={location}>
        {location}
      </th>
      <td title={value}>{value}</td>
      <td className="before" title={before}>
        {before === undefined ? '' : `${words.run.was} ${before}`}
      </td>
    </tr>
  )
}
