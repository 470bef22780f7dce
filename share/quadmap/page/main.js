"use strict";
// Tabs, layers, theme, and the link that keeps the view.
(function () {
  const tabs = Page.byId("tabs"), sections = Array.from(document.querySelectorAll("aside > section"));

  Page.showTab = function (id) {
    for (const section of sections) section.classList.toggle("shown", section.id === id);
    for (const tab of tabs.children) tab.setAttribute("aria-selected", tab.dataset.shows === id);
  };
  for (const section of sections) {
    const tab = Page.button(tabs, section.dataset.tab, () => Page.showTab(section.id));
    tab.dataset.shows = section.id;
    tab.setAttribute("role", "tab");
  }

  function setLayer(name, shown) {
    if (name === "labels") Page.overlay.labels = shown;
    else if (name === "doubtful") Page.shapes.setDoubtful(shown);
    else Page.shapes.layers[name].visible = shown;
    const box = document.querySelector("#layers input[name=" + name + "]");
    if (box) box.checked = shown;
    Page.view.request();
  }
  const layerNames = ["labels", "doubtful"].concat(Object.keys(Page.shapes.layers));
  for (const name of layerNames) {
    const label = Page.element("label", document.querySelector("#layers div"));
    const box = Page.element("input", label);
    box.type = "checkbox";
    box.name = name;
    box.checked = true;
    label.appendChild(document.createTextNode(" " + name));
    box.addEventListener("change", function () { setLayer(name, box.checked); keepView(); });
  }

  // The camera at an angle (from the south) or straight above, so that everything is in the picture.
  function frame(direction) {
    const box = Page.shapes.bounds(), centre = box.getCenter(new THREE.Vector3());
    const radius = 0.5 * box.getSize(new THREE.Vector3()).length(), camera = Page.view.camera;
    const half = Math.atan(Math.tan(camera.fov * Math.PI / 360) * Math.min(1, camera.aspect));
    Page.view.lookFrom(centre.clone().addScaledVector(direction.normalize(), 0.85 * radius / Math.sin(half)), centre);
  }
  Page.fit = () => frame(new THREE.Vector3(-0.3, -1, 0.9));
  Page.byId("fit").addEventListener("click", Page.fit);
  Page.byId("top").addEventListener("click", () => frame(new THREE.Vector3(0, -0.001, 1)));
  Page.lookAt = function (id) {
    const object = Page.objects.get(id), centre = new THREE.Vector3().fromArray(object.center);
    const away = 2.5 * Math.max(0.4, Math.hypot(object.size[0], object.size[1], object.size[2]));
    const direction = Page.view.camera.position.clone().sub(Page.view.controls.target).normalize();
    Page.view.lookFrom(centre.clone().addScaledVector(direction, away), centre);
  };

  function setTheme(theme) {
    document.documentElement.dataset.theme = theme;
    Page.view.useTheme();
    Page.emit("theme", theme);
  }
  Page.byId("theme").addEventListener("click", () => setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark"));

  // The link: c eye, t target, o object, k image, h hidden layers.
  const vector = (v) => v.toArray().map((x) => x.toFixed(3)).join(",");
  Page.link = function () {
    const hidden = Array.from(document.querySelectorAll("#layers input")).filter((b) => !b.checked).map((b) => b.name);
    const parts = ["c=" + vector(Page.view.camera.position), "t=" + vector(Page.view.controls.target)];
    if (Page.selected !== null) parts.push("o=" + encodeURIComponent(Page.selected));
    if (Page.keyframe >= 0) parts.push("k=" + Page.keyframe);
    if (hidden.length) parts.push("h=" + hidden.join(","));
    return "#" + parts.join("&");
  };
  function keepView() {
    if (!Page.ready) return;  // the link that the page was opened with still counts
    try { history.replaceState(null, "", Page.link()); } catch (error) { /* a frame without an address */ }
  }
  function numbers(text) {
    const list = (text || "").split(",").map(Number);
    return list.length === 3 && list.every(Number.isFinite) ? new THREE.Vector3().fromArray(list) : null;
  }
  function followLink() {
    const parts = new URLSearchParams(location.hash.slice(1));
    for (const name of (parts.get("h") || "").split(",")) if (layerNames.includes(name)) setLayer(name, false);
    if (parts.has("k")) Page.keyframes.show(Number(parts.get("k")) || 0);
    if (parts.has("o")) Page.select(parts.get("o"));
    const eye = numbers(parts.get("c")), target = numbers(parts.get("t"));
    if (eye && target) Page.view.lookFrom(eye, target);
    return Boolean(eye && target);
  }
  Page.on("rest", keepView);
  Page.on("select", keepView);
  Page.on("keyframe", keepView);
  window.addEventListener("hashchange", followLink);
  Page.byId("link").addEventListener("click", function () {
    keepView();
    const done = () => Page.note("The link is copied: it shows this view of this file.");
    if (navigator.clipboard) navigator.clipboard.writeText(location.href).then(done, () => Page.note("The link is in the address line."));
    else Page.note("The link is in the address line.");
  });

  Page.byId("title").textContent = document.title = Page.data.title;
  setTheme(window.matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  Page.compare.rebuild();
  Page.table.rebuild();
  Page.details.rebuild();
  Page.editing.rebuild();
  Page.save.rebuild();
  Page.showTab("objects");
  Page.view.resize();
  Page.keyframes.show(0);
  if (!followLink()) Page.fit();
  Page.ready = true;
})();
