// A page of a report that is watched: it shows the last line of the watch, and loads itself again when the report changed.
// A page that was opened from disk may not read a file, but it may load a script: state.js, which calls `colonnadeState`.
"use strict";

{
  const ASK = 1.5; // s between two looks at the state
  const SILENCE = 6; // times the state's `every` without a sign of life: then the watch has ended, or was killed
  const PAUSE = 3; // s without a touch after which the page may load itself again
  const LONG_PAUSE = 20; // the same while a text is selected, a field has the focus, or a button is held down

  let [opened, latest, address] = [null, null, ""];
  let silent = 0; // looks without a sign of life
  let touched = -Infinity; // ms since the page was opened
  let isHeld = false;
  let place = null;

  window.colonnadeState = function (state) {
    if (!opened) {
      opened = latest = state;
      address = document.currentScript.src;
      if (state.watched) begin();
      say();
      return;
    }
    if (state.written !== latest.written) silent = 0;
    latest = state;
  };

  function begin() {
    const touch = (event) => {
      touched = performance.now();
      if (event.buttons !== undefined) isHeld = event.buttons > 0;
    };
    for (const event of ["pointerdown", "pointermove", "pointerup", "pointercancel", "wheel", "keydown", "input", "scroll", "touchmove"]) {
      addEventListener(event, touch, { capture: true, passive: true });
    }
    setTimeout(ask, 1000 * ASK);
  }

  // Load the state script once more. The number at its end is never the same, so that no old copy is taken.
  function ask() {
    silent += 1;
    const script = colonnade.element("script", { src: `${address}?${Date.now()}` });
    script.onload = script.onerror = () => {
      script.remove();
      goOn();
    };
    document.head.append(script);
  }

  function goOn() {
    const [isDue, isOver] = [latest.shown !== opened.shown, hasEnded()];
    if (isDue && isIdle()) {
      colonnade.loadAgain();
      return;
    }
    say();
    if (isDue || !isOver) setTimeout(isOver ? goOn : ask, 1000 * ASK);
  }

  // Counted in looks, not by a clock: those of two computers differ, and a sleeping one must not take the watch for dead.
  const hasEnded = () => !latest.watched || silent * ASK > SILENCE * latest.every;

  function isIdle() {
    if (!colonnade.is_ready || (colonnade.page && colonnade.page.running)) return false;
    const isInUse = isHeld || !getSelection().isCollapsed || Boolean(document.activeElement?.matches("input, select, textarea"));
    return performance.now() - touched > 1000 * (isInUse ? LONG_PAUSE : PAUSE);
  }

  // In a report that was never watched nothing is said.
  function say() {
    if (!latest.written) return;
    if (!place) {
      place = colonnade.element("div", { class: "watched", role: "status" });
      document.body.append(place);
    }
    const line = latest.line ? `${when(latest.line_written)} ${latest.line}` : "";
    const isDue = latest.shown !== opened.shown;
    const news = isDue ? "The report has changed: this page follows when you pause. " : "";
    const text = news + (hasEnded() ? `The watch has ended. ${line ? `Last: ${line}` : ""}` : `Watched. ${line || "The next test appears here."}`);
    // Only a change is read out.
    if (place.textContent !== text) place.textContent = text;
  }

  // Time of day, with the day if it is not today's.
  function when(seconds) {
    const time = new Date(1000 * seconds);
    const day = time.toLocaleDateString("en-GB", { day: "numeric", month: "long", year: "numeric" });
    const isToday = time.toDateString() === new Date().toDateString();
    return `${isToday ? "" : `${day}, `}${time.toLocaleTimeString("en-GB")}`;
  }
}
