"use strict";
// All that is known about the selected object, and the histogram of labels.
Page.details = (function () {
  const facts = Page.byId("facts");

  function histogram(counts, parent) {
    const entries = Object.entries(counts).sort((a, b) => b[1] - a[1]);
    const most = Math.max(1, ...entries.map((e) => e[1]));
    for (const [label, count] of entries) {
      const bar = Page.element("div", parent, null, "bar");
      Page.element("span", bar, label).title = label;
      const track = Page.element("span", bar);
      Page.element("i", track).style.width = (100 * count / most).toFixed(1) + "%";
      Page.element("span", bar, count);
    }
  }
  function labelsOfMap() {
    const counts = {};
    for (const object of Page.objects.values()) counts[object.label] = (counts[object.label] || 0) + 1;
    return counts;
  }
  function row(table, name, value) {
    const line = Page.element("tr", table);
    Page.element("td", line, name, "dim");
    Page.element("td", line, value, "wrap");
  }
  function sigmaText(object) {
    if (!object.sigma) return "not known";
    const s = object.sigma, cm = (v) => (100 * v).toFixed(1);
    const yaw = object.oriented ? ", heading ± " + (s[3] * 180 / Math.PI).toFixed(1) + "°" : "";
    return "centre ± " + cm(s[0]) + ", " + cm(s[1]) + ", " + cm(s[2]) + " cm" + yaw + ", sizes ± " +
      [4, 5, 6].map((i) => (100 * s[i]).toFixed(0) + " %").join(", ");
  }
  function describe(object) {
    Page.element("h2", facts, Page.nameOf(object)).style.margin = "0";
    const table = Page.element("table", facts);
    row(table, "size [m]", object.size.map((v) => v.toFixed(3)).join(" × "));
    row(table, "centre [m]", object.center.map((v) => v.toFixed(3)).join(", "));
    row(table, "heading", object.oriented ? (object.yaw * 180 / Math.PI).toFixed(1) + "°" : "none: it looks the same from all sides");
    row(table, "uncertainty", sigmaText(object));
    row(table, "exists", object.existence === null ? "not known" : object.existence.toFixed(3) + (object.confirmed ? "" : ", not confirmed"));
    row(table, "views", object.views === null ? "not known" : object.views + " used, " + object.misses + " that should have shown it and did not");
    if (object.first !== null) row(table, "seen", [object.first, object.last].map((t) => Page.dateText(t) || Page.timeText(t)).join(" to "));
    if (object.verdict) row(table, "compared", object.verdict);
    const buttons = Page.element("div", facts, null, "row");
    Page.button(buttons, "Look at it", () => Page.lookAt(object.id));
    Page.button(buttons, "Image before", () => seek(object.id, -1));
    Page.button(buttons, "Next image", () => seek(object.id, 1));
    Page.element("h3", facts, "What the detector called it").style.margin = "8px 0 4px";
    histogram(object.counts, facts);
  }
  function seek(id, step) {
    if (Page.keyframes.showNextOf(id, step)) Page.showTab("keyframes");
    else Page.note("No image has a box of this object.");
  }
  function rebuild() {
    facts.textContent = "";
    const object = Page.objects.get(Page.selected);
    if (object) return describe(object);
    Page.element("p", facts, "Click an object in the view or in the table. The map's labels:");
    histogram(labelsOfMap(), facts);
  }
  Page.on("select", rebuild);
  Page.on("edited", rebuild);
  return {rebuild};
})();
