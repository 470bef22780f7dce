"use strict";
// Edits of the map: a list that is replayed on the original, so that any can be taken back.
Page.editing = (function () {
  const panel = Page.byId("edit");
  const edits = [];

  function setPose(object, edit) {
    object.center = edit.center.slice();
    object.size = edit.size.slice();
    object.yaw = edit.yaw;
    object.pose = edit.center.concat([0, 0, Math.sin(edit.yaw / 2), Math.cos(edit.yaw / 2)]);
  }
  const replay = {
    relabel(edit) {
      const object = Page.objects.get(edit.id), known = Page.data.labels.find((l) => l.name === edit.label);
      object.label = edit.label;
      object.counts = {[edit.label]: object.views || 1};
      object.color = known ? known.color : [128, 128, 128];
    },
    merge(edit) {  // what the two measured together is computed when the edits are applied to the map
      const kept = Page.objects.get(edit.keep), gone = Page.objects.get(edit.absorb);
      for (const [label, count] of Object.entries(gone.counts)) kept.counts[label] = (kept.counts[label] || 0) + count;
      kept.views += gone.views;
      kept.existence = Math.max(kept.existence, gone.existence);
      kept.first = Math.min(kept.first, gone.first);
      kept.last = Math.max(kept.last, gone.last);
      Page.objects.delete(edit.absorb);
    },
    remove(edit) { Page.objects.delete(edit.id); },
    place(edit) { setPose(Page.objects.get(edit.id), edit); },
  };
  function replayAll() {
    Page.restore();
    for (const edit of edits) {
      replay[edit.op](edit);
      const object = Page.objects.get(edit.op === "merge" ? edit.keep : edit.id);
      if (object) object.confirmed = true;  // a person has looked at it
    }
    Page.emit("edited");
    if (Page.selected !== null && !Page.objects.has(Page.selected)) Page.select(null);
  }
  // An edit; a place takes the place of one just before it.
  function add(edit) {
    const last = edits[edits.length - 1];
    if (last && last.op === "place" && edit.op === "place" && last.id === edit.id) edits.pop();
    edits.push(edit);
    replayAll();
  }
  function place(object) {
    add({op: "place", id: object.id, center: object.center, size: object.size, yaw: object.yaw});
  }

  function input(parent, type, value) {
    const made = Page.element("input", parent);
    made.type = type;
    made.value = value;
    return made;
  }
  function labelRow(object) {
    const row = Page.element("div", panel, null, "row"), names = Page.element("datalist", row);
    const text = input(row, "text", object.label);
    text.id = "new-label";
    text.setAttribute("aria-label", "Label");
    names.id = "names";
    text.setAttribute("list", "names");
    for (const label of Page.data.labels) Page.element("option", names).value = label.name;
    Page.button(row, "Relabel", function () {
      const label = text.value.trim();
      if (!label || label === object.label) return;
      add({op: "relabel", id: object.id, label: label});
      if (!Page.data.labels.some((l) => l.name === label)) Page.note("The map does not know \"" + label + "\": quadmap-map apply takes it with --any-label.");
    }).id = "relabel";
  }
  function mergeRow(object) {
    const row = Page.element("div", panel, null, "row"), choice = Page.element("select", row);
    choice.id = "absorbed";
    choice.setAttribute("aria-label", "Other object");
    const away = (o) => Math.hypot(...o.center.map((v, i) => v - object.center[i]));
    const others = Array.from(Page.objects.values()).filter((o) => o !== object).sort((a, b) => away(a) - away(b));
    for (const other of others) Page.element("option", choice, Page.nameOf(other)).value = other.id;
    Page.button(row, "is this object too: merge", () => choice.value && add({op: "merge", keep: object.id, absorb: choice.value})).id = "merge";
    Page.button(row, "Remove", () => add({op: "remove", id: object.id})).id = "remove";
  }
  function numbersRow(object, name, values, take) {
    const row = Page.element("div", panel, null, "row");
    Page.element("span", row, name);
    const inputs = values.map((value) => input(row, "number", value.toFixed(3)));
    for (const one of inputs) {
      one.step = "any";
      one.addEventListener("change", function () {
        const typed = inputs.map((i) => Number(i.value));
        if (!typed.every(Number.isFinite) || inputs.some((i) => i.value === "")) return;
        const changed = JSON.parse(JSON.stringify(object));
        take(changed, typed);
        if (changed.size.every((s) => s > 0)) place(changed);
        else Page.note("Sizes are greater than zero.");
      });
    }
  }
  function rebuild() {
    while (panel.children.length > 1) panel.lastChild.remove();
    const object = Page.objects.get(Page.selected);
    if (!object) return Page.element("span", panel, "Select an object first.", "dim");
    labelRow(object);
    mergeRow(object);
    numbersRow(object, "centre [m]", object.center, (o, v) => { o.center = v; });
    numbersRow(object, "size [m]", object.size, (o, v) => { o.size = v; });
    numbersRow(object, "heading [°]", [object.yaw * 180 / Math.PI], (o, v) => { o.yaw = v[0] * Math.PI / 180; });
    const drag = Page.button(panel, "Drag its cuboid in the view", function () {
      Page.drag.set(!Page.drag.on);
      drag.setAttribute("aria-pressed", Page.drag.on);
    });
    drag.id = "drag";
    drag.setAttribute("aria-pressed", Page.drag.on);
  }
  Page.on("select", rebuild);
  Page.on("edited", rebuild);
  return {edits, add, place, rebuild, setPose, undo() { edits.pop(); replayAll(); }};
})();
