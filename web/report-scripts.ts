// The scripts of a report's page as modules: the page has them inline, as they are.
//
// In: `draw.js`, `explore.js` and `charts.js` of `crates/report/src/html`, each one function. Out: the same with an export.

import type { Plugin } from 'vite'

const EXPORTS: Record<string, string> = { 'draw.js': 'drawingOf', 'explore.js': 'explore', 'charts.js': 'lightCharts' }

export function reportScripts(): Plugin {
  return {
    name: 'report-scripts',
    transform(code, id) {
      const found = /\/crates\/report\/src\/html\/(draw\.js|explore\.js|charts\.js)$/.exec(id)
      return found ? { code: `${code}\nexport { ${EXPORTS[found[1] ?? '']} }\n`, map: null } : null
    },
  }
}
