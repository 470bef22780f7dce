"use strict";
// What becomes of the edits: a list for quadmap-map apply, and a truth for quadmap-evaluate.
Page.save = (function () {
  const panel = Page.byId("save");

  function idOf(text) { return /^[0-9]+$/.test(text) ? Number(text) : text; }
  function editList() {
    const list = Page.editing.edits.map(function (edit) {
      const out = Object.assign({}, edit);
      for (const key of ["id", "keep", "absorb"]) if (key in out) out[key] = idOf(out[key]);
      return out;
    });
    return JSON.stringify({format: "quadmap-edits", version: 1, map_sha256: Page.data.mapSha256, edits: list}, null, 1) + "\n";
  }
  // The confirmed objects and those that were edited, in the frame of the map: the form of objects.json.
  function truth() {
    const objects = Array.from(Page.objects.values()).filter((o) => o.confirmed).map(function (o) {
      const m = new THREE.Matrix4().makeRotationFromQuaternion(new THREE.Quaternion().fromArray(o.pose, 3)).elements;
      return {id: idOf(o.id), label: o.label, center: o.center, size: o.size,
              rotation: [0, 1, 2].map((r) => [m[r], m[4 + r], m[8 + r]]), orientation_defined: o.oriented};
    });
    return JSON.stringify({format: "quadmap-objects", version: 1, unit: "m", frame: "map", objects: objects}, null, 1) + "\n";
  }
  function download(name, text) {
    const link = Page.element("a", document.body), address = URL.createObjectURL(new Blob([text], {type: "application/json"}));
    link.href = address;
    link.download = name;
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(address), 1000);
  }
  function textOf(edit) {
    if (edit.op === "merge") return "merge " + edit.absorb + " into " + edit.keep;
    return edit.op + " " + edit.id + (edit.op === "relabel" ? " as " + edit.label : "");
  }
  function rebuild() {
    while (panel.children.length > 1) panel.lastChild.remove();
    const edits = Page.editing.edits, list = Page.element("ol", panel);
    list.style.margin = "0";
    for (const edit of edits) Page.element("li", list, textOf(edit));
    if (!edits.length) Page.element("span", panel, "Nothing was changed.", "dim");
    if (edits.some((edit) => edit.op === "merge"))
      Page.element("p", panel, "Here, and in a saved truth, a merged object has the place and the size of the one that stays. quadmap-map apply estimates them anew from the measurements of both.", "dim");
    const row = Page.element("div", panel, null, "row");
    Page.button(row, "Undo", () => Page.editing.undo()).id = "undo";
    Page.button(row, "Save edits", () => download("edits.json", editList())).id = "save-edits";
    Page.button(row, "Save as truth", () => download("objects.gt.json", truth())).id = "save-truth";
    Page.byId("undo").disabled = Page.byId("save-edits").disabled = !edits.length;
  }
  window.addEventListener("beforeunload", function (event) { if (Page.editing.edits.length) event.preventDefault(); });
  Page.on("edited", rebuild);
  return {rebuild, editList, truth};
})();
