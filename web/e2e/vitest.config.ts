// The tests in the browser: one after another, against the program (GROUNDSTATE, or target/debug/groundstate).

import { defineConfig } from 'vitest/config'

export default defineConfig({
  test: { include: ['e2e/**/*.test.ts'], exclude: ['e2e/bench.test.ts', 'e2e/pictures.test.ts'], testTimeout: 60_000, hookTimeout: 60_000, fileParallelism: false, bail: 0 },
})
