// Filters and sorts the table of all tests. Without it the whole table stands.
(function () {
  "use strict";
  const form = document.getElementById("filter");
  const table = document.getElementById("tests-table");
  if (!form || !table) return;
  const body = table.tBodies[0];
  const heads = Array.from(table.querySelectorAll("th[data-column]"));
  const shown = form.querySelector("output");

  // Place of each named column in a row: the picture, which has no name, is behind the first four.
  const place = {};
  const inOrder = ["test", "specimen", "kind", "status", "", "pga", "outcome", "peak"]
    .concat(heads.slice(7).map(function (head) { return head.dataset.column; }));
  inOrder.forEach(function (name, index) { place[name] = index; });

  // In the order in which they stand.
  let rows = Array.from(body.rows, function (row) {
    const cells = Array.from(row.cells, function (cell) { return cell.textContent.replace(/\s+/g, " ").trim(); });
    return { row: row, cells: cells, words: cells.join(" ").toLowerCase(), fits: true };
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

  function fits(cell, wanted, name) {
    if (name === "outcome") return cell.replace(/^– observed: /, "").split(" ")[0] === wanted;
    if (name === "status") return cell.includes(wanted);
    return cell.split(" ")[0] === wanted;
  }

  function filter() {
    const wanted = Array.from(form.querySelectorAll("select"), function (select) { return [select.name, select.value]; })
      .filter(function (pair) { return pair[1]; });
    const words = form.elements.words.value.toLowerCase().split(/\s+/).filter(Boolean);
    rows.forEach(function (each) {
      each.fits = wanted.every(function (pair) { return fits(each.cells[place[pair[0]]], pair[1], pair[0]); })
        && words.every(function (word) { return each.words.includes(word); });
    });
    shown.textContent = rows.filter(function (each) { return each.fits; }).length + " of " + rows.length + " tests";
    show();
  }

  function value(text) {
    const number = parseFloat(text.replace(/^< /, ""));
    return Number.isNaN(number) ? text : number;
  }

  function sort(head) {
    const index = place[head.dataset.column];
    const down = head.getAttribute("aria-sort") === "ascending";
    heads.forEach(function (other) { other.removeAttribute("aria-sort"); });
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    const isNumber = head.classList.contains("number");
    const names = new Intl.Collator(undefined, { numeric: true });
    const keyed = rows.map(function (each) {
      const text = each.cells[index];
      return { each: each, key: isNumber ? value(text) : text, missing: text === "–" || text === "" };
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
  document.addEventListener("click", function (event) {
    const link = event.target.closest("a[data-filter]");
    if (!link) return;
    event.preventDefault();
    form.reset();
    new URLSearchParams(link.dataset.filter).forEach(function (wanted, name) {
      if (form.elements[name]) form.elements[name].value = wanted;
    });
    filter();
    document.getElementById("tests").scrollIntoView();
    (form.querySelector("select") || form.elements.words).focus({ preventScroll: true });
  });
  colonnade.keep("tests", function () {
    const sorted = heads.find(function (head) { return head.hasAttribute("aria-sort"); });
    const wanted = Array.from(form.querySelectorAll("select, input"), function (field) { return [field.name, field.value]; });
    return { wanted: wanted, column: sorted && sorted.dataset.column, order: sorted && sorted.getAttribute("aria-sort") };
  }, function (kept) {
    kept.wanted.forEach(function (pair) { if (form.elements[pair[0]]) form.elements[pair[0]].value = pair[1]; });
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
