// One panel: its title, a button a curve with the value under the cursor, and the plot, which Bokeh draws.
"use strict";

const LEFT = 64; // px left of the frame of each panel, so that all frames are above each other
const RIGHT = 60; // px right of the frames of a group in which a panel has an axis there
const LARGEST_RATIO = 1.35; // of θ/α: an overturning leaves the axis
const FEW = 0.001; // share of flagged samples that is only noted

// An element with attributes and children; texts are texts, never markup.
colonnade.element = function (tag, attributes = {}, ...children) {
  const isDrawn = ["svg", "polygon", "rect", "path"].includes(tag);
  const made = isDrawn ? document.createElementNS("http://www.w3.org/2000/svg", tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
};

// A colour as it is now: one of the page's own by its name, any other lighter in the dark.
colonnade.colour = function (name) {
  const own = { ink: "--ink", soft: "--soft", line: "--line" }[name];
  if (own) return getComputedStyle(document.documentElement).getPropertyValue(own).trim();
  if (!matchMedia("(prefers-color-scheme: dark)").matches) return name;
  const lighter = [1, 3, 5].map((at) => Math.round(0.6 * parseInt(name.slice(at, at + 2), 16) + 0.4 * 255));
  return `rgb(${lighter.join(", ")})`;
};

// A number with so many digits, but where it is small beside the largest of its kind, only one decimal more than that.
colonnade.written = function (value, digits = 4, largest = Math.abs(value)) {
  if (!Number.isFinite(value)) return "–";
  const decimals = (size) => digits - 1 - Math.floor(Math.log10(size || 1));
  const shown = Math.min(decimals(Math.abs(value)), decimals(largest) + 1);
  return value.toFixed(Math.min(Math.max(shown, 0), 12)).replace("-", "−");
};

colonnade.largest = (values) => values.reduce((most, value) => (Math.abs(value) > most ? Math.abs(value) : most), 0);

// The dashes of a curve as it is drawn, px.
colonnade.dashes = (curve) => (curve.dash || []).map((part) => 1.5 * part);

colonnade.Panel = class {
  constructor(given, group, page) {
    this.given = given;
    this.page = page;
    this.right_border = group.panels.some((panel) => panel.second) ? RIGHT : 12;
    const of = (shown, values) => ({ ...shown, clock: page.clocks[shown.clock], values, largest: colonnade.largest(values) });
    this.curves = given.curves.map((curve) => of(curve, page.series[curve.values]));
    this.bands = (given.bands || []).map((band) => ({ ...of(band, page.series[band.high]), is: "band" }));
    const unit = given.unit ? ` (${given.unit}${given.second ? `; right: ${given.second.unit}` : ""})` : "";
    const level = given.level ? `; dotted: ± ${given.level_name}` : "";
    this.keys = colonnade.element("div", { class: "curves" });
    this.plot = colonnade.element("div", { class: "plot" });
    this.line = colonnade.element("div", { class: "cursor", hidden: "" });
    this.chosen = colonnade.element("div", { class: "chosen", hidden: "" });
    this.box = colonnade.element("div", { class: "plotted" }, this.plot, this.line, this.chosen);
    this.root = colonnade.element("section", { class: "panel" }, colonnade.element("h3", {}, given.title + unit + level), this.keys, this.box);
    for (const shown of [...this.curves, ...this.bands]) this.addKey(shown, `${group.title}, ${given.title}, ${shown.name}`);
    for (const mark of given.marks || []) this.keys.append(colonnade.element("span", { class: "mark soft" }, `┊ ${mark.name}: ${mark.time.toFixed(2)} s`));
    if (given.flags && given.flags.length) this.keys.append(this.flagKey(given.flags, this.curves[0].values.length));
  }

  // A button that turns a curve on and off, with its look and its value.
  addKey(shown, name) {
    shown.is_hidden = this.page.hidden[name] ?? shown.is_hidden;
    const colour = shown.colour;
    const sample = colonnade.element("span", { class: shown.is === "band" ? "sample band" : "sample" });
    sample.style.setProperty("--colour", ["ink", "soft"].includes(colour) ? `var(--${colour})` : colour);
    const ends = colonnade.dashes(shown).reduce((known, part) => [...known, known.at(-1) + part], [0]);
    const parts = ends.slice(1).map((end, index) => `${index % 2 ? "transparent" : "var(--shown, var(--colour))"} ${ends[index]}px ${end}px`);
    if (parts.length) sample.style.setProperty("--dashes", `repeating-linear-gradient(90deg, ${parts.join(", ")})`);
    shown.value = colonnade.element("span", { class: "value" });
    // Room for the longest reading, so that nothing below moves while the cursor does.
    const { is_angle: isAngle, second, unit } = this.given;
    shown.value.style.minWidth = `${shown.is === "band" ? 16 : isAngle ? 21 : (second ? 21 : 10) + (unit || "").length}ch`;
    const button = colonnade.element("button", { type: "button", "aria-pressed": String(!shown.is_hidden) }, sample, shown.name, " ", shown.value);
    button.addEventListener("click", () => {
      this.page.hidden[name] = shown.is_hidden = !shown.is_hidden;
      button.setAttribute("aria-pressed", String(!shown.is_hidden));
      this.draw();
    });
    this.keys.append(button);
  }

  flagKey(flags, samples) {
    const counts = new Map();
    for (const [first, last, flag] of flags) counts.set(flag, (counts.get(flag) || 0) + last - first);
    const said = [...counts].map(([flag, count]) => `${count} ${flag}`).join(", ");
    const isFew = [...counts.values()].reduce((sum, count) => sum + count) <= FEW * samples;
    return colonnade.element("span", { class: isFew ? "mark soft" : "mark differs" }, `× flagged samples: ${said}`);
  }

  async make() {
    const [soft, line] = [colonnade.colour("soft"), colonnade.colour("line")];
    const given = this.given;
    this.x = new Bokeh.Range1d({ start: 0, end: 1 });
    this.y = new Bokeh.Range1d({ start: 0, end: 1 });
    this.figure = new Bokeh.Plotting.Figure({
      x_range: this.x,
      y_range: this.y,
      height: (given.is_angle ? 240 : 150) + (this.is_last ? 20 : 0),
      sizing_mode: "stretch_width",
      toolbar_location: null,
      tools: "",
      min_border_left: LEFT,
      min_border_right: this.right_border,
      min_border_top: 4,
      background_fill_alpha: 0,
      border_fill_alpha: 0,
      outline_line_color: line,
    });
    for (const axis of [this.figure.xaxis, this.figure.yaxis]) {
      axis.axis_line_color = line;
      axis.major_tick_line_color = line;
      axis.minor_tick_line_color = null;
      axis.major_label_text_color = soft;
    }
    if (this.is_last) Object.assign(this.figure.xaxis, { axis_label: "time (s)", axis_label_text_color: soft, axis_label_text_font_style: "normal" });
    this.figure.xgrid.grid_line_color = line;
    this.figure.ygrid.grid_line_color = line;
    for (const band of this.bands) {
      band.source = new Bokeh.ColumnDataSource({ data: { x: [], low: [], high: [] } });
      this.figure.varea({ field: "x" }, { field: "low" }, { field: "high" }, { source: band.source, fill_color: colonnade.colour(band.colour), fill_alpha: 0.2 });
      const edge = { source: band.source, line_color: colonnade.colour(band.colour), line_alpha: 0.6, line_width: 0.8, line_dash: colonnade.dashes(band) };
      for (const field of ["low", "high"]) this.figure.line({ field: "x" }, { field }, edge);
    }
    if (given.level) for (const location of [given.level, -given.level]) this.span({ dimension: "width", location });
    for (const mark of given.marks || []) this.span({ dimension: "height", location: mark.time, line_color: colonnade.colour(mark.colour) });
    for (const curve of this.curves) {
      curve.source = new Bokeh.ColumnDataSource({ data: { x: [], y: [] } });
      const look = { line_color: colonnade.colour(curve.colour), line_width: curve.width, line_dash: colonnade.dashes(curve) };
      this.figure.line({ field: "x" }, { field: "y" }, { source: curve.source, ...look });
    }
    if (given.flags && given.flags.length) {
      this.marked = new Bokeh.ColumnDataSource({ data: { x: [], y: [] } });
      this.figure.scatter({ field: "x" }, { field: "y" }, { source: this.marked, marker: "x", size: 9, line_color: "#d0342c", line_width: 2 });
    }
    if (given.second) {
      this.right = new Bokeh.Range1d({ start: 0, end: 1 });
      this.figure.extra_y_ranges = { second: this.right };
      this.figure.add_layout(new Bokeh.LinearAxis({ y_range_name: "second", axis_line_color: line, major_tick_line_color: line, minor_tick_line_color: null, major_label_text_color: soft }), "right");
    }
    this.draw();
    await Bokeh.Plotting.show(this.figure, this.plot);
  }

  span(given) {
    this.figure.add_layout(new Bokeh.Span({ line_color: colonnade.colour("soft"), line_dash: [2, 4], line_width: 1.2, ...given }));
  }

  // Width of the frame in pixels of the screen, and where a time is in it.
  get pixels() {
    return Math.max(this.box.clientWidth - LEFT - this.right_border, 60);
  }

  place(time) {
    const { from, to } = this.page.view;
    return LEFT + ((time - from) / (to - from)) * this.pixels;
  }

  time(clientX) {
    const { from, to } = this.page.view;
    return from + ((clientX - this.box.getBoundingClientRect().left - LEFT) / this.pixels) * (to - from);
  }

  // Draw what the view shows: thinned to the screen's own pixels.
  draw() {
    if (!this.figure) return;
    const { from, to } = this.page.view;
    const pixels = Math.round(this.pixels * Math.min(window.devicePixelRatio || 1, 2));
    let [low, high] = [Infinity, -Infinity];
    const reach = (values) => {
      for (const value of values) {
        if (value < low) low = value;
        if (value > high) high = value;
      }
    };
    for (const curve of this.curves) {
      const data = curve.is_hidden ? { x: [], y: [] } : colonnade.thinned(curve.clock, curve.values, from, to, pixels);
      curve.source.data = data;
      reach(data.y);
    }
    for (const band of this.bands) {
      const [below, above] = [this.page.series[band.low], this.page.series[band.high]];
      const data = band.is_hidden ? { x: [], low: [], high: [] } : colonnade.thinnedBand(band.clock, below, above, from, to, pixels);
      band.source.data = data;
      reach(data.low);
      reach(data.high);
    }
    if (this.marked) {
      const [curve] = this.curves;
      const flags = curve.is_hidden ? [] : this.given.flags;
      this.marked.data = colonnade.flagged(curve.clock, curve.values, flags, from, to, pixels);
    }
    this.x.setv({ start: from, end: to });
    this.scale(low, high);
  }

  scale(low, high) {
    if (!(low <= high)) [low, high] = [-1, 1];
    if (this.given.is_angle) [low, high] = [Math.max(low, -LARGEST_RATIO), Math.min(high, LARGEST_RATIO)];
    const room = 0.08 * (high - low) || 0.5 * Math.abs(high) || 1;
    const [start, end] = [low - room, high + room];
    this.y.setv({ start, end });
    if (this.right) {
      const { factor, offset } = this.given.second;
      this.right.setv({ start: factor * start + offset, end: factor * end + offset });
    }
  }

  // Show the cursor and the value of each curve at the sample next to it.
  point(time) {
    const place = this.place(time);
    this.line.hidden = place < LEFT || place > LEFT + this.pixels;
    this.line.style.left = `${place}px`;
    for (const curve of this.curves) curve.value.textContent = curve.is_hidden ? "" : this.reading(curve, time);
    for (const band of this.bands) {
      const index = band.is_hidden ? -1 : band.clock.nearest(time);
      const ends = [band.low, band.high].map((end) => colonnade.written(this.page.series[end][index], 3, band.largest));
      band.value.textContent = index < 0 ? "" : ends.join(" to ");
    }
  }

  reading(curve, time) {
    const value = colonnade.valueAt(curve, time);
    if (!Number.isFinite(value)) return "–";
    const { unit, second, is_angle: isAngle } = this.given;
    const text = `${colonnade.written(value, 4, curve.largest)}${unit ? ` ${unit}` : ""}`;
    const also = (of) => colonnade.written(of(value), 4, Math.abs(of(curve.largest)));
    if (isAngle) return `${text} (${also((ratio) => 1e3 * colonnade.angle(ratio, this.page.critical))} mrad)`;
    return second ? `${text} = ${also((one) => second.factor * one + second.offset)} ${second.unit}` : text;
  }
};

// Rocking angle in rad of θ/α; the critical angles are those for θ < 0 and θ > 0.
colonnade.angle = (ratio, critical) => ratio * critical[ratio < 0 ? 0 : 1];
