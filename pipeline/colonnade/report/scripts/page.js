// The page: groups of panels on one axis of time, one view and one cursor for all, by pointer, touch and keyboard.
"use strict";

const CLOSEST = 8; // samples across a view that cannot be zoomed further
const KEYS = "Arrow keys move the cursor (with Shift the view), + and − zoom, 0 or Home resets, the space bar plays.";
const POINTERS = "Drag to move in time, drag with Shift to zoom into a stretch, zoom with Ctrl and the wheel or two fingers, double-click to reset.";

// Called by the page's data file, before the document is ready: its scripts wait for the page but not for each other.
colonnade.show = (given) => Object.assign(colonnade, { given });

document.addEventListener("DOMContentLoaded", async () => {
  const place = document.querySelector("[data-interactive]");
  const { groups, tables } = colonnade.given || {}; // a page that was moved without its data has its pictures alone
  colonnade.keepPlace();
  try {
    if (place && groups && groups.length) await new colonnade.Page(colonnade.given, place).make();
  } finally {
    colonnade.addDownloads(tables || {});
    colonnade.keepChoices();
    colonnade.keepPlace(); // again, now that the page has its height
    colonnade.is_ready = true;
  }
});

colonnade.Page = class {
  constructor(given, place) {
    Object.assign(this, { given, place, critical: given.critical, panels: [], frame: 0, fingers: new Map() });
    Object.assign(this, { opened: {}, hidden: {} }); // groups and curves that the person turned on or off
  }

  async make() {
    Bokeh.set_log_level("error");
    Object.assign(this, await colonnade.samples());
    // Tables have clocks too, of frequencies for one: the view is that of what the panels show.
    const shown = this.given.groups.flatMap(({ panels }) => panels.flatMap(({ curves }) => curves)).map(({ clock }) => this.clocks[clock]);
    this.whole = { from: Math.min(...shown.map((clock) => clock.start)), to: Math.max(...shown.map((clock) => clock.end)) };
    this.shortest = CLOSEST * Math.min(...shown.map((clock) => clock.interval));
    this.view = { ...this.whole };
    this.cursor = this.peak();
    this.addBar();
    this.keepChoices();
    if (this.given.moving) {
      this.block = new colonnade.MovingBlock(this.given.moving, this);
      this.root.append(this.block.root);
    }
    const made = this.given.groups.map((group) => this.addGroup(group));
    this.root.append(this.hint);
    this.place.append(this.root);
    this.place.closest("section").hidden = false;
    await Promise.all(made.map((group) => group.open && this.fill(group)));
    document.documentElement.classList.add("scripted"); // the style sheet hides the picture that the panels replace
    colonnade.page = this;
    this.move(this.cursor);
    new ResizeObserver(() => this.redraw()).observe(this.root);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.repaint());
  }

  keepChoices() {
    const give = () => {
      const { view, whole, cursor, opened, hidden } = this;
      const isWhole = view.from === whole.from && view.to === whole.to; // a longer record is shown whole again
      return { view: isWhole ? null : view, cursor, opened, hidden, speed: this.speed.value };
    };
    colonnade.keep("histories", give, ({ view, speed, ...others }) => {
      Object.assign(this, others);
      this.speed.value = speed;
      if (view) this.look(view.from, view.to);
    });
  }

  // Time of the largest value of the first curve, where the cursor stands at first.
  peak() {
    const [curve] = this.given.groups.find(({ panels }) => panels.length).panels[0].curves;
    const values = this.series[curve.values];
    let best = 0;
    for (let i = 0; i < values.length; i += 1) if (!(Math.abs(values[i]) <= Math.abs(values[best]))) best = values[i] === values[i] ? i : best;
    return this.clocks[curve.clock].at(best);
  }

  addBar() {
    const { button } = colonnade;
    this.time = colonnade.element("span", { class: "time" });
    this.status = colonnade.element("p", { class: "unseen", role: "status" });
    this.playing = button("Play", "Play the motion", () => this.play());
    this.speed = colonnade.element("select", { "aria-label": "Speed of the motion" });
    for (const [speed, text] of [[0.1, "1/10 speed"], [0.25, "1/4 speed"], [1, "real time"]]) this.speed.append(new Option(text, speed, speed === 0.25, speed === 0.25));
    const bar = colonnade.element("div", { class: "bar", role: "toolbar", "aria-label": "View" },
      button("+", "Zoom in", () => this.zoom(0.5)),
      button("−", "Zoom out", () => this.zoom(2)),
      button("Reset", "Show the whole record", () => this.reset()),
      ...(this.given.moving ? [this.playing, this.speed] : []),
      this.time);
    this.hint = colonnade.element("p", { class: "soft hint", id: "interactive-hint" }, `${POINTERS} ${KEYS}`);
    this.root = colonnade.element("div", { class: "panels", tabindex: "0", role: "group", "aria-label": `Histories of ${this.given.page}`, "aria-describedby": "interactive-hint" }, bar, this.status);
    this.root.addEventListener("keydown", (event) => this.press(event));
  }

  addGroup(group) {
    const inside = colonnade.element("div");
    const box = colonnade.element("details", { class: "group-of-panels" }, colonnade.element("summary", {}, group.title), inside);
    if (group.note) box.append(colonnade.element("p", { class: "soft" }, group.note));
    box.open = this.opened[group.title] ?? group.is_open;
    box.addEventListener("toggle", () => {
      this.opened[group.title] = box.open;
      if (box.open) this.fill(box);
    });
    Object.assign(box, { group, inside });
    this.root.append(box);
    return box;
  }

  // Draw the panels of a group when it is first opened.
  async fill(box) {
    if (box.panels || !box.group.panels.length) {
      this.redraw();
      return;
    }
    box.panels = box.group.panels.map((panel) => new colonnade.Panel(panel, box.group, this));
    box.panels.at(-1).is_last = true;
    for (const panel of box.panels) {
      box.inside.append(panel.root);
      panel.is_shown = () => box.open;
      this.listen(panel);
      await panel.make();
      this.panels.push(panel);
      panel.point(this.cursor);
    }
    const { title, panels } = box.group;
    const name = `${this.given.page}-${title.toLowerCase().replace(/[^a-z]+/g, "-")}.csv`;
    const table = async () => colonnade.save(name, ["\ufeff", await colonnade.tableOf(panels, this)], "text/csv");
    box.inside.append(colonnade.element("p", { class: "downloads" }, "All samples:", colonnade.button("CSV", `${title}, all samples as CSV`, table)));
  }

  // Bokeh keeps the colours it was given: in another light the plots are made again.
  async repaint() {
    for (const panel of this.panels) {
      panel.plot.replaceChildren();
      await panel.make();
    }
  }

  listen(panel) {
    const box = panel.box;
    let dragged = null;
    box.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      this.stop();
      this.fingers.set(event.pointerId, event.clientX);
      box.setPointerCapture(event.pointerId);
      dragged = { at: event.clientX, time: panel.time(event.clientX), view: { ...this.view }, isChoice: event.shiftKey };
    });
    box.addEventListener("pointermove", (event) => {
      if (!dragged || !this.fingers.has(event.pointerId)) {
        this.move(panel.time(event.clientX));
        return;
      }
      const before = [...this.fingers.values()];
      this.fingers.set(event.pointerId, event.clientX);
      const now = [...this.fingers.values()];
      if (now.length === 2) {
        const ratio = Math.abs(before[0] - before[1]) / Math.max(Math.abs(now[0] - now[1]), 1);
        this.zoom(ratio, panel.time((now[0] + now[1]) / 2));
      } else if (dragged.isChoice) panel.choose(dragged.at, event.clientX);
      else {
        const shift = ((dragged.at - event.clientX) / panel.pixels) * (dragged.view.to - dragged.view.from);
        this.look(dragged.view.from + shift, dragged.view.to + shift);
      }
    });
    const end = (event) => {
      this.fingers.delete(event.pointerId);
      if (dragged && dragged.isChoice && event.type === "pointerup") {
        const times = [dragged.time, panel.time(event.clientX)].sort((one, other) => one - other);
        if (Math.abs(dragged.at - event.clientX) > 4) this.look(...times);
      }
      panel.chosen.hidden = true;
      dragged = null;
    };
    box.addEventListener("pointerup", end);
    box.addEventListener("pointercancel", end);
    box.addEventListener("dblclick", () => this.reset());
    box.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      this.zoom(Math.exp(Math.max(-1, Math.min(1, event.deltaY / 200))), panel.time(event.clientX));
    }, { passive: false });
  }

  press(event) {
    if (event.target.closest("button, select, summary, input") && [" ", "Enter"].includes(event.key)) return;
    if (event.target.closest("select") || event.ctrlKey || event.metaKey || event.altKey) return;
    const width = this.view.to - this.view.from;
    const step = width / (this.panels.length ? this.panels[0].pixels : 600);
    const turn = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (turn && event.shiftKey) this.look(this.view.from + 0.1 * turn * width, this.view.to + 0.1 * turn * width);
    else if (turn) this.follow(this.cursor + turn * Math.max(step, this.shortest / CLOSEST));
    else if (event.key === "+" || event.key === "=") this.zoom(0.5);
    else if (event.key === "-" || event.key === "−") this.zoom(2);
    else if (event.key === "0" || event.key === "Home") this.reset();
    else if (event.key === " " && this.block) this.play();
    else return;
    event.preventDefault();
  }

  // Zoom by a factor about a time, the cursor's if none is given and it is in view.
  zoom(factor, about = this.cursor) {
    const { from, to } = this.view;
    const fixed = about >= from && about <= to ? about : (from + to) / 2;
    const width = Math.min(Math.max((to - from) * factor, this.shortest), this.whole.to - this.whole.from);
    const share = (fixed - from) / (to - from);
    this.look(fixed - share * width, fixed + (1 - share) * width);
  }

  // Show a stretch, moved into the record where it leaves it.
  look(from, to) {
    const width = Math.min(Math.max(to - from, this.shortest), this.whole.to - this.whole.from);
    const first = Math.min(Math.max(from, this.whole.from), this.whole.to - width);
    this.view = { from: first, to: first + width };
    this.redraw();
  }

  reset() {
    this.look(this.whole.from, this.whole.to);
  }

  redraw() {
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      for (const panel of this.panels.filter(({ is_shown: isShown }) => isShown())) {
        panel.draw();
        panel.point(this.cursor);
      }
      if (this.block) this.block.draw();
    });
  }

  move(time) {
    this.cursor = Math.min(Math.max(time, this.whole.from), this.whole.to);
    this.time.textContent = `time ${this.cursor.toFixed(3)} s`;
    for (const panel of this.panels) panel.point(this.cursor);
    if (this.block) this.block.draw();
  }

  // Move the cursor by keyboard: the view follows, and what is there is said.
  follow(time) {
    this.move(time);
    const { from, to } = this.view;
    if (this.cursor < from || this.cursor > to) this.look(this.cursor - (to - from) / 2, this.cursor + (to - from) / 2);
    if (this.panels.length) {
      const [panel] = this.panels;
      const said = panel.curves.filter((curve) => !curve.is_hidden).map((curve) => `${curve.name} ${panel.reading(curve, this.cursor)}`);
      this.status.textContent = `${this.cursor.toFixed(3)} s: ${said.join(", ")}`;
    }
  }

  play() {
    if (this.running) {
      this.stop();
      return;
    }
    if (this.cursor < this.view.from || this.cursor >= this.view.to - 1e-9) this.move(this.view.from);
    this.playing.textContent = "Pause";
    let before = null;
    const step = (now) => {
      if (before !== null) this.move(this.cursor + ((now - before) / 1000) * Number(this.speed.value));
      before = now;
      if (this.cursor >= Math.min(this.view.to, this.whole.to)) this.stop();
      else this.running = requestAnimationFrame(step);
    };
    this.running = requestAnimationFrame(step);
  }

  stop() {
    if (this.running) cancelAnimationFrame(this.running);
    this.running = 0;
    this.playing.textContent = "Play";
  }
};

colonnade.Panel.prototype.choose = function (from, to) {
  const left = this.box.getBoundingClientRect().left;
  this.chosen.hidden = false;
  this.chosen.style.left = `${Math.min(from, to) - left}px`;
  this.chosen.style.width = `${Math.abs(to - from)}px`;
};
