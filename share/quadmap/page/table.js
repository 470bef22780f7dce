"use strict";
// The table of objects, linked with the view both ways.
Page.table = (function () {
  const body = document.querySelector("#objects tbody"), head = document.querySelector("#objects thead tr");
  const filter = Page.byId("filter");
  const none = (value) => (value === null || value === undefined ? Infinity : value);
  const timeText = (time) => Page.timeText(time).replace(" s", "\u00a0s");  // one line, where a date may take two
  // "extra": left out where the panel is narrow; the tab of the object has it.
  const columns = [
    {title: "id", value: (o) => Number(o.id) || o.id, text: (o) => o.id},
    {title: "label", value: (o) => o.label, text: (o) => o.label},
    {title: "size [m]", value: (o) => o.size[0] * o.size[1] * o.size[2], text: (o) => o.size.map((s) => s.toFixed(2)).join("×")},
    {title: "exists", value: (o) => none(o.existence), text: (o) => (o.existence === null ? "" : o.existence.toFixed(2))},
    {title: "± [cm]", kind: "extra", hint: "standard deviation of the centre", value: (o) => none(Page.centreSigma(o)),
     text: (o) => (o.sigma ? (100 * Page.centreSigma(o)).toFixed(1) : "")},
    {title: "first", kind: "extra", value: (o) => none(o.first), text: (o) => timeText(o.first)},
    {title: "last", kind: "extra", value: (o) => none(o.last), text: (o) => timeText(o.last)},
    {title: "views", value: (o) => none(o.views), text: (o) => (o.views === null ? "" : o.views)},
    {title: "verdict", value: (o) => o.verdict || "", text: (o) => o.verdict || (Page.isDoubtful(o) ? "doubtful" : "")},
  ];
  let sortedBy = 0, direction = 1;
  const rows = new Map();

  function rowOf(object) {
    const row = Page.element("tr", body);
    row.tabIndex = 0;
    row.dataset.id = object.id;
    if (Page.isDoubtful(object)) row.className = "doubt";
    columns.forEach(function (column, i) {
      const cell = Page.element("td", row, i === 1 ? null : column.text(object), column.kind);
      if (i !== 1) return;
      Page.element("span", cell, null, "dot").style.background = Page.cssColor(object.color);
      Page.element("span", cell, column.text(object));
    });
    row.addEventListener("click", () => Page.select(object.id));
    row.addEventListener("dblclick", () => Page.lookAt(object.id));
    row.addEventListener("keydown", function (event) { if (event.key === "Enter") Page.select(object.id); });
    rows.set(object.id, row);
  }
  function rebuild() {
    const wanted = filter.value.toLowerCase(), value = columns[sortedBy].value;
    const list = Array.from(Page.objects.values()).filter((o) => Page.nameOf(o).toLowerCase().includes(wanted));
    list.sort((a, b) => direction * (value(a) < value(b) ? -1 : value(a) > value(b) ? 1 : 0));
    body.textContent = "";
    rows.clear();
    list.forEach(rowOf);
    mark();
    const doubtful = Array.from(Page.objects.values()).filter(Page.isDoubtful).length;
    Page.byId("summary").textContent = Page.objects.size + " objects (" + doubtful + " doubtful), " +
      Page.data.keyframes.length + " images, " + Page.data.cloud.points.toLocaleString("en") + " points";
  }
  function mark() {
    for (const [id, row] of rows) {
      row.classList.toggle("selected", id === Page.selected);
      row.setAttribute("aria-selected", id === Page.selected);
    }
    const row = rows.get(Page.selected);
    if (row) row.scrollIntoView({block: "nearest"});
  }

  columns.forEach(function (column, i) {
    const cell = Page.element("th", head, column.title, column.kind);
    cell.title = column.hint || "Sort by " + column.title;
    cell.addEventListener("click", function () {
      direction = sortedBy === i ? -direction : 1;
      sortedBy = i;
      rebuild();
    });
  });
  filter.addEventListener("input", rebuild);
  Page.on("select", mark);
  Page.on("edited", rebuild);
  return {rebuild};
})();
