// Filters and sorts the table of all tests. Without it the whole table stands.
"use strict";

{
  // Rows that appear at once, about a screen of them. The others of a long table follow after a pause, some at a time,
  // so that no answer waits for them. A row that is not shown is taken out: only a shorter table is laid out faster.
  const AT_ONCE = 40;
  const PAUSE = 300; // ms, longer than between two keys

  const plain = (element) => element.textContent.replace(/\s+/g, " ").trim();

  function start(form, table) {
    const [body] = table.tBodies;
    const heads = [...table.querySelectorAll("th[data-column]")];
    // In the order in which they stand.
    const rows = [...body.rows].map((row) => ({
      row,
      cells: [...row.cells].map((cell) => cell.dataset.order || plain(cell)),
      words: [plain(row), ...Object.values(row.dataset)].join(" ").toLowerCase(),
      fits: true,
    }));
    const fitting = () => rows.filter(({ fits }) => fits).map(({ row }) => row);
    let pause = 0;

    function show(atOnce = AT_ONCE) {
      clearTimeout(pause);
      const wanted = fitting();
      if (wanted.length === body.rows.length && wanted.every((row, index) => row === body.rows[index])) return;
      body.replaceChildren(...wanted.splice(0, atOnce));
      const more = () => {
        body.append(...wanted.splice(0, AT_ONCE));
        if (wanted.length) pause = setTimeout(more);
      };
      if (wanted.length) pause = setTimeout(more, PAUSE);
    }

    function filter() {
      const chosen = [...new FormData(form)].filter(([, value]) => value);
      const words = form.elements.words.value.toLowerCase().split(/\s+/).filter(Boolean);
      for (const each of rows) {
        const has = ([name, value]) => name === "words" || (each.row.dataset[name] || "").split(" ").includes(value);
        each.fits = chosen.every(has) && words.every((word) => each.words.includes(word));
      }
      form.querySelector("output").textContent = `${fitting().length} of ${rows.length} tests`;
      history.replaceState(null, "", location.pathname + (chosen.length ? `?${new URLSearchParams(chosen)}` : "") + location.hash);
      show();
    }

    function sort(head, isDown = head.getAttribute("aria-sort") === "ascending") {
      for (const other of heads) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", isDown ? "descending" : "ascending");
      const isNumber = head.classList.contains("number");
      const names = new Intl.Collator(undefined, { numeric: true });
      for (const each of rows) {
        const text = each.cells[head.cellIndex];
        each.key = isNumber ? parseFloat(text.replace(/^< /, "")) : text;
        each.missing = text === "–" || text === "" || Number.isNaN(each.key);
      }
      rows.sort((one, other) => {
        if (one.missing || other.missing) return one.missing - other.missing;
        const order = isNumber ? one.key - other.key : names.compare(one.key, other.key);
        return isDown ? -order : order;
      });
      show();
    }

    for (const head of heads) {
      const button = colonnade.element("button", { type: "button" }, ...head.childNodes);
      button.addEventListener("click", () => sort(head));
      head.append(button);
    }
    form.addEventListener("input", filter);
    form.addEventListener("submit", (event) => event.preventDefault());
    form.addEventListener("reset", () => setTimeout(filter));
    // The address holds the filter: a link to the table, and a page that loads itself again, bring it along.
    for (const [name, wanted] of new URLSearchParams(location.search)) if (form.elements[name]) form.elements[name].value = wanted;
    const give = () => {
      const sorted = heads.find((head) => head.hasAttribute("aria-sort"));
      return { column: sorted?.dataset.column, isDown: sorted?.getAttribute("aria-sort") === "descending" };
    };
    colonnade.keep("tests", give, ({ column, isDown }) => {
      const head = heads.find(({ dataset }) => dataset.column === column);
      if (head) sort(head, isDown);
      filter();
      show(Infinity); // the page is scrolled to where it was
    });
    addEventListener("pageshow", filter);
    addEventListener("beforeprint", () => show(Infinity));
    form.hidden = false;
  }

  const [form, table] = [document.getElementById("filter"), document.querySelector("#tests table")];
  if (form && table) start(form, table);
}
