// What a page keeps when it loads itself again: what the person chose, and where they were.
"use strict";

{
  const name = `colonnade ${location.pathname}`;
  const givers = new Map();
  let kept = {};
  try {
    kept = JSON.parse(sessionStorage.getItem(name)) || {};
    sessionStorage.removeItem(name);
  } catch {} // a browser without storage: the page begins anew

  // Keep what `give` returns; `take` gets it, at once, in a page that has loaded itself again.
  colonnade.keep = function (subject, give, take) {
    givers.set(subject, give);
    if (subject in kept) take(kept[subject]);
  };

  colonnade.loadAgain = function () {
    try {
      sessionStorage.setItem(name, JSON.stringify(Object.fromEntries([...givers].map(([subject, give]) => [subject, give()]))));
      history.scrollRestoration = "manual";
    } catch {}
    location.reload();
  };

  // A path to an element that holds while other kinds of element come and go around it.
  function pathTo(element) {
    if (element.id) return `#${CSS.escape(element.id)}`;
    if (element === document.body) return "body";
    const alike = [...element.parentElement.children].filter(({ localName }) => localName === element.localName);
    return `${pathTo(element.parentElement)} > ${element.localName}:nth-of-type(${alike.indexOf(element) + 1})`;
  }

  const found = (path) => (path ? document.querySelector(path) : null);
  const pathsTo = (selector) => [...document.querySelectorAll(selector)].map(pathTo);
  const WIDE = ".scroll";
  const DETAILS = "details:not(.group-of-panels)"; // a group of panels draws them when it opens: the page keeps it

  // What is open, how far wide boxes are scrolled, and what has the focus.
  colonnade.keepChoices = function () {
    const give = () => ({
      open: pathsTo(`${DETAILS}[open]`),
      closed: pathsTo(`${DETAILS}:not([open])`),
      pictures: pathsTo(".replaced.shown"),
      sideways: [...document.querySelectorAll(WIDE)].filter(({ scrollLeft }) => scrollLeft).map((box) => [pathTo(box), box.scrollLeft]),
      focus: document.activeElement && document.activeElement !== document.body ? pathTo(document.activeElement) : "",
    });
    colonnade.keep("choices", give, ({ open, closed, pictures, sideways, focus }) => {
      for (const details of open.map(found).filter(Boolean)) details.open = true;
      for (const details of closed.map(found).filter(Boolean)) details.open = false;
      for (const picture of pictures.map(found).filter(Boolean)) picture.classList.add("shown");
      for (const [path, left] of sideways) if (found(path)) found(path).scrollLeft = left;
      if (found(focus)) found(focus).focus({ preventScroll: true });
    });
  };

  // The person may scroll before all panels are drawn: then the page stays there.
  let isMoved = false;
  for (const event of ["wheel", "touchmove", "pointerdown", "keydown"]) addEventListener(event, () => { isMoved = true; }, { capture: true, passive: true, once: true });

  // The place in the page: how far it is scrolled into the section at the top of the window, since others may grow.
  colonnade.keepPlace = function () {
    const give = () => {
      const above = [...document.querySelectorAll("main section[id]")].filter((section) => section.getBoundingClientRect().top <= 0).at(-1);
      return { section: above ? above.id : "", down: above ? -above.getBoundingClientRect().top : scrollY };
    };
    colonnade.keep("place", give, ({ section, down }) => {
      if (isMoved) return;
      const start = section ? document.getElementById(section) : document.documentElement;
      if (start) scrollTo(0, start.getBoundingClientRect().top + scrollY + down);
      history.scrollRestoration = "auto";
    });
  };
}
