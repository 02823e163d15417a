// The script of a chart's page: draws what it is told, says what was clicked, lights what runs.
//
// In: messages with pictures and marks. Out: a message for each click. A picture is the content of an image, so nothing in it runs;
// the parts that can be clicked lie over it. Texts of the chart are never read as HTML.

import type { Lit, Part, Shown } from "../pure/picture";

interface Host {
  postMessage(message: unknown): void;
}

declare function acquireVsCodeApi(): Host;

const SPACE = "http://www.w3.org/2000/svg";

interface Drawn {
  kind: "drawings";
  drawings: Shown[];
  problems: string[];
}

interface Marked {
  kind: "marks";
  cursor: Part[];
  lit: Lit[];
  follow: boolean;
}

const host = acquireVsCodeApi();
const main = document.getElementById("chart") as HTMLElement;
// By drawing and part, as `keyOf` says.
let parts = new Map<string, SVGElement>();
let marks: Marked = { kind: "marks", cursor: [], lit: [], follow: false };

const keyOf = ({ drawing, shape, line }: Part) => `${drawing}\n${shape ?? ""}\n${line ?? ""}`;

function element(name: string, attributes: Record<string, string | number>): SVGElement {
  const made = document.createElementNS(SPACE, name) as SVGElement;
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  return made;
}

function outline({ figure, x, y, width, height }: Shown["boxes"][number]): SVGElement {
  if (figure === "circle") {
    return element("ellipse", { cx: x + width / 2, cy: y + height / 2, rx: width / 2, ry: height / 2 });
  }
  if (figure === "hexagon") {
    const notch = Math.min(width / 4, height / 2);
    const [right, bottom, middle] = [x + width, y + height, y + height / 2];
    const corners = [[x, middle], [x + notch, y], [right - notch, y], [right, middle], [right - notch, bottom], [x + notch, bottom]];
    return element("polygon", { points: corners.map((at) => at.join(",")).join(" ") });
  }
  return element("rect", { x, y, width, height, rx: 3 });
}

function clickable(made: SVGElement, part: Part, hasText: boolean, label: string): SVGElement {
  made.setAttribute("class", hasText ? "part has-text" : "part");
  if (hasText) {
    made.setAttribute("tabindex", "0");
    made.setAttribute("role", "button");
    made.setAttribute("aria-label", label);
    const go = () => host.postMessage({ kind: "go", part });
    made.addEventListener("click", go);
    made.addEventListener("keydown", (event) => {
      if ((event as KeyboardEvent).key === "Enter") go();
    });
  }
  parts.set(keyOf(part), made);
  return made;
}

function figure(drawing: Shown): HTMLElement {
  const whole = document.createElement("figure");
  const image = document.createElement("img");
  image.setAttribute("alt", drawing.name);
  image.setAttribute("src", drawing.image);
  image.setAttribute("width", String(drawing.view[2]));
  const over = element("svg", { viewBox: drawing.view.join(" "), "data-drawing": drawing.name });
  drawing.lines.forEach(({ points, hasText }, line) => {
    const made = element("polyline", { points: points.map((at) => at.join(",")).join(" ") });
    over.append(clickable(made, { drawing: drawing.name, line }, hasText, "arrow"));
  });
  for (const box of drawing.boxes) {
    over.append(clickable(outline(box), { drawing: drawing.name, shape: box.id }, box.hasText, box.label || box.id));
  }
  whole.append(image, over);
  return whole;
}

function draw({ drawings, problems }: Drawn): void {
  parts = new Map();
  const notes = problems.map((problem) => {
    const note = document.createElement("pre");
    note.textContent = problem;
    return note;
  });
  main.replaceChildren(...notes, ...drawings.map(figure));
  if (!drawings.length && !problems.length) {
    const note = document.createElement("p");
    note.textContent = "There is nothing to draw.";
    main.replaceChildren(note);
  }
  mark({ ...marks, follow: false });
}

function mark(told: Marked): void {
  marks = told;
  for (const made of parts.values()) made.classList.remove("cursor", "lit");
  for (const note of [...document.querySelectorAll(".agents")]) note.remove();
  for (const part of told.lit) {
    const made = parts.get(keyOf({ drawing: part.drawing, shape: part.shape }));
    made?.classList.add("lit");
    if (made && part.agents.length && made instanceof SVGGraphicsElement) {
      const { x, y, width } = made.getBBox();
      const note = element("text", { class: "agents", x: x + width / 2, y: y - 3 });
      note.textContent = part.agents.join(", ");
      made.after(note);
    }
  }
  told.cursor.forEach((part, index) => {
    const made = parts.get(keyOf(part));
    made?.classList.add("cursor");
    if (index === 0 && told.follow) made?.scrollIntoView({ block: "nearest", inline: "nearest" });
  });
}

addEventListener("message", ({ data }: MessageEvent<Drawn | Marked>) => {
  if (data.kind === "drawings") draw(data);
  if (data.kind === "marks") mark(data);
});
host.postMessage({ kind: "ready" });
