// What the studio says of jobs and of what they found: outcomes, whether they are of the texts as they are, marks of reviews and mutants,
// refinement checks.

import type { JobKind } from './diagram/protocol'

export const REFINED = {
  verdicts: { refines: 'refines', 'does-not-refine': 'does not refine', unknown: 'not known', vacuous: 'says nothing' },
  pairs: (pairs: number, open: number) =>
    `${pairs === 1 ? '1 pair of states' : `${pairs.toLocaleString('en')} pairs of states`}${open > 0 ? `, ${open.toLocaleString('en')} not looked at` : ''}`,
  places: (places: number) => (places === 1 ? 'in 1 place' : `in ${places.toLocaleString('en')} places`),
  observed: 'Observed',
  leftOut: 'Left out',
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

export const CHECK = {
  none: 'No results yet',
  noneHint: 'Verify a model, run scenarios, or compare a chart with its model. What is found is told here.',
  running: 'Runs…',
  doing: {
    verify: 'States are being explored. What is decided is told at once; a counterexample can be played.',
    test: 'Scenarios are being played.',
    build: 'The model is being made of the chart.',
    check: 'Each case of the chart is compared with the rule.',
    generate: 'C++ is being written.',
    review: 'The model is being looked through.',
    times: 'Loads, responses and ages are being worked out.',
    mutate: 'Small faults are put into the model, one by one. This may take minutes.',
    graph: 'States are being listed.',
    refine: 'Pairs of states are being explored.',
    program: 'The program is being built.',
  } as Record<JobKind, string>,
  stop: 'Stop',
  stopped: 'Stopped',
  good: 'Good',
  bad: 'At fault',
  unknown: 'Unknown',
  world: 'Could not run',
  again: 'Again',
  jobs: 'Jobs',
  holds: 'holds',
  violated: 'violated',
  unknownVerdict: 'unknown',
  states: (count: number) => (count === 1 ? '1 state' : `${count.toLocaleString('en')} states`),
  explored: (count: number, complete: boolean) => `${complete ? 'All' : 'Not all'} states were seen: ${count.toLocaleString('en')}.`,
  trace: (steps: number) => (steps === 1 ? 'Show its step' : `Play its ${steps.toLocaleString('en')} steps`),
  counterexample: 'Counterexample',
  runIt: 'Run it',
  runItHint: 'Play it as a scenario: step by step, on the chart and the timeline',
  leave: 'Leave the counterexample',
  first: 'To the beginning',
  previous: 'One step back',
  next: 'One step on',
  repeats: (step: number) => `From step ${step} on it repeats for ever.`,
  passed: 'passed',
  failed: 'failed',
  output: 'Output',
  checks: (checks: number, failed: number) => (failed > 0 ? `${failed} of ${checks} ${checks === 1 ? 'check' : 'checks'} failed` : checks === 1 ? '1 check' : `${checks} checks`),
  steps: (steps: number) => (steps === 1 ? '1 step' : `${steps} steps`),
  inputs: 'Inputs',
  choices: 'Choices',
  elapsed: (seconds: number) => `${seconds} s`,
  // What every model is checked for, by the names that the checker has for it.
  builtin: {
    consistent: 'no inconsistent update',
    'in-domain': 'no update outside its domain',
    defined: 'every guard and operation is defined',
    'no-deadlock': 'no deadlock',
  } as Record<string, string>,
  began: (time: string) => `began at ${time}`,
  // Of a test whose scenarios are all of other models.
  elsewhere: (model: string, others: string[], passed: number, played: number) =>
    `No scenario beside it loads ${model}; ${passed === played ? passed : `${passed} of ${played}`} of ${others.join(', ')} passed.`,
  nothingOfIt: 'Says nothing of it',
  help: (text: string) => `help: ${text}`,
  line: (line: number) => `line ${line}`,
  conforms: (beside: string) => `Conforms, ${beside}`,
  agrees: 'Chart and model agree.',
  builtFrom: (model: string, chart: string) => `${model} is built from ${chart}.`,
  written: (folder: string) => `The C++ is in ${folder}.`,
  showCode: 'Show it',
  omitted: (first: number, last: number, all: number) =>
    last === 0
      ? `its first ${first.toLocaleString('en')} steps`
      : `its first ${first.toLocaleString('en')} and last ${last.toLocaleString('en')} of ${all.toLocaleString('en')} steps`,
  noSteps: (all: number) => `its ${all.toLocaleString('en')} steps are too large to be shown`,
  between: (steps: number) => `${steps.toLocaleString('en')} steps before this one are left out.`,
}

// Results of texts that are others now, and models that are not those of their charts.
export const OLDER = {
  changed: (names: string[]) => (names.length === 1 ? `${names[0]} has changed since` : `${names.slice(0, -1).join(', ')} and ${names.at(-1)} have changed since`),
  model: 'an older model than the chart’s',
  differs: (chart: string, model: string) => `${model} is not the model of ${chart} as it is drawn`,
  hints: {
    differs: 'One of them has changed since the model was built. What is found of the model as it is says nothing of the chart.',
    faulty: 'There are faults in one of them, so that it cannot be built. What is found of the model as it is says nothing of the chart.',
    unknown: 'Whether they agree cannot be decided. What is found of the model as it is may say nothing of the chart.',
  },
  faults: 'Show the faults',
  // What is offered for each thing that is done to a model: to build it first, or to take it as it is.
  acts: {
    verify: ['Build and verify', 'Verify the old model'],
    test: ['Build and test', 'Test the old model'],
    graph: ['Build and draw', 'Draw the old model'],
    review: ['Build and review', 'Review the old model'],
    mutate: ['Build and mutate', 'Mutate the old model'],
    generate: ['Build and generate', 'Generate from the old model'],
    run: ['Build and run', 'Run the old model'],
  } as Record<Act, [string, string]>,
}

// What is done to the model of a chart.
export type Act = JobKind | 'run'
