// Lights in the charts where each machine is at a moment of the run. The page of a report and the studio use it. SYNC(run data)
function lightCharts(root, run, drawing, timeline) {
  const { px, escaped, spans, lower, timed, textWidth } = drawing;
  let moment = null;
  const by = (id) => root.getElementById(id);
  const slider = by("tick"), now = by("now"), play = by("play");
  const boxes = [...root.querySelectorAll(".chartbox")].map((box, index) => {
    const { named, lights } = run.charts[index], svg = box.querySelector(".chart"), parts = new Map();
    for (const part of svg.querySelectorAll("[data-shape]")) parts.set(part.dataset.shape, part);
    for (const light of lights) Object.assign(light, spans(light.d));
    return { box, named, lights, svg, parts, told: box.querySelector(".told"), shown: null, tags: null };
  });

  /** The part in which something is at a tick, or nothing. */
  function at(light, tick) {
    const i = lower(light.ends, tick + 1);
    return light.starts[i] <= tick ? light.parts[light.kinds[i]] : null;
  }

  /** Names of those that are in a part, at its left side. */
  function tag(chart, part, names) {
    const shape = part.querySelector(".shape").getBBox();
    // As large on the screen in a picture made small.
    const k = Math.max(1, chart.svg.viewBox.baseVal.width / Math.max(chart.svg.getBoundingClientRect().width, 1));
    names.forEach((name, row) => {
      const width = textWidth(name, 11) + 18, right = (shape.x + 6) / k;
      const y = (shape.y + shape.height / 2) / k + (row - names.length / 2) * 19 + 1;
      const group = document.createElementNS(chart.svg.namespaceURI, "g");
      group.setAttribute("class", "tag");
      group.setAttribute("transform", `scale(${k})`);
      group.innerHTML = `<rect x="${px(right - width)}" y="${px(y)}" width="${px(width)}" height="17" rx="8.5"/><text x="${px(right - width / 2)}" y="${px(y + 12.5)}">${escaped(name)}</text>`;
      chart.tags.append(group);
    });
  }

  function light(tick) {
    for (const chart of boxes) {
      const found = chart.lights.map((light) => [light.n, at(light, tick)]).filter(([, part]) => part);
      const key = JSON.stringify(found);
      if (chart.shown === key) continue;
      chart.shown = key;
      chart.svg.querySelectorAll(".lit").forEach((part) => part.classList.remove("lit"));
      if (chart.tags) chart.tags.remove();
      chart.tags = document.createElementNS(chart.svg.namespaceURI, "g");
      chart.svg.append(chart.tags);
      chart.box.classList.toggle("idle", !found.length);
      const inside = new Map();
      for (const [name, [id]] of found) {
        const part = chart.parts.get(id);
        if (!part) continue;
        part.classList.add("lit");
        inside.set(part, (inside.get(part) || []).concat(name));
      }
      if (chart.named) for (const [part, names] of inside) tag(chart, part, names);
      chart.told.textContent = found.map(([name, [, label]]) => (name ? `${name}: ${label}` : label)).join(" \u00b7 ") || "in none";
    }
  }

  function set(tick) {
    const before = moment;
    moment = Math.min(Math.max(Math.floor(tick), 0), run.shown - 1);
    if (moment === before) return;
    slider.value = moment;
    const step = `step ${moment + run.first}`;
    now.textContent = run.unit === "steps" ? step : `${timed(moment)}, ${step}`;
    slider.setAttribute("aria-valuetext", now.textContent);
    light(moment);
    timeline.place(moment);
    const [from, to] = timeline.window();
    if (moment < from || moment >= to) timeline.show(moment - (to - from) / 4, moment + (to - from) * 3 / 4);
    else timeline.mark();
  }

  let last = 0, place = 0;
  function run_on(time) {
    if (play.getAttribute("aria-pressed") !== "true") return;
    // A first view in twelve seconds; never faster than a step a frame where steps are few.
    place += (time - last) * Math.max(run.window / 12000, 0.005);
    last = time;
    set(place);
    if (place >= run.shown) stop(); else requestAnimationFrame(run_on);
  }
  function stop() {
    play.setAttribute("aria-pressed", "false");
    play.textContent = "Play";
  }
  play.addEventListener("click", () => {
    if (play.getAttribute("aria-pressed") === "true") return stop();
    play.setAttribute("aria-pressed", "true");
    play.textContent = "Pause";
    [place, last] = [moment >= run.shown - 1 ? 0 : moment, performance.now()];
    requestAnimationFrame(run_on);
  });
  slider.addEventListener("input", () => { stop(); set(Number(slider.value)); });
  for (const button of root.querySelectorAll("[data-step]")) {
    button.addEventListener("click", () => { stop(); set(moment + Number(button.dataset.step)); });
  }
  timeline.pointed.push((tick) => { stop(); set(tick); });
  for (const { box, svg } of boxes) {
    const button = box.querySelector(".enlarge");
    button.hidden = false;
    button.addEventListener("click", () => {
      const large = box.classList.toggle("large");
      button.setAttribute("aria-pressed", String(large));
      button.textContent = large ? "Make small" : "Enlarge";
      for (const chart of boxes) chart.shown = null;
      light(moment);
    });
    svg.removeAttribute("width");
    svg.removeAttribute("height");
    svg.style.width = `${svg.viewBox.baseVal.width}px`;
  }
  by("moment").hidden = false;
  const { first } = slider.dataset;
  set(first === undefined ? Math.min(Math.floor(run.window / 3), run.shown - 1) : Number(first));
}
