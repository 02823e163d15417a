// The script of the chart's page against a stand-in for the browser's document: what it draws, says and lights.

import assert from "node:assert/strict";
import fs from "node:fs";

class Element {
  attributes = new Map();
  children = [];
  heard = new Map();
  textContent = "";
  constructor(name) {
    this.name = name;
  }
  setAttribute(key, value) {
    this.attributes.set(key, String(value));
  }
  get classList() {
    const all = () => (this.attributes.get("class") ?? "").split(" ").filter(Boolean);
    const set = (list) => this.setAttribute("class", list.join(" "));
    return {
      add: (...names) => set([...new Set([...all(), ...names])]),
      remove: (...names) => set(all().filter((name) => !names.includes(name))),
      contains: (name) => all().includes(name),
    };
  }
  append(...more) {
    for (const one of more) one.parent = this;
    this.children.push(...more);
  }
  after(one) {
    one.parent = this.parent;
    this.parent.children.splice(this.parent.children.indexOf(this) + 1, 0, one);
  }
  remove() {
    this.parent.children.splice(this.parent.children.indexOf(this), 1);
  }
  replaceChildren(...more) {
    this.children = [];
    this.append(...more);
  }
  addEventListener(event, work) {
    this.heard.set(event, work);
  }
  getBBox() {
    return { x: 1, y: 2, width: 10, height: 10 };
  }
  scrollIntoView() {
    scrolled.push(this);
  }
  all() {
    return [this, ...this.children.flatMap((child) => child.all())];
  }
}
const scrolled = [];
const said = [];
const main = new Element("main");
globalThis.SVGGraphicsElement = Element;
globalThis.document = {
  getElementById: (id) => (id === "chart" ? main : null),
  createElement: (name) => new Element(name),
  createElementNS: (space, name) => new Element(name),
  querySelectorAll: (selector) => main.all().filter((one) => one.classList.contains(selector.slice(1))),
};
let hear;
globalThis.addEventListener = (event, work) => {
  if (event === "message") hear = (data) => work({ data });
};
globalThis.acquireVsCodeApi = () => ({ postMessage: (message) => said.push(message) });
const script = fs.readFileSync(new URL("../out/webview/chart.js", import.meta.url), "utf8");
assert.ok(!/innerHTML|outerHTML|insertAdjacentHTML|eval\(/.test(script));
(0, eval)(script);
assert.deepEqual(said, [{ kind: "ready" }]);

const box = (id, figure, hasText) => ({ id, figure, label: `<b>${id}</b>`, x: 0, y: 0, width: 20, height: 10, hasText });
const drawing = {
  name: "lamp", image: "data:image/svg+xml;base64,AA", view: [0, 0, 100, 50],
  boxes: [box("on", "circle", true), box("g", "hexagon", true), box("exit 1", "exit", false)],
  lines: [{ points: [[0, 0], [5, 5]], hasText: true }],
};
hear({ kind: "drawings", drawings: [drawing], problems: ["<i>one</i> is wrong"] });
const parts = () => main.all().filter((one) => one.classList.contains("part"));
assert.deepEqual(parts().map(({ name }) => name), ["polyline", "ellipse", "polygon", "rect"]);
assert.equal(main.all().find(({ name }) => name === "pre").textContent, "<i>one</i> is wrong");
assert.equal(main.all().find(({ name }) => name === "svg").attributes.get("viewBox"), "0 0 100 50");
const [arrow, on, guard, exit] = parts();
on.heard.get("click")();
guard.heard.get("keydown")({ key: "Enter" });
guard.heard.get("keydown")({ key: "a" });
arrow.heard.get("click")();
assert.deepEqual(said.slice(1).map(({ part }) => part), [{ drawing: "lamp", shape: "on" }, { drawing: "lamp", shape: "g" }, { drawing: "lamp", line: 0 }]);
assert.equal(exit.heard.size, 0);

const classes = () => parts().map((one) => ["cursor", "lit"].filter((name) => one.classList.contains(name)).join());
hear({ kind: "marks", cursor: [{ drawing: "lamp", line: 0 }], lit: [{ drawing: "lamp", shape: "on", agents: ["LEFT", "RIGHT"] }], follow: true });
assert.deepEqual(classes(), ["cursor", "lit", "", ""]);
assert.deepEqual(scrolled, [arrow]);
assert.deepEqual(main.all().filter((one) => one.classList.contains("agents")).map((one) => one.textContent), ["LEFT, RIGHT"]);
// A picture that is drawn anew keeps its marks; what is gone is not marked.
hear({ kind: "drawings", drawings: [drawing], problems: [] });
assert.deepEqual(classes(), ["cursor", "lit", "", ""]);
assert.equal(scrolled.length, 1);
hear({ kind: "marks", cursor: [{ drawing: "gone", shape: "on" }], lit: [{ drawing: "lamp", shape: "gone", agents: [] }], follow: true });
assert.deepEqual(classes(), ["", "", "", ""]);
assert.equal(main.all().filter((one) => one.classList.contains("agents")).length, 0);
hear({ kind: "drawings", drawings: [], problems: [] });
assert.equal(main.children[0].textContent, "There is nothing to draw.");
console.log("the chart's page draws, leads to the text and lights what runs");
