// The page of a report: its data, its timeline, the window in its address. SYNC(run data)
"use strict";
const run = JSON.parse(document.getElementById("run").textContent);
const drawing = drawingOf(run);
document.body.classList.add("live");
const moved = (from, to) => history.replaceState(null, "", `#t=${from.toFixed(1)}-${to.toFixed(1)}`);
const timeline = explore(document, run, drawing, { moved });
function follow() {
  const found = location.hash.match(/^#t=([\d.]+)-([\d.]+)$/);
  if (found) timeline.go(Number(found[1]), Number(found[2])); else timeline.show(...timeline.window());
}
addEventListener("hashchange", follow);
follow();
if (typeof lightCharts === "function") lightCharts(document, run, drawing, timeline);
