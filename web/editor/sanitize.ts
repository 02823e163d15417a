// The language server's Markdown, turned to HTML by the language client, with all taken out that is no plain text.
//
// In: HTML. Out: HTML of a few harmless elements. INVARIANT: names and strings of a model never become markup that acts.

const ALLOWED = new Set(
  'P PRE CODE STRONG EM B I UL OL LI HR BR SPAN H1 H2 H3 H4 TABLE THEAD TBODY TR TH TD BLOCKQUOTE DEL A'.split(' '),
)

function clean(node: Node): void {
  for (const child of [...node.childNodes]) {
    if (child.nodeType === Node.TEXT_NODE) continue
    if (!(child instanceof HTMLElement) || !ALLOWED.has(child.tagName)) {
      child.parentNode?.replaceChild(document.createTextNode(child.textContent ?? ''), child)
      continue
    }
    for (const { name } of [...child.attributes]) if (name !== 'class') child.removeAttribute(name)
    clean(child)
  }
}

export function sanitized(html: string): string {
  const page = new DOMParser().parseFromString(html, 'text/html')
  clean(page.body)
  return page.body.innerHTML
}
