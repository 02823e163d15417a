// The scripts of a report's page as modules: the page has them inline, as they are.
//
// In: `crates/report/src/html/draw.js` and `explore.js`, each one function. Out: the same with an export.

import type { Plugin } from 'vite'

const EXPORTS: Record<string, string> = { 'draw.js': 'drawingOf', 'explore.js': 'explore' }

export function reportScripts(): Plugin {
  return {
    name: 'report-scripts',
    transform(code, id) {
      const found = /\/crates\/report\/src\/html\/(draw\.js|explore\.js)$/.exec(id)
      return found ? { code: `${code}\nexport { ${EXPORTS[found[1] ?? '']} }\n`, map: null } : null
    },
  }
}
