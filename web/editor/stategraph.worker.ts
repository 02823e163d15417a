// Places the states of a graph, beside the page, so that it can be ended whatever it does.

import { placed } from '../diagram/stategraph'

const scope = self as unknown as { onmessage: (event: MessageEvent) => void; postMessage: (message: unknown) => void }

scope.onmessage = ({ data }: MessageEvent<{ depths: number[]; edges: [number, number][] }>) => scope.postMessage(placed(data.depths, data.edges))
