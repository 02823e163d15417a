// The page that shows the pictures of a chart: images without scripts, under a policy that loads nothing.
//
// In: SVG, as `groundstate chart draw` writes it. Out: HTML. It must not know VS Code.

const escaped = (text: string) =>
  text.replace(/[&<>"']/g, (letter) => `&#${letter.charCodeAt(0)};`);

export interface Picture {
  name: string;
  svg: string;
}

// A picture is the content of an image: whatever is in it, nothing of it runs and nothing of it is loaded.
export function page(pictures: Picture[], nonce: string): string {
  const policy = `default-src 'none'; img-src data:; style-src 'nonce-${nonce}'`;
  const image = ({ name, svg }: Picture) =>
    `<figure><img alt="${escaped(name)}" src="data:image/svg+xml;base64,${Buffer.from(svg).toString("base64")}"></figure>`;
  const body = pictures.length ? pictures.map(image).join("\n") : "<p>There is nothing to draw.</p>";
  return `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<title>Chart</title>
<style nonce="${nonce}">
body { margin: 1em; background: var(--vscode-editor-background); color: var(--vscode-editor-foreground); }
figure { margin: 0 0 2em 0; }
img { max-width: 100%; height: auto; }
pre { white-space: pre-wrap; }
</style>
</head>
<body>
${body}
</body>
</html>
`;
}

// The page that says why there is no picture.
export function failed(reason: string, nonce: string): string {
  return page([], nonce).replace("<p>There is nothing to draw.</p>", () => `<pre>${escaped(reason)}</pre>`);
}
