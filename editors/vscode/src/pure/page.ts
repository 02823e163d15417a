// The pages that are shown in panels: a chart, and a report. Each runs its own scripts alone, and loads nothing.
//
// In: the script of the chart's page, or HTML as `groundstate report` writes it. Out: HTML with a policy. INVARIANT: what runs has a
// nonce that is made for this page; there is no other source of anything. It must not know VS Code.

const escaped = (text: string) =>
  text.replace(/[&<>"']/g, (letter) => `&#${letter.charCodeAt(0)};`);

const policy = (nonce: string, more: string) =>
  `<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'nonce-${nonce}'; script-src 'nonce-${nonce}'${more}">`;

// The page of a chart: empty, and filled by messages. `script` is the place of its script.
export function chartPage(script: string, nonce: string): string {
  return `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
${policy(nonce, "")}
<title>Chart</title>
<style nonce="${nonce}">
body { margin: 1em; background: var(--vscode-editor-background); color: var(--vscode-editor-foreground); }
figure { margin: 0 0 2em 0; position: relative; display: inline-block; max-width: 100%; }
img { display: block; max-width: 100%; height: auto; }
svg { position: absolute; inset: 0; width: 100%; height: 100%; }
pre { white-space: pre-wrap; }
.part { fill: transparent; stroke: transparent; stroke-width: 3; vector-effect: non-scaling-stroke; }
polyline.part { fill: none; stroke-width: 10; }
.part.has-text { cursor: pointer; }
.part.has-text:hover { stroke: var(--vscode-focusBorder); stroke-opacity: 0.6; }
.part:focus { outline: none; stroke: var(--vscode-focusBorder); }
.part.cursor { stroke: var(--vscode-focusBorder); stroke-opacity: 1; }
polyline.part:hover, polyline.part.cursor { stroke-width: 4; }
.part.lit { fill: var(--vscode-charts-green); fill-opacity: 0.35; stroke: var(--vscode-charts-green); }
.agents { fill: var(--vscode-editor-foreground); font: 11px var(--vscode-font-family); text-anchor: middle; pointer-events: none; }
</style>
</head>
<body>
<main id="chart"></main>
<script nonce="${nonce}" src="${escaped(script)}"></script>
</body>
</html>
`;
}

const DARK = /\(\s*prefers-color-scheme:\s*dark\s*\)/g;
const LIGHT = /\(\s*prefers-color-scheme:\s*light\s*\)/g;

// What the page of a report runs before its own script: its place in the address is kept where that can be.
const GUARD =
  "const keep = history.replaceState.bind(history); history.replaceState = (...words) => { try { keep(...words); } catch {} };";

// A page of `groundstate report`, with its scripts and styles let through by a nonce, in the editor's colours. Only the elements of
// the page itself get it: what looks like one in a text or in data is written otherwise by whoever makes the page.
export function reportPage(html: string, nonce: string, theme: "light" | "dark"): string {
  const head = `${policy(nonce, "; base-uri 'none'; form-action 'none'")}\n<script nonce="${nonce}">${GUARD}</script>\n`;
  const given = html
    .replace(/<(script|style)(?=[\s>])/g, `<$1 nonce="${nonce}"`)
    .replace(/(<meta name="color-scheme" content=")[^"]*/, `$1${theme}`)
    .replace(DARK, theme === "dark" ? "all" : "not all")
    .replace(LIGHT, theme === "light" ? "all" : "not all");
  return given.includes("<head>") ? given.replace("<head>", () => `<head>\n${head}`) : failedPage("This is no page of a report.", nonce);
}

// The page that says why there is none.
export function failedPage(reason: string, nonce: string): string {
  return `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
${policy(nonce, "")}
<title>Groundstate</title>
</head>
<body>
<pre>${escaped(reason)}</pre>
</body>
</html>
`;
}
