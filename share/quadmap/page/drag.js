"use strict";
// Dragging the selected cuboid: its body moves it over the floor (with Shift: up and down), the balls on its
// faces move these.
Page.drag = (function () {
  const drag = {on: false}, layer = new THREE.Group(), canvas = Page.view.canvas;
  const ball = new THREE.SphereGeometry(1, 12, 8), paint = new THREE.MeshBasicMaterial({color: 0xff8800, depthTest: false});
  const kSmallest = 0.01;  // size of an object [m]
  Page.view.scene.add(layer);
  let held = null;  // {object, start, axis, sign, plane, from}

  function axisOf(object, i) { return new THREE.Vector3().setComponent(i, 1).applyQuaternion(new THREE.Quaternion().fromArray(object.pose, 3)); }
  function showHandles() {
    layer.remove(...layer.children.slice());
    const object = Page.objects.get(Page.selected);
    if (drag.on && object) for (let i = 0; i < 3; ++i) for (const sign of [-1, 1]) {
      const handle = new THREE.Mesh(ball, paint);
      handle.position.fromArray(object.center).addScaledVector(axisOf(object, i), sign * object.size[i] / 2);
      handle.scale.setScalar(0.012 * Page.view.camera.position.distanceTo(handle.position));
      handle.renderOrder = 1;
      handle.userData = {axis: i, sign};
      layer.add(handle);
    }
    Page.view.request();
  }
  drag.set = function (on) { drag.on = on; showHandles(); };

  // The plane in which the pointer moves: it holds the way that is dragged along and faces the eye.
  function planeFor(along, point) {
    const normal = Page.view.camera.position.clone().sub(point);
    if (along) normal.addScaledVector(along, -normal.dot(along));
    else normal.set(0, 0, 1);
    return new THREE.Plane().setFromNormalAndCoplanarPoint(normal.normalize(), point);
  }
  function grab(event) {
    const object = Page.objects.get(Page.selected);
    if (!drag.on || !object || event.button !== 0) return;
    const ray = Page.view.rayAt(event), handle = ray.intersectObjects(layer.children)[0];
    const body = handle ? null : ray.intersectObject(Page.shapes.drawn.get(object.id).body)[0];
    if (!handle && !body) return;
    const data = handle && handle.object.userData, from = (handle || body).point;
    const along = handle ? axisOf(object, data.axis) : event.shiftKey ? new THREE.Vector3(0, 0, 1) : null;
    held = {object, start: JSON.parse(JSON.stringify(object)), data, along, plane: planeFor(along, from), from};
    Page.dragging = true;
    Page.view.controls.enabled = false;
    canvas.setPointerCapture(event.pointerId);
  }
  function pull(event) {
    if (!held) return;
    const at = Page.view.rayAt(event).ray.intersectPlane(held.plane, new THREE.Vector3());
    if (!at) return;
    const shift = at.sub(held.from), {object, start, data, along} = held;
    const changed = {center: start.center.slice(), size: start.size.slice(), yaw: start.yaw};
    let step = shift;
    if (along) step = along.clone().multiplyScalar(shift.dot(along));
    if (data) {
      const grown = Math.max(kSmallest - start.size[data.axis], data.sign * shift.dot(along));
      changed.size[data.axis] += grown;
      step = along.clone().multiplyScalar(data.sign * grown / 2);
    }
    changed.center = new THREE.Vector3().fromArray(start.center).add(step).toArray();
    Page.editing.setPose(object, changed);
    Page.shapes.update(object);
    showHandles();
  }
  function release() {
    if (!held) return;
    const object = held.object;
    held = null;
    Page.view.controls.enabled = true;
    Page.editing.place(object);
    setTimeout(() => { Page.dragging = false; });  // after the click that ends here
  }
  canvas.addEventListener("pointerdown", grab);
  canvas.addEventListener("pointermove", pull);
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  Page.on("select", showHandles);
  Page.on("edited", showHandles);
  return drag;
})();
