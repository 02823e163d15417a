// What the studio says of what jobs found: marks of reviews and mutants, refinement checks.

export const REFINED = {
  verdicts: { refines: 'refines', 'does-not-refine': 'does not refine', unknown: 'not known', vacuous: 'says nothing' },
  pairs: (pairs: number, open: number) =>
    `${pairs === 1 ? '1 pair of states' : `${pairs.toLocaleString('en')} pairs of states`}${open > 0 ? `, ${open.toLocaleString('en')} not looked at` : ''}`,
  places: (places: number) => (places === 1 ? 'in 1 place' : `in ${places.toLocaleString('en')} places`),
  observed: 'Observed',
  diagrams: 'Diagrams',
  assumed: 'Assumed',
  waiting: 'the concrete machine does not go on for ever while the abstract one makes no step',
  overflow: 'no number of the concrete machine leaves 64 bits',
  properties: 'Properties of the abstract machine',
  standings: {
    holds: 'holds of the concrete machine',
    'comes-along': 'holds of the concrete machine if it holds of the abstract one',
    violated: 'does not hold of the abstract machine',
    unknown: 'not known of the abstract machine',
    stays: 'does not come along',
  } as Record<string, string>,
}

export const MARKS = {
  survived: (operator: string, before: string, after: string) => `nobody notices if this changes (${operator}): ${before} → ${after === '' ? 'nothing' : after}`,
  uncovered: (what: string, rule: string) => `no scenario covered ${what} of ${rule}`,
  coverage: (model: string) => `What scenarios covered of ${model}`,
  open: 'open',
  survives: 'survived',
  nothing: 'nothing',
  covered: 'Covered by the scenarios',
  notCovered: (told: string) => `Not wholly covered: ${told}`,
  score: (killed: number, survived: number, equivalent: number, rest: number) =>
    `${killed} noticed, ${survived} not noticed, ${equivalent} make no difference${rest > 0 ? `, ${rest} not known` : ''}`,
  outcomes: { holds: 'holds', violated: 'violated', unknown: 'unknown' } as Record<string, string>,
  metas: {
    MP1: 'No updates clash',
    MP2: 'Every conditional is complete',
    MP3: 'Every rule runs at some time',
    MP4: 'No update is always trivial',
    MP5: 'Every element is used as a value',
    MP6: 'Every function takes all its values',
    MP7: 'Every location is updated and read',
  } as Record<string, string>,
}
