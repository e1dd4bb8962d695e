// Filters and sorts the table of all tests. Without it the whole table stands.
(function () {
  "use strict";
  const form = document.getElementById("filter");
  const table = document.querySelector("#tests table");
  if (!form || !table) return;
  const body = table.tBodies[0];
  const heads = Array.from(table.querySelectorAll("th[data-column]"));
  const shown = form.querySelector("output");

  // In the order in which they stand.
  let rows = Array.from(body.rows, function (row) {
    const cells = Array.from(row.cells, function (cell) { return cell.dataset.order || cell.textContent.replace(/\s+/g, " ").trim(); });
    const words = row.textContent.replace(/\s+/g, " ") + Object.values(row.dataset).join(" ");
    return { row: row, cells: cells, words: words.toLowerCase(), fits: true };
  });

  // Rows that appear at once, about a screen of them. The others of a long table follow after a pause, some at a time,
  // so that no answer waits for them. A row that is not shown is taken out: only a shorter table is laid out faster.
  const AT_ONCE = 40;
  const PAUSE = 300; // ms, longer than between two keys
  let pause = 0;

  function show() {
    clearTimeout(pause);
    const wanted = rows.filter(function (each) { return each.fits; }).map(function (each) { return each.row; });
    const isShown = wanted.length === body.rows.length && wanted.every(function (row, index) { return row === body.rows[index]; });
    if (isShown) return;
    body.replaceChildren(...wanted.splice(0, AT_ONCE));
    function more() {
      body.append(...wanted.splice(0, AT_ONCE));
      if (wanted.length) pause = setTimeout(more);
    }
    if (wanted.length) pause = setTimeout(more, PAUSE);
  }

  function showAllAtOnce() {
    clearTimeout(pause);
    body.append(...rows.filter(function (each) { return each.fits; }).map(function (each) { return each.row; }));
  }

  function filter() {
    const chosen = Array.from(new FormData(form)).filter(function (pair) { return pair[1]; });
    const wanted = chosen.filter(function (pair) { return pair[0] !== "words"; });
    const words = form.elements.words.value.toLowerCase().split(/\s+/).filter(Boolean);
    rows.forEach(function (each) {
      each.fits = wanted.every(function (pair) { return (each.row.dataset[pair[0]] || "").split(" ").includes(pair[1]); })
        && words.every(function (word) { return each.words.includes(word); });
    });
    shown.textContent = rows.filter(function (each) { return each.fits; }).length + " of " + rows.length + " tests";
    history.replaceState(null, "", location.pathname + (chosen.length ? "?" + new URLSearchParams(chosen) : "") + location.hash);
    show();
  }

  function sort(head) {
    const index = head.cellIndex;
    const down = head.getAttribute("aria-sort") === "ascending";
    heads.forEach(function (other) { other.removeAttribute("aria-sort"); });
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    const isNumber = head.classList.contains("number");
    const names = new Intl.Collator(undefined, { numeric: true });
    const keyed = rows.map(function (each) {
      const text = each.cells[index];
      const key = isNumber ? parseFloat(text.replace(/^< /, "")) : text;
      return { each: each, key: key, missing: text === "–" || text === "" || Number.isNaN(key) };
    });
    keyed.sort(function (one, other) {
      if (one.missing || other.missing) return one.missing - other.missing;
      const order = isNumber ? one.key - other.key : names.compare(one.key, other.key);
      return down ? -order : order;
    });
    rows = keyed.map(function (entry) { return entry.each; });
    show();
  }

  heads.forEach(function (head) {
    const button = document.createElement("button");
    button.type = "button";
    button.append.apply(button, Array.from(head.childNodes));
    button.addEventListener("click", function () { sort(head); });
    head.append(button);
  });

  form.addEventListener("input", filter);
  form.addEventListener("submit", function (event) { event.preventDefault(); });
  form.addEventListener("reset", function () { setTimeout(filter); });
  // The address holds the filter: a link to the table, and a page that loads itself again, bring it along.
  new URLSearchParams(location.search).forEach(function (wanted, name) {
    if (form.elements[name]) form.elements[name].value = wanted;
  });
  colonnade.keep("tests", function () {
    const sorted = heads.find(function (head) { return head.hasAttribute("aria-sort"); });
    return { column: sorted && sorted.dataset.column, order: sorted && sorted.getAttribute("aria-sort") };
  }, function (kept) {
    const head = heads.find(function (one) { return one.dataset.column === kept.column; });
    if (head) {
      sort(head);
      if (head.getAttribute("aria-sort") !== kept.order) sort(head);
    }
    filter();
    showAllAtOnce(); // the page is scrolled to where it was
  });
  window.addEventListener("pageshow", filter);
  window.addEventListener("beforeprint", showAllAtOnce);
  form.hidden = false;
})();
