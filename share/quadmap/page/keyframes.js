"use strict";
// The images of the keyframes, with their boxes and what became of each.
Page.keyframes = (function () {
  const list = Page.data.keyframes, slider = Page.byId("slider");
  const canvas = Page.byId("image"), pen = canvas.getContext("2d"), boxes = Page.byId("boxes");
  const colors = {complete: "#2fbf5b", partial: "#f0b429", rejected: "#ef4444", none: "#9aa0a6"};
  const bitmap = new Image();
  slider.max = Math.max(0, list.length - 1);

  // A text whose lower left corner is at a place of the image, on a dark ground and never cut.
  function write(text, x, y, color) {
    const height = canvas.width / 26, width = pen.measureText(text).width + 6;
    const left = Math.max(0, Math.min(x, canvas.width - width)), bottom = Math.max(y, height);
    pen.fillStyle = "rgba(0, 0, 0, 0.65)";
    pen.fillRect(left, bottom - height, width, height);
    pen.fillStyle = color;
    pen.fillText(text, left + 3, bottom - height / 4);
  }
  function drawBoxes(keyframe) {
    pen.lineWidth = Math.max(1.5, canvas.width / 300);
    pen.font = "bold " + Math.round(canvas.width / 32) + "px system-ui, sans-serif";
    for (const item of keyframe.boxes) {
      const [x1, y1, x2, y2] = item.box;
      const own = item.object !== null && item.object === Page.selected;
      pen.strokeStyle = own ? "#4da3ff" : colors[item.kind] || colors.none;
      pen.strokeRect(x1, y1, x2 - x1, y2 - y1);
      write(item.label + (item.object === null ? "" : " " + item.object), x1, y1, pen.strokeStyle);
    }
  }
  function draw() {
    if (Page.keyframe < 0) return;
    const keyframe = list[Page.keyframe];
    canvas.width = keyframe.size[0] || 320;
    canvas.height = keyframe.size[1] || 240;
    if (keyframe.jpeg && bitmap.complete && bitmap.naturalWidth) pen.drawImage(bitmap, 0, 0, canvas.width, canvas.height);
    drawBoxes(keyframe);
  }
  function describe(keyframe) {
    const date = Page.dateText(keyframe.time);
    Page.byId("frame-text").textContent = "Image " + (Page.keyframe + 1) + " of " + list.length + ", " +
      keyframe.sensor + ", " + Page.timeText(keyframe.time) + (date ? " (" + date + ")" : "");
    boxes.textContent = "";
    for (const item of keyframe.boxes) {
      const row = Page.element("li", boxes);
      Page.element("span", row, null, "dot").style.background = colors[item.kind] || colors.none;
      Page.element("span", row, item.label + " " + item.score.toFixed(2) + ": " + item.kind + (item.reason ? ", " + item.reason : "") + " ");
      if (item.object === null) Page.element("span", row, "no object", "dim");
      else Page.button(row, "object " + item.object, () => Page.select(item.object));
    }
    if (!keyframe.boxes.length) Page.element("li", boxes, "no boxes", "dim");
  }
  function show(index) {
    if (!list.length) return;
    Page.keyframe = Math.min(Math.max(0, index), list.length - 1);
    slider.value = Page.keyframe;
    const keyframe = list[Page.keyframe];
    describe(keyframe);
    if (keyframe.jpeg) bitmap.src = "data:image/jpeg;base64," + keyframe.jpeg;
    draw();
    Page.emit("keyframe", Page.keyframe);
  }
  // The next image in which a box was taken for an object.
  function showNextOf(id, step) {
    for (let i = 1; i <= list.length; ++i) {
      const index = ((Page.keyframe < 0 ? 0 : Page.keyframe) + step * i + 2 * list.length) % list.length;
      if (list[index].boxes.some((b) => b.object === id)) { show(index); return true; }
    }
    return false;
  }
  // From where the camera stood.
  function look() {
    if (Page.keyframe < 0) return;
    const pose = list[Page.keyframe].pose, eye = new THREE.Vector3().fromArray(pose);
    const ahead = new THREE.Vector3(1.5, 0, 0).applyQuaternion(new THREE.Quaternion().fromArray(pose, 3));
    Page.view.lookFrom(eye, eye.clone().add(ahead));
  }

  bitmap.addEventListener("load", draw);
  slider.addEventListener("input", () => show(Number(slider.value)));
  Page.byId("before").addEventListener("click", () => show(Page.keyframe - 1));
  Page.byId("after").addEventListener("click", () => show(Page.keyframe + 1));
  Page.button(document.querySelector("#keyframes .row"), "Look from here", look);
  Page.on("select", draw);
  if (!list.length) Page.byId("frame-text").textContent = "There are no images here: a page of a whole folder has them.";
  return {show, showNextOf};
})();
