// Draws a window of a run as SVG text, as the still drawing of the page is drawn. SYNC(drawing), SYNC(run data)
//
// In: the data of a run. Out: what draws windows of it, and what reads them off. The page of a report and the studio use it.
"use strict";

function drawingOf(run) {
  const HEAD = 22, RIGHT = 14, FINE = 2.2, COLUMN = 3, RHYTHM = 14, APART = 78, WAYS_APART = 14, LINES_APART = 7;
  const HEIGHT = { idle: 0, undef: 0.24, work: 0.72, hold: 0.72, wait: 1 };
  const TONES = ["idle", "work", "read", "write", "hold", "message", "other", "wait", "readplace", "writeplace"];

  const px = (n) => String(Math.round(n * 100) / 100);
  const escaped = (text) => text.replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);

  function ticks(text) {
    let at = 0;
    return text ? text.split(" ").map((n) => (at += parseInt(n, 36))) : [];
  }

  function spans(text) {
    const starts = [], ends = [], kinds = [];
    let at = 0;
    for (const [, letters, length] of text.matchAll(/([A-Z]+|_)([0-9a-z]+)/g)) {
      const end = at + parseInt(length, 36);
      if (letters !== "_") {
        let kind = 0;
        for (const c of letters) kind = kind * 26 + c.charCodeAt(0) - 65;
        starts.push(at); ends.push(end); kinds.push(kind);
      }
      at = end;
    }
    return { starts, ends, kinds };
  }

  for (const lane of run.lanes) {
    for (const strip of lane.s) Object.assign(strip, spans(strip.d));
    lane.lines = ticks(lane.l);
    lane.deadlines = lane.dl ? lane.lines.map((tick) => tick + lane.dl) : [];
    lane.crosses = ticks(lane.x);
  }
  const ways = run.flow ? run.flow.ways.map(ticks) : [];

  /** The first index whose item is at least `wanted`. */
  function lower(items, wanted) {
    let from = 0, to = items.length;
    while (from < to) {
      const middle = (from + to) >> 1;
      if (items[middle] < wanted) from = middle + 1; else to = middle;
    }
    return from;
  }

  /** Indices of the spans that reach into a window. */
  const within = (strip, start, end) => [lower(strip.ends, start + 1e-9), lower(strip.starts, end)];

  function time(tick, spare) {
    const [whole, rest] = (tick * run.factor).toFixed(run.decimals + (spare || 0)).split(".");
    const grouped = whole.length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, "\u202f") : whole;
    return rest ? grouped + "." + rest : grouped;
  }
  const timed = (tick, spare) => time(tick, spare) + "\u202f" + run.unit;

  const brush = document.createElement("canvas").getContext("2d");
  function textWidth(text, size) {
    brush.font = size + "px system-ui, sans-serif";
    return brush.measureText(text).width;
  }
  function fitted(text, size, width) {
    if (textWidth(text, size) <= width) return text;
    // What stands in the brackets at its end is kept if it is short: by their arguments the locations of a function differ.
    let kept = text.endsWith(")") && text.includes("(") ? text.slice(text.indexOf("(")) : "";
    if (textWidth(kept, size) > width * 0.7) kept = "";
    let cut = text.slice(0, text.length - kept.length);
    while (cut && textWidth(cut.trimEnd() + "\u2026" + kept, size) > width) cut = cut.slice(0, -1);
    return cut.trimEnd() + "\u2026" + kept;
  }

  function viewOf(start, end, width) {
    const left = Math.min(168, width * 0.3), right = width - RIGHT, scale = (right - left) / (end - start);
    const x = (tick) => left + (tick - start) * scale;
    return { start, end, width, left, right, scale, x, clamped: (tick) => x(Math.min(Math.max(tick, start), end)) };
  }

  const boxPath = (x, y, w, h) => `M${px(x)} ${px(y)}h${px(w)}v${px(h)}h-${px(w)}z`;

  const labelWidth = (label) => [...label].reduce((sum, c) => sum + (c === "." ? 0.28 : 0.57), 0) * 11;

  function drawAxis(view) {
    const least = APART / view.scale * run.factor, power = 10 ** Math.floor(Math.log10(least));
    const unitStep = power * [1, 2, 5, 10].find((factor) => power * factor >= least * 0.999);
    const step = Math.max(1, unitStep / run.factor);
    let lines = "", labels = "";
    for (let index = Math.ceil(view.start / step - 1e-9); index * step <= view.end + 1e-6; index++) {
      const x = view.x(index * step), label = String(parseFloat((index * step * run.factor).toFixed(3)));
      lines += `M${px(x)} -4V${px(run.height)}`;
      labels += `<text x="${px(Math.min(x, view.width - labelWidth(label) / 2))}" y="-9">${label}</text>`;
    }
    return `<path class="grid" d="${lines}"/><g class="ticks">${labels}<text class="unit" x="${px(view.left - 26)}" y="-9">${run.unit}</text></g>`;
  }

  function drawLabels(lane, view) {
    let out = lane.hd ? `<text class="heading" x="0" y="${px(lane.hd[1])}">${escaped(lane.hd[0])}</text>` : "";
    const room = view.left - 12 - (lane.h > 40 ? 30 : 0), middle = Math.min(lane.y + lane.h / 2, lane.y + 17);
    const name = fitted(lane.n, 13, room), caption = fitted(lane.c, 11, room);
    const whole = name !== lane.n || caption !== lane.c ? `<title>${escaped(`${lane.n} ${lane.c}`.trimEnd())}</title>` : "";
    out += `<g>${whole}<text class="name" x="0" y="${px(middle + (lane.c ? -1.5 : 4))}">${escaped(name)}</text>`;
    return out + (lane.c ? `<text class="caption" x="0" y="${px(middle + 11.5)}">${escaped(caption)}</text>` : "") + "</g>";
  }

  /** Columns of whole periods where there is a short period, at multiples of their length. */
  function drawStacked(strip, from, to, view) {
    const fine = COLUMN / view.scale;
    const length = strip.r && strip.r * view.scale <= RHYTHM ? strip.r * Math.ceil(fine / strip.r) : fine;
    const first = Math.floor(view.start / length), count = Math.max(1, Math.ceil(view.end / length) - first);
    const begin = (c) => Math.max((first + c) * length, view.start), end = (c) => Math.min((first + c + 1) * length, view.end);
    const shares = TONES.map(() => null);
    for (let i = from; i < to; i++) {
      const place = TONES.indexOf(run.kinds[strip.kinds[i]][1]);
      if (place <= 0) continue;
      const share = shares[place] || (shares[place] = new Float64Array(count));
      const a = Math.max(strip.starts[i], view.start), b = Math.min(strip.ends[i], view.end);
      for (let c = Math.floor(a / length) - first; c < Math.min(Math.ceil(b / length) - first, count); c++) {
        share[c] += Math.max(0, Math.min(b, end(c)) - Math.max(a, begin(c))) / (end(c) - begin(c));
      }
    }
    const base = new Float64Array(count).fill(strip.y + strip.h);
    return shares.map((share, place) => {
      let path = "";
      for (let c = 0; share && c < count; c++) {
        if (!(share[c] > 0.001)) continue;
        const height = Math.min(1, share[c]) * strip.h, x = view.x(begin(c));
        base[c] -= height;
        path += boxPath(x, base[c], view.x(end(c)) - x, height);
      }
      return path && `<path class="${TONES[place]}" d="${path}"/>`;
    }).join("");
  }

  function drawStrip(strip, view) {
    const [from, to] = within(strip, view.start, view.end);
    if (from >= to) return "";
    const drawn = view.clamped(strip.ends[to - 1]) - view.clamped(strip.starts[from]);
    if (drawn / (to - from) < FINE) return drawStacked(strip, from, to, view);
    const paths = {};
    let words = "";
    for (let i = from; i < to; i++) {
      const [label, tone] = run.kinds[strip.kinds[i]];
      if (tone === "idle") continue;
      const x = view.clamped(strip.starts[i]), wide = view.clamped(strip.ends[i]) - x, width = wide - (wide > 4 ? 0.6 : 0);
      const height = strip.f ? strip.h : strip.h * (tone in HEIGHT ? HEIGHT[tone] : 0.86);
      paths[tone] = (paths[tone] || "") + boxPath(x, strip.y + (strip.h - height) / 2, width, height);
      if (!strip.f && tone !== "undef" && width > 24 && width >= textWidth(label, 10.5) + 10) {
        words += `<text class="word on-${tone}" x="${px(x + 5)}" y="${px(strip.y + strip.h / 2 + 3.6)}">${escaped(label)}</text>`;
      }
    }
    return [...TONES, "undef"].map((tone) => paths[tone] ? `<path class="${tone}" d="${paths[tone]}"/>` : "").join("") + words;
  }

  function visible(items, view, least) {
    const from = lower(items, view.start), to = lower(items, view.end + 1e-9);
    return (to - from) * least > view.right - view.left ? [] : items.slice(from, to);
  }

  function drawLane(lane, view) {
    const lines = visible(lane.lines, view, LINES_APART).map((tick) => `M${px(view.x(tick))} ${px(lane.y - 2)}V${px(lane.y + lane.h + 2)}`).join("");
    const due = lane.lk === "due", middle = px(lane.y + lane.h / 2);
    let out = due && lane.s.length ? `<path class="base" d="M${px(view.left)} ${middle}H${px(view.right)}"/><path class="due" d="${lines}"/>` : "";
    const ends = visible(lane.deadlines, view, LINES_APART).map((tick) => `M${px(view.x(tick))} ${px(lane.y - 2)}V${px(lane.y + lane.h + 2)}`).join("");
    if (ends) out += `<path class="deadline" d="${ends}"/>`;
    for (const strip of lane.s) out += drawStrip(strip, view);
    if (!due) out += `<path class="swap" d="${lines}"/>`;
    for (const tick of visible(lane.crosses, view, 1)) out += `<path class="miss" d="M${px(view.x(tick))} ${px(lane.y + 5)}l4 -6h-8z"/>`;
    return out;
  }

  function drawWays(view) {
    if (!run.flow) return "";
    const stops = run.flow.lanes.map((index) => run.lanes[index]);
    const seen = ways.map((times, number) => [times, number]).filter(([times]) => times[0] < view.end && times[times.length - 1] > view.start && times.length > 1);
    if (seen.length * WAYS_APART > view.right - view.left) return "";
    return seen.map(([times, number]) => {
      let path = "", dots = "";
      times.forEach((tick, hop) => {
        const x = view.x(tick), y = stops[hop].y + stops[hop].h / 2, before = stops[hop - 1];
        path += hop ? `V${px(before.y + before.h + (number % 2 ? 5.5 : 2.5))}H${px(x)}V${px(y)}` : `M${px(x)} ${px(y)}`;
        dots += `M${px(x)} ${px(y)}m-2.4 0a2.4 2.4 0 1 0 4.8 0a2.4 2.4 0 1 0 -4.8 0`;
      });
      const lost = times.length === stops.length ? "" : " lost";
      return `<path class="way${lost}" d="${path}"/><path class="hop${lost}" d="${dots}"/>`;
    }).join("");
  }

  /** For each pixel column with something in it: from the least to the greatest value. */
  function extremes(pieces) {
    const columns = [];
    for (const [from, first, to, last] of pieces) {
      const value = (x) => first + (last - first) * (to > from ? (x - from) / (to - from) : 0);
      for (let x = Math.floor(from); x < to; x++) {
        const a = value(Math.max(x, from)), b = value(Math.min(x + 1, to)), column = columns[columns.length - 1];
        const low = Math.min(a, b), high = Math.max(a, b);
        if (column && column[0] === x) { column[1] = Math.min(column[1], low); column[3] = Math.max(column[3], high); }
        else columns.push([x, low, x + 1, high]);
      }
    }
    return columns;
  }

  function drawGraph(lane, view) {
    const graph = lane.g, bottom = lane.y + lane.h;
    const share = (value) => Math.min(Math.max((value - graph.low) / (graph.top - graph.low), 0), 1);
    const place = (value) => bottom - share(value) * (lane.h - graph.head), zero = place(0);
    let pieces = [], line = "", area = "", at = -Infinity;
    for (let i = 0; i < graph.p.length; i += 4) {
      const start = graph.p[i], from = graph.p[i + 1], end = graph.p[i + 2], to = graph.p[i + 3];
      if (end <= view.start || start >= view.end) continue;
      const value = (tick) => from + (to - from) * (tick - start) / (end - start);
      const first = Math.max(start, view.start), last = Math.min(end, view.end);
      pieces.push([view.x(first), value(first), view.x(last), value(last)]);
    }
    if (pieces.length > 2 * (view.right - view.left)) pieces = extremes(pieces);
    for (const [x1, v1, x2, v2] of pieces) {
      const a = `${px(x1)} ${px(place(v1))}`, b = `${px(x2)} ${px(place(v2))}`;
      line += `${x1 - at < 1e-6 ? "L" : "M"}${a}L${b}`;
      area += `M${px(x1)} ${px(zero)}L${a}L${b}V${px(zero)}z`;
      at = x2;
    }
    let out = `<path class="base" d="M${px(view.left)} ${px(zero)}H${px(view.right)}"/><path class="area" d="${area}"/><path class="curve" d="${line}"/>`;
    if (graph.bound !== undefined) {
      const y = place(graph.bound);
      out += `<path class="bound" d="M${px(view.left)} ${px(y)}H${px(view.right)}"/><text class="boundlabel" x="${px(view.right)}" y="${px(lane.y + 10)}">${escaped(graph.label)}</text>`;
    }
    if (lane.h > 40) {
      const x = px(view.left - 6), told = (value) => graph.ticks ? time(value) : value, top = told(graph.top);
      out += `<g class="scale"><text x="${x}" y="${px(place(graph.top) + 8)}">${top}</text><text x="${x}" y="${px(bottom)}">${graph.low < 0 ? told(graph.low) : 0}</text></g>`;
    }
    return out;
  }

  /** The lanes of a window as markup. */
  function drawTimeline(view) {
    const all = (draw) => run.lanes.map((lane) => draw(lane, view)).join("");
    const clip = `<clipPath id="window"><rect x="${px(view.left - 0.5)}" y="-6" width="${px(view.right - view.left + 1)}" height="${px(run.height + 6)}"/></clipPath>`;
    const graphs = run.lanes.filter((lane) => lane.g).map((lane) => drawGraph(lane, view)).join("");
    return `<g transform="translate(0 ${HEAD})">${drawAxis(view)}${all(drawLabels)}${clip}<g clip-path="url(#window)">${all(drawLane)}${drawWays(view)}</g>${graphs}<path id="mark" d=""/><path id="cursor" d=""/></g>`;
  }

  return { HEAD, RIGHT, px, escaped, spans, lower, time, timed, textWidth, viewOf, drawTimeline };
}
