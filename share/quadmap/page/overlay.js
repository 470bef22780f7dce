"use strict";
// Labels, and the distance that is measured, over the drawn map.
Page.overlay = (function () {
  const canvas = Page.byId("overlay"), pen = canvas.getContext("2d");
  const overlay = {labels: true, measured: [], measuring: false};

  const widths = new Map();  // of texts [px]: measuring them takes longer than drawing them
  function widthOf(text) {
    if (!widths.has(text)) widths.set(text, pen.measureText(text).width);
    return widths.get(text);
  }
  let colors = null;  // of the theme
  function readColors() { colors = {panel: Page.themeColor("--panel"), text: Page.themeColor("--text"), bad: Page.themeColor("--bad")}; }

  function plate(text, x, y, taken) {
    const width = widthOf(text) + 8, box = [x - width / 2, y - 17, x + width / 2, y];
    if (taken.some((t) => t[0] < box[2] && box[0] < t[2] && t[1] < box[3] && box[1] < t[3])) return;
    taken.push(box);
    pen.globalAlpha = 0.85;
    pen.fillStyle = colors.panel;
    pen.fillRect(box[0], box[1], width, 17);
    pen.globalAlpha = 1;
    pen.fillStyle = colors.text;
    pen.fillText(text, box[0] + 4, y - 4);
  }
  function labelOf(object) {
    return Page.nameOf(object) + (Page.isDoubtful(object) ? " ?" : "") + (object.verdict ? " – " + object.verdict : "");
  }
  function drawLabels(taken) {
    const eye = Page.view.camera.position;
    const list = Array.from(Page.objects.values()).filter(Page.shapes.isShown).map(function (object) {
      const top = new THREE.Vector3().fromArray(object.center);
      top.z += 0.5 * object.size[2];
      return {object, top, away: object.id === Page.selected ? 0 : eye.distanceTo(top)};
    });
    list.sort((a, b) => a.away - b.away);
    for (const item of list) {
      const pixel = Page.view.pixelOf(item.top);
      if (pixel) plate(labelOf(item.object), pixel.x, pixel.y - 3, taken);
    }
  }
  function drawMeasure(taken) {
    const pixels = overlay.measured.map(Page.view.pixelOf);
    pen.strokeStyle = pen.fillStyle = colors.bad;
    pen.lineWidth = 2;
    for (const p of pixels) if (p) { pen.beginPath(); pen.arc(p.x, p.y, 4, 0, 7); pen.fill(); }
    if (pixels.length < 2 || !pixels[0] || !pixels[1]) return;
    pen.beginPath();
    pen.moveTo(pixels[0].x, pixels[0].y);
    pen.lineTo(pixels[1].x, pixels[1].y);
    pen.stroke();
    plate(overlay.distance().toFixed(3) + " m", (pixels[0].x + pixels[1].x) / 2, (pixels[0].y + pixels[1].y) / 2, taken);
  }
  overlay.distance = () => overlay.measured[0].distanceTo(overlay.measured[1]);

  Page.view.afterDraw.push(function () {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.font = "12px system-ui, sans-serif";
    if (!colors) readColors();
    const taken = [];
    drawMeasure(taken);
    if (overlay.labels) drawLabels(taken);
  });

  // The nearest thing under the pointer: of objects, and of the cloud when `withCloud`.
  overlay.hitAt = function (event, withCloud) {
    const ray = Page.view.rayAt(event);
    const things = Page.shapes.layers.ellipsoids.visible ? Page.shapes.layers.ellipsoids.children.filter((body) => body.visible) : [];
    if (withCloud && Page.cloud.points && Page.shapes.layers.cloud.visible) things.push(Page.cloud.points);
    ray.params.Points = {threshold: 0.02 * Page.view.camera.position.distanceTo(Page.view.controls.target) / 5};
    return ray.intersectObjects(things)[0] || null;
  };
  function measureAt(event) {
    const hit = overlay.hitAt(event, true);
    if (!hit) return Page.note("Nothing there to measure from.");
    if (overlay.measured.length === 2) overlay.measured = [];
    overlay.measured.push(hit.point);
    Page.note(overlay.measured.length < 2 ? "Click the second point." : "Distance " + overlay.distance().toFixed(3) + " m");
    Page.view.request();
  }

  Page.on("theme", readColors);

  let down = null;
  Page.view.canvas.addEventListener("pointerdown", (event) => { down = event; });
  Page.view.canvas.addEventListener("pointerup", function (event) {
    const isClick = down && Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) < 5;
    down = null;
    if (!isClick || Page.dragging) return;
    if (overlay.measuring) return measureAt(event);
    const hit = overlay.hitAt(event, false);
    Page.select(hit ? hit.object.userData.id : null);
  });
  Page.byId("measure").addEventListener("click", function () {
    overlay.measuring = !overlay.measuring;
    overlay.measured = [];
    this.setAttribute("aria-pressed", overlay.measuring);
    Page.note(overlay.measuring ? "Click the first point, on the cloud or on an object." : "");
    Page.view.request();
  });
  return overlay;
})();
