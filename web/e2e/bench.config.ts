// The measurements by themselves: `npm run bench`.

import { defineConfig } from 'vitest/config'

export default defineConfig({ test: { include: ['e2e/bench.test.ts'], testTimeout: 120_000, hookTimeout: 60_000 } })
