// Fast tests: `web/diagram`, which needs neither React nor a page.

import { defineConfig } from 'vitest/config'

export default defineConfig({ test: { include: ['diagram/**/*.test.ts'], environment: 'node' } })
