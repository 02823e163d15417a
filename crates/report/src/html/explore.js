// Moves the window over a run: by pointer, wheel, keyboard, buttons and links. Reads off what is where.
//
// In: the document or shadow tree that has the timeline's markup, the data of the run, what draws it; `heard.moved` is called with each
// window that was moved to, `heard.picked`, if there is one, with a tick that was clicked on. Out: what moves the window from outside. The page of a report and the studio use it.
"use strict";

function explore(root, run, drawing, heard) {
  const by = (id) => root.getElementById(id);
  const stage = by("stage"), detail = by("detail"), whole = by("whole"), tip = by("tip");
  const where = by("where"), described = detail.querySelector("desc");
  let { HEAD, RIGHT, px, escaped, lower, time, timed, viewOf, drawTimeline } = drawing;
  let strip = by("overview");
  let from = 0, to = run.window, view = null, waiting = 0, moved = false;

  function show(start, end) {
    const length = Math.min(Math.max(end - start, Math.min(20, run.shown)), run.shown), middle = (start + end) / 2;
    from = Math.min(Math.max(middle - length / 2, 0), run.shown - length);
    to = from + length;
    if (!waiting) waiting = requestAnimationFrame(draw);
  }

  function draw() {
    waiting = 0;
    const width = Math.max(stage.clientWidth, 280);
    view = viewOf(from, to, width);
    detail.setAttribute("viewBox", `0 0 ${width} ${run.height + HEAD}`);
    detail.setAttribute("width", width);
    detail.setAttribute("height", run.height + HEAD);
    detail.querySelectorAll(":scope > g").forEach((group) => group.remove());
    described.insertAdjacentHTML("afterend", drawTimeline(view));
    whole.style.gridTemplateColumns = `${view.left}px 1fr ${RIGHT}px`;
    const scale = strip.viewBox.baseVal.width / run.shown, frame = strip.querySelector(".brush");
    frame.setAttribute("x", px(from * scale));
    frame.setAttribute("width", px(Math.max(3, (to - from) * scale)));
    mark();
    const spare = to - from < 50 ? 1 : 0;
    where.textContent = `${time(from, spare)}\u2013${timed(to, spare)}`;
    if (moved) heard.moved(from, to);
  }

  /** The moment that is shown elsewhere, as a line, if there is one. */
  let moment = null;
  function mark() {
    if (!view) return;
    const inside = moment !== null && moment >= from && moment <= to;
    by("mark").setAttribute("d", inside ? `M${px(view.x(moment + 0.5))} -4V${run.height}` : "");
  }
  /** Called with each moment that is pointed at. */
  const pointed = [];

  // Whether all of the run is to be seen, also when there is more of it.
  let all = false;
  const zoom = (factor, at) => { [moved, all] = [true, false]; show(at - (at - from) * factor, at + (to - at) * factor); };
  const move = (ticks) => { [moved, all] = [true, false]; show(from + ticks, to + ticks); };
  const jump = (tick, length) => { [moved, all] = [true, false]; show(tick - length / 2, tick + length / 2); };
  const tickAt = (x) => from + (x - view.left) / view.scale;

  /** The first tick after the middle at which something of this kind begins, in any task's lane. */
  function next(kind) {
    const after = (from + to) / 2 + 0.5;
    let found = Infinity;
    for (const lane of run.lanes) {
      if (kind === "miss") {
        const index = lower(lane.crosses, after);
        if (index < lane.crosses.length) found = Math.min(found, lane.crosses[index]);
        continue;
      }
      for (const { starts, kinds } of lane.s) {
        for (let i = lower(starts, after); i < starts.length && starts[i] < found; i++) {
          if (run.kinds[kinds[i]][1] === kind) found = starts[i];
        }
      }
    }
    return found;
  }

  function seek(kind) {
    let found = next(kind);
    if (found === Infinity) { const [a, b] = [from, to]; from = to = -1; found = next(kind); [from, to] = [a, b]; }
    if (found !== Infinity) jump(found, Math.min(to - from, run.window));
  }

  const actions = {
    back: () => move((from - to) / 4),
    forth: () => move((to - from) / 4),
    out: () => zoom(1.6, (from + to) / 2),
    in: () => zoom(1 / 1.6, (from + to) / 2),
    first: () => { [moved, all] = [true, false]; show(0, run.window); },
    all: () => { moved = all = true; show(0, run.shown); },
    wait: () => seek("wait"),
    miss: () => seek("miss"),
  };
  const keys = { ArrowLeft: "back", ArrowRight: "forth", "+": "in", "=": "in", "-": "out", Home: "first", 0: "all", w: "wait" };

  /** What stands at a place of the drawing, as one line of markup: of a lane with several strips the one that is pointed at. */
  function read(lane, tick, y) {
    if (!lane) return `<span>${timed(tick, 1)}</span>`;
    let out = `<b>${escaped(lane.n)}${lane.c.startsWith("\u2192") ? " " + escaped(lane.c) : ""}</b>`;
    const away = (strip) => Math.max(strip.y - y, y - strip.y - strip.h, 0);
    const nearest = lane.s.reduce((best, strip, row) => (best < 0 || away(strip) < away(lane.s[best]) ? row : best), -1);
    lane.s.forEach((strip, row) => {
      const i = lower(strip.ends, tick + 1e-9);
      if (row !== nearest || !(strip.starts[i] <= tick)) return;
      const [label, tone] = run.kinds[strip.kinds[i]], [a, b] = [strip.starts[i], strip.ends[i]];
      const array = strip.f && tone !== "hold" ? `array ${row} ` : "";
      out += `<span><i class="${tone}"></i>${array}${escaped(label)}, ${timed(b - a)}, from ${time(a)} to ${time(b)}</span>`;
    });
    if (lane.g) {
      const p = lane.g.p;
      let told = "<span>not defined</span>";
      for (let i = 0; i < p.length; i += 4) {
        if (p[i] <= tick && tick < p[i + 2]) {
          const value = p[i + 1] + (p[i + 3] - p[i + 1]) * (tick - p[i]) / (p[i + 2] - p[i]);
          told = `<span>${lane.g.ticks ? timed(value) : Math.round(value)}</span>`;
        }
      }
      out += told;
    }
    return out + `<span>at ${timed(tick, 1)}</span>`;
  }

  function point(event) {
    const box = detail.getBoundingClientRect(), x = event.clientX - box.left, y = event.clientY - box.top - HEAD;
    const cursor = by("cursor");
    const inside = x >= view.left && x <= view.right && y > -HEAD;
    tip.hidden = !inside;
    cursor.setAttribute("d", inside ? `M${px(x)} -4V${run.height}` : "");
    if (!inside) return;
    const lane = run.lanes.find((lane) => y >= lane.y - 4 && y <= lane.y + lane.h + 4);
    tip.innerHTML = read(lane, tickAt(x), y);
    for (const tell of pointed) tell(tickAt(x));
    const width = tip.offsetWidth, room = stage.clientWidth;
    tip.style.left = `${Math.max(0, Math.min(x + 14, room - width))}px`;
    // Below the lane that is pointed at, never over it; above the last one.
    const [top, bottom] = lane ? [lane.y, lane.y + lane.h] : [y - 10, y + 10];
    const below = bottom + HEAD + 5, fits = below + tip.offsetHeight <= run.height + HEAD;
    tip.style.top = `${fits ? below : Math.max(0, top + HEAD - 5 - tip.offsetHeight)}px`;
  }

  // Where a button was pressed, as long as it may still be a click.
  let pressed = null;
  const fingers = new Map();
  detail.addEventListener("pointerdown", (event) => {
    if (event.button) return;
    fingers.set(event.pointerId, event.clientX);
    pressed = fingers.size === 1 ? event.clientX : null;
    detail.setPointerCapture(event.pointerId);
    detail.classList.add("moving");
  });
  detail.addEventListener("pointermove", (event) => {
    if (!fingers.has(event.pointerId)) return point(event);
    tip.hidden = true;
    if (pressed !== null && Math.abs(event.clientX - pressed) > 3) pressed = null;
    const before = [...fingers.values()];
    fingers.set(event.pointerId, event.clientX);
    const now = [...fingers.values()];
    if (before.length === 1) return move((before[0] - now[0]) / view.scale);
    const spread = Math.abs(before[0] - before[1]) / Math.max(20, Math.abs(now[0] - now[1]));
    zoom(spread, tickAt((now[0] + now[1]) / 2 - detail.getBoundingClientRect().left));
  });
  for (const name of ["pointerup", "pointercancel"]) {
    detail.addEventListener(name, (event) => { fingers.delete(event.pointerId); detail.classList.remove("moving"); });
  }
  detail.addEventListener("click", (event) => {
    const x = event.clientX - detail.getBoundingClientRect().left;
    if (pressed !== null && heard.picked && x >= view.left && x <= view.right) heard.picked(tickAt(x));
  });
  detail.addEventListener("pointerleave", () => { tip.hidden = true; by("cursor").setAttribute("d", ""); });
  detail.addEventListener("dblclick", (event) => zoom(0.5, tickAt(event.clientX - detail.getBoundingClientRect().left)));
  detail.addEventListener("wheel", (event) => {
    const sideways = event.shiftKey ? event.deltaY || event.deltaX : event.deltaX;
    if (event.ctrlKey || event.metaKey) zoom(Math.exp(event.deltaY * 0.002), tickAt(event.clientX - detail.getBoundingClientRect().left));
    else if (sideways) move(sideways / view.scale);
    else return;
    event.preventDefault();
  }, { passive: false });

  let grip = null;
  whole.addEventListener("pointerdown", (event) => {
    if (!strip.contains(event.target)) return;
    whole.setPointerCapture(event.pointerId);
    const tick = stripTick(event);
    if (tick < from || tick > to) jump(tick, to - from);
    grip = tick - Math.min(Math.max(tick - (to - from) / 2, 0), run.shown - to + from);
    if (tick >= from && tick <= to) grip = tick - from;
  });
  whole.addEventListener("pointermove", (event) => { if (grip !== null) move(stripTick(event) - grip - from); });
  for (const name of ["pointerup", "pointercancel"]) whole.addEventListener(name, () => { grip = null; });
  function stripTick(event) {
    const box = strip.getBoundingClientRect();
    return (event.clientX - box.left) / box.width * run.shown;
  }

  detail.tabIndex = 0;
  detail.addEventListener("keydown", (event) => {
    const action = actions[keys[event.key]];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    action();
    event.preventDefault();
  });
  root.addEventListener("click", (event) => {
    const button = event.target.closest("[data-do]"), link = event.target.closest("[data-at]");
    if (button) actions[button.dataset.do]();
    if (link) {
      jump(Number(link.dataset.at), run.window);
      by("timeline").scrollIntoView();
      event.preventDefault();
    }
  });
  /** Hides what leads nowhere. */
  function offer() {
    const [a, b] = [from, to];
    [from, to] = [-1, -1];
    for (const kind of ["wait", "miss"]) root.querySelector(`[data-do="${kind}"]`).hidden = next(kind) === Infinity;
    [from, to] = [a, b];
  }

  /** Goes on with more of the same run; whoever looks at its end goes on looking at it. */
  function take(more, drawn) {
    const atEnd = to >= run.shown - 1e-6, length = to - from;
    run = more;
    ({ HEAD, RIGHT, px, escaped, lower, time, timed, viewOf, drawTimeline } = drawn);
    strip = by("overview");
    offer();
    if (all) show(0, run.shown);
    else if (atEnd) show(run.shown - Math.max(length, Math.min(run.window, run.shown)), run.shown);
    else show(from, to);
  }

  offer();
  by("controls").hidden = false;
  new ResizeObserver(() => show(from, to)).observe(stage);
  show(from, to);
  return {
    show, mark, take, pointed,
    window: () => [from, to],
    place: (tick) => { moment = tick; },
    go: (start, end) => { moved = true; show(start, end); },
  };
}
