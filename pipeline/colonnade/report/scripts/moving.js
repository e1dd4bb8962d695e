// The block as it moves: measured, and each model's ghost, on the recorded motion of the base, at the cursor's time.
"use strict";

colonnade.MovingBlock = class {
  constructor(given, page) {
    Object.assign(this, { given, page });
    const read = (curve, name) => (curve && curve[name] !== undefined ? page.series[curve[name]] : null);
    const ready = (part) => {
      const [clockOf, of] = [page.clocks[part.clock], read(part, "values")];
      return { place: [0, 0], ...part, clockOf, of, slides: read(part, "slide"), rises: read(part, "rise"), end: clockOf.at(of.findLastIndex(Number.isFinite)) };
    };
    this.bodies = given.bodies.map((body) => ({ ...body, parts: body.parts.map(ready) }));
    this.base = given.base && { clockOf: page.clocks[given.base.clock], of: read(given.base, "values") };
    this.height = given.height;
    const reaches = this.bodies.flatMap((body) => body.parts.flatMap((part) => part.outline.map(([x]) => Math.abs(part.place[0] + x))));
    this.wide = Math.max(0.75 * this.height, 1.2 * Math.max(...reaches));
    this.furthest = this.base ? this.base.of.reduce((most, value) => Math.max(most, Math.abs(value) || 0), 0) / 1000 : 0;
    this.canvas = colonnade.element("canvas", { role: "img", "aria-label": "The block at the cursor's time: measured filled, models as outlines" });
    this.said = colonnade.element("p", { class: "soft" });
    this.root = colonnade.element("div", { class: "moving" }, this.canvas, this.said);
  }

  // Corners of the block turned by an angle about its pole, the right one if it turns to the right, with a slide (m).
  static corners(outline, poles, angle, slide) {
    const pole = poles[angle < 0 ? 0 : 1];
    const [cosine, sine] = [Math.cos(angle), Math.sin(angle)];
    return outline.map(([x, z]) => [pole + slide + (x - pole) * cosine + z * sine, z * cosine - (x - pole) * sine]);
  }

  draw() {
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    if (!width || !height) return;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    const context = this.canvas.getContext("2d");
    const floor = height - 34;
    const scale = Math.min((floor - 8) / (1.06 * this.height), width / (2 * (this.furthest + this.wide)));
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const time = this.page.cursor;
    const moved = this.base ? valueAt(this.base, time) / 1000 : 0;
    const at = ([x, z]) => [width / 2 + (moved + x) * scale, floor - z * scale];
    this.drawTable(context, width, floor, scale, moved);
    const said = [];
    for (const body of [...this.bodies].reverse()) {
      const isMeasured = body.name === "measured";
      for (const part of body.parts) {
        // Past its end a history keeps its last value: an overturned block stays where it fell.
        const value = valueAt(part, Math.min(time, part.end), NaN);
        const angle = part.is_angle ? value : colonnade.angle(value, this.page.critical);
        if (!Number.isFinite(angle)) continue;
        const [slide, rise] = [part.slides, part.rises].map((of) => (of ? valueAt({ clockOf: part.clockOf, of }, Math.min(time, part.end)) / 1000 : 0));
        const turned = colonnade.MovingBlock.corners(part.outline, part.poles, angle, slide);
        const corners = turned.map(([x, z]) => at([part.place[0] + x, part.place[1] + rise + z]));
        context.beginPath();
        corners.forEach(([x, y], index) => (index ? context.lineTo(x, y) : context.moveTo(x, y)));
        context.closePath();
        context.strokeStyle = colonnade.colour(body.colour);
        context.lineWidth = isMeasured ? 1.5 : 1.3;
        context.setLineDash(isMeasured ? [] : [5, 3]);
        if (isMeasured) {
          context.globalAlpha = 0.18;
          context.fillStyle = colonnade.colour("soft");
          context.fill();
          context.globalAlpha = 1;
        }
        context.stroke();
        if (time <= part.end && body.parts.length === 1) said.unshift(`${body.name} θ = ${colonnade.written(1e3 * angle, 3, 100)} mrad`);
      }
    }
    context.setLineDash([]);
    const base = this.base ? `base at ${colonnade.written(1000 * moved, 3, 10)} mm` : "";
    this.said.textContent = [`${time.toFixed(2)} s`, ...said, base].filter(Boolean).join(", ") + `. To scale; ${this.given.how}.`;
    this.drawn = { time, moved, said };
  }

  drawTable(context, width, floor, scale, moved) {
    const [ink, soft] = [colonnade.colour("ink"), colonnade.colour("soft")];
    const reach = 0.6 * this.height * scale;
    const middle = width / 2 + moved * scale;
    context.clearRect(0, 0, width, floor + 40);
    context.fillStyle = soft;
    context.globalAlpha = 0.25;
    context.fillRect(middle - reach, floor, 2 * reach, 9);
    context.globalAlpha = 1;
    context.strokeStyle = ink;
    context.lineWidth = 1;
    context.setLineDash([]);
    context.strokeRect(middle - reach, floor, 2 * reach, 9);
    context.beginPath(); // where the table stands at rest
    context.moveTo(width / 2, floor + 11);
    context.lineTo(width / 2, floor + 18);
    context.stroke();
    const length = 10 ** Math.floor(Math.log10(0.8 * this.height)); // a bar of 0.01, 0.1 or 1 m
    context.beginPath();
    context.moveTo(10, floor + 20);
    context.lineTo(10 + length * scale, floor + 20);
    context.stroke();
    context.fillStyle = soft;
    context.font = "12px system-ui, sans-serif";
    context.fillText(`${1000 * length} mm`, 10, floor + 33);
  }
};

// Value of a series at the sample next to a time; what is missing counts as nothing.
function valueAt(curve, time, missing = 0) {
  const index = curve.clockOf.nearest(time);
  const value = index < 0 ? NaN : curve.of[index];
  return Number.isFinite(value) ? value : missing;
}
