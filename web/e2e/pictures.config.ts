// The pictures of the documentation: `npm run pictures`.

import { defineConfig } from 'vitest/config'

export default defineConfig({ test: { include: ['e2e/pictures.test.ts'], testTimeout: 120_000, hookTimeout: 60_000 } })
