// Pictures and tables that are made in the page, so that it stays whole when it is moved alone.
"use strict";

colonnade.save = function (name, parts, type) {
  const link = colonnade.element("a", { href: URL.createObjectURL(new Blob(parts, { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
};

// A picture of the page as a file of its own.
colonnade.svgText = function (svg) {
  const own = svg.cloneNode(true);
  const [, , width, height] = svg.getAttribute("viewBox").split(/\s+/).map(Number);
  own.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  own.setAttribute("width", `${width}pt`);
  own.setAttribute("height", `${height}pt`);
  return `<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(own)}\n`;
};

// The same as pixels, 300 an inch, on white.
colonnade.savePng = function (name, svg) {
  const image = new Image();
  image.onload = () => {
    const canvas = colonnade.element("canvas");
    const [, , width, height] = svg.getAttribute("viewBox").split(/\s+/).map(Number);
    [canvas.width, canvas.height] = [Math.round((width * 300) / 72), Math.round((height * 300) / 72)];
    const context = canvas.getContext("2d");
    context.fillStyle = "#fff";
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.drawImage(image, 0, 0, canvas.width, canvas.height);
    canvas.toBlob((blob) => colonnade.save(name, [blob], "image/png"), "image/png");
  };
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(colonnade.svgText(svg))}`;
};

// A cell of CSV: quoted where it has to be; a text is never taken for a formula.
colonnade.cell = function (value) {
  if (typeof value === "number") return Number.isFinite(value) ? String(Number(value.toPrecision(7))) : "";
  const plain = value.replaceAll("\u00a0", " "); // programs look columns up by their heads
  const harmless = /^[=+\-@\t\r]/.test(plain) ? `'${plain}` : plain;
  return /[",\r\n]/.test(harmless) ? `"${harmless.replaceAll('"', '""')}"` : harmless;
};

// Curves as a table: those on one clock share the column of time.
colonnade.tableOf = function (panels, page) {
  const clocks = new Map();
  for (const { title, unit, second, curves, bands = [] } of panels) {
    const add = (clock, name, values, shown = unit) => {
      if (!clocks.has(clock)) clocks.set(clock, []);
      clocks.get(clock).push({ head: `${title}, ${name}${shown ? ` (${shown})` : ""}`, values });
    };
    for (const { clock, name, values } of curves) {
      add(clock, name, page.series[values]);
      if (second) add(clock, name, page.series[values].map((value) => second.factor * value + second.offset), second.unit);
    }
    for (const band of bands) for (const end of ["low", "high"]) add(band.clock, `${band.name}, ${end}`, page.series[band[end]]);
  }
  const table = { heads: [], columns: [] };
  for (const [clock, found] of clocks) {
    table.heads.push("time (s)", ...found.map(({ head }) => head));
    table.columns.push({ clock }, ...found.map(({ values }) => values));
  }
  return colonnade.csvText(table);
};

colonnade.button = function (text, label, action) {
  const made = colonnade.element("button", { type: "button", "aria-label": label, title: label }, text);
  made.addEventListener("click", action);
  return made;
};

// The table of a picture as CSV text: it is that already, or headings with columns of samples.
colonnade.csvText = async function (table) {
  if (typeof table === "string") return table;
  const { series, clocks } = await colonnade.samples();
  const columns = table.columns.map((column) => {
    if (column.clock !== undefined) return clocks[column.clock];
    const values = column.series === undefined ? column : series[column.series];
    return { count: values.length, at: (row) => values[row] };
  });
  const lines = [table.heads.map(colonnade.cell).join(",")];
  const rows = Math.max(...columns.map((column) => column.count));
  for (let row = 0; row < rows; row += 1) lines.push(columns.map((column) => (row < column.count ? colonnade.cell(column.at(row)) : "")).join(","));
  return `${lines.join("\n")}\n`;
};

// Below each figure of the page: its picture as SVG and PNG, and what it shows as CSV.
colonnade.addDownloads = function (tables) {
  for (const figure of document.querySelectorAll("figure")) {
    const svg = figure.querySelector("svg[role]");
    if (!svg) continue;
    const name = svg.id;
    const title = svg.querySelector("title").textContent;
    const csv = async () => colonnade.save(`${name}.csv`, ["\ufeff", await colonnade.csvText(tables[name])], "text/csv");
    const row = colonnade.element("p", { class: "downloads" }, "Download:",
      colonnade.button("SVG", `${title}, as SVG`, () => colonnade.save(`${name}.svg`, [colonnade.svgText(svg)], "image/svg+xml")),
      colonnade.button("PNG", `${title}, as PNG`, () => colonnade.savePng(`${name}.png`, svg)),
      ...(tables[name] ? [colonnade.button("CSV", `${title}, as CSV`, csv)] : []));
    const replaced = figure.closest(".replaced");
    if (replaced) row.append(colonnade.button("Show picture", "Show the picture as it is printed", () => replaced.classList.toggle("shown")));
    figure.append(row);
  }
};
