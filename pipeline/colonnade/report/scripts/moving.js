// The block as it moves: measured, and each model's ghost, on the recorded motion of the base, at the cursor's time.
"use strict";

colonnade.MovingBlock = class {
  constructor(given, page) {
    Object.assign(this, { given, page });
    const series = (curve, name) => (curve && curve[name] !== undefined ? page.series[curve[name]] : null);
    const ready = (body, part) => {
      const [clock, values] = [page.clocks[part.clock], series(part, "values")];
      const shape = colonnade.element("polygon", { points: part.outline.map(([x, z]) => `${x},${-z}`).join(" ") });
      shape.classList.toggle("measured", body.name === "measured");
      shape.style.setProperty("--colour", body.colour);
      return { place: [0, 0], ...part, clock, values, shape, slides: series(part, "slide"), rises: series(part, "rise"), end: clock.at(values.findLastIndex(Number.isFinite)) };
    };
    this.bodies = given.bodies.map((body) => ({ ...body, parts: body.parts.map((part) => ready(body, part)) }));
    this.base = given.base && { clock: page.clocks[given.base.clock], values: series(given.base, "values") };
    const { height } = given;
    const reaches = this.bodies.flatMap(({ parts }) => parts.flatMap(({ outline, place }) => outline.map(([x]) => Math.abs(place[0] + x))));
    const wide = Math.max(0.75 * height, 1.2 * Math.max(...reaches)) + (this.base ? colonnade.largest(this.base.values) / 1000 : 0);
    this.bar = 10 ** Math.floor(Math.log10(0.8 * height)); // m: 0.01, 0.1 or 1
    this.table = colonnade.element("rect", { x: -0.6 * height, y: 0, width: 1.2 * height, height: 0.04 * height });
    const marks = `M0 ${0.05 * height}v${0.04 * height}M${0.1 * height - wide} ${0.12 * height}h${this.bar}`; // where the table rests; the bar
    this.picture = colonnade.element("svg", {
      role: "img",
      viewBox: `${-wide} ${-1.06 * height} ${2 * wide} ${1.2 * height}`,
      "aria-label": "The block at the cursor's time: measured filled, models as outlines",
    }, this.table, colonnade.element("path", { d: marks }), ...this.bodies.flatMap(({ parts }) => parts.map(({ shape }) => shape)).reverse());
    this.said = colonnade.element("p", { class: "soft" });
    this.root = colonnade.element("div", { class: "moving" }, this.picture, this.said);
  }

  // Turned by an angle about its pole, the right one if it turns to the right, and moved (m).
  static turned(poles, angle, across, up) {
    return `translate(${across} ${-up}) rotate(${(180 / Math.PI) * angle} ${poles[angle < 0 ? 0 : 1]} 0)`;
  }

  draw() {
    const time = this.page.cursor;
    const moved = (this.base && colonnade.valueAt(this.base, time)) || 0;
    this.table.setAttribute("transform", `translate(${moved / 1000} 0)`);
    const said = [];
    for (const { name, parts } of this.bodies) {
      for (const part of parts) {
        // Past its end a history keeps its last value: an overturned block stays where it fell.
        const now = Math.min(time, part.end);
        const value = colonnade.valueAt(part, now);
        const angle = part.is_angle ? value : colonnade.angle(value, this.page.critical);
        part.shape.classList.toggle("missing", !Number.isFinite(angle));
        if (!Number.isFinite(angle)) continue;
        const [slide, rise] = [part.slides, part.rises].map((values) => (values && colonnade.valueAt({ clock: part.clock, values }, now)) || 0);
        const [x, z] = part.place;
        part.shape.setAttribute("transform", colonnade.MovingBlock.turned(part.poles, angle, x + (moved + slide) / 1000, z + rise / 1000));
        if (time <= part.end && parts.length === 1) said.push(`${name} θ = ${colonnade.written(1e3 * angle, 3, 100)} mrad`);
      }
    }
    const base = this.base ? `base at ${colonnade.written(moved, 3, 10)} mm` : "";
    this.said.textContent = [`${time.toFixed(2)} s`, ...said, base].filter(Boolean).join(", ") + `. To scale, bar ${1000 * this.bar} mm; ${this.given.how}.`;
  }
};

// Value of a series at the sample next to a time; NaN if it has none there.
colonnade.valueAt = ({ clock, values }, time) => values[clock.nearest(time)] ?? NaN;
