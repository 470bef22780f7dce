"use strict";
// The truth or a second map beside this one, with what differs.
Page.compare = (function () {
  const kSame = 0.3;  // between the centres of one object in two maps, as quadmap-evaluate has it [m]
  const panel = Page.byId("compare"), layer = Page.shapes.layers.compared;
  const others = Page.data.compared, isTruth = Page.data.comparedIsTruth;
  const words = isTruth ? {here: "phantom", there: "missed"} : {here: "only here", there: "only there"};
  let beside = false;

  function distance(a, b) { return Math.hypot(a.center[0] - b.center[0], a.center[1] - b.center[1], a.center[2] - b.center[2]); }

  // One to one, nearest first: those of equal labels, then the rest.
  function match() {
    const here = Array.from(Page.objects.values()).filter((o) => o.confirmed), pairs = [];
    for (const a of here) for (const b of others.filter((o) => o.confirmed))
      if (distance(a, b) <= kSame) pairs.push({a, b, away: distance(a, b), same: a.label === b.label});
    pairs.sort((p, q) => (q.same - p.same) || (p.away - q.away));
    const used = new Set(), found = [];
    for (const pair of pairs) {
      if (used.has(pair.a) || used.has(pair.b)) continue;
      used.add(pair.a).add(pair.b);
      found.push(pair);
    }
    return {found, here: here.filter((o) => !used.has(o)), there: others.filter((o) => o.confirmed && !used.has(o))};
  }
  function item(parent, text, className, id) {
    const row = Page.element("li", parent, text, className);
    if (id !== undefined) { row.style.cursor = "pointer"; row.addEventListener("click", () => Page.select(id)); }
  }
  function draw(missing) {
    layer.remove(...layer.children.slice());
    for (const other of others)
      layer.add(Page.shapes.cuboid(other, Page.themeColor(missing.has(other) ? "--bad" : "--text")));
    const size = Page.shapes.bounds().getSize(new THREE.Vector3());
    layer.position.x = beside ? size.x + 1 : 0;
    Page.view.request();
  }
  function rebuild() {
    panel.textContent = "";
    for (const object of Page.objects.values()) object.verdict = "";
    if (!Page.data.comparedName) {
      Page.element("p", panel, "Nothing to compare with: export with --truth or with --compare.");
      return;
    }
    const result = match();
    for (const o of result.here) o.verdict = words.here;
    for (const p of result.found) if (!p.same) p.a.verdict = "is " + p.b.label + (isTruth ? "" : " there");
    Page.element("div", panel, (isTruth ? "Truth: " : "Second map: ") + Page.data.comparedName);
    Page.element("div", panel, result.found.length + " found, " + result.here.length + " " + words.here + ", " + result.there.length + " " + words.there);
    const toggle = Page.button(panel, beside ? "Lay one over the other" : "Put one beside the other", function () { beside = !beside; rebuild(); });
    toggle.id = "beside";
    const list = Page.element("ul", panel);
    for (const o of result.here) item(list, words.here + ": " + Page.nameOf(o), "bad", o.id);
    for (const o of result.there) item(list, words.there + ": " + Page.nameOf(o), "bad");
    for (const p of result.found)
      item(list, Page.nameOf(p.a) + (p.same ? "" : ", there " + Page.nameOf(p.b)) + ": " + (100 * p.away).toFixed(1) + " cm apart", p.same ? "" : "doubt", p.a.id);
    draw(new Set(result.there));
  }
  Page.on("edited", rebuild);
  Page.on("theme", rebuild);
  return {rebuild, match};
})();
