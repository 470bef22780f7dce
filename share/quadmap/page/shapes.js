"use strict";
// Ellipsoids, cuboids, trajectories and frustums.
Page.shapes = (function () {
  const scene = Page.view.scene;
  const sphere = new THREE.SphereGeometry(1, 20, 12), coarseSphere = new THREE.SphereGeometry(1, 10, 6);
  const boxEdges = new THREE.EdgesGeometry(new THREE.BoxGeometry(1, 1, 1));
  const layers = {};
  for (const name of ["floor", "cloud", "ellipsoids", "cuboids", "trajectory", "odometry", "cameras", "compared"]) {
    layers[name] = new THREE.Group();
    scene.add(layers[name]);
  }
  const drawn = new Map();  // id -> {body, edges}
  let showsDoubtful = true;

  function place(thing, object, scale) {
    thing.position.fromArray(object.pose);
    thing.quaternion.fromArray(object.pose, 3);
    thing.scale.set(scale * object.size[0], scale * object.size[1], scale * object.size[2]);
  }
  function cuboid(object, color) {
    const edges = new THREE.LineSegments(boxEdges, new THREE.LineBasicMaterial({color: color}));
    place(edges, object, 1);
    return edges;
  }
  function update(object) {
    const shown = drawn.get(object.id);
    place(shown.body, object, 0.5);
    place(shown.edges, object, 1);
    Page.view.request();
  }
  function add(object) {
    const color = new THREE.Color(Page.cssColor(object.color));
    const material = new THREE.MeshLambertMaterial({color: color, transparent: true, depthWrite: false});
    const body = new THREE.Mesh(sphere, material);
    body.userData.id = object.id;
    const edges = cuboid(object, color);
    layers.ellipsoids.add(body);
    layers.cuboids.add(edges);
    drawn.set(object.id, {body, edges});
    update(object);
  }
  // Doubtful objects may be hidden, but for the selected one.
  function isShown(object) { return showsDoubtful || object.id === Page.selected || !Page.isDoubtful(object); }
  function setDoubtful(shown) {
    showsDoubtful = shown;
    mark();
  }
  // Doubtful objects are paler; the selected one stands out.
  function mark() {
    for (const [id, shown] of drawn) {
      const object = Page.objects.get(id), isSelected = id === Page.selected;
      shown.body.visible = shown.edges.visible = isShown(object);
      shown.body.material.opacity = isSelected ? 0.75 : Page.isDoubtful(object) ? 0.15 : 0.42;
      shown.body.material.emissive.setHex(isSelected ? 0x333333 : 0);
      shown.edges.material.color.set(isSelected ? Page.themeColor("--text") : Page.cssColor(object.color));
    }
    Page.view.request();
  }
  function rebuild() {
    layers.ellipsoids.remove(...layers.ellipsoids.children.slice());
    layers.cuboids.remove(...layers.cuboids.children.slice());
    drawn.clear();
    for (const object of Page.objects.values()) add(object);
    mark();
  }

  function line(points, color, layer) {
    if (points.length < 2) return;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute([].concat(...points), 3));
    layer.add(new THREE.Line(geometry, new THREE.LineBasicMaterial({color: color})));
  }
  // Eight segments of the pyramid of a keyframe's camera, which looks along its x axis.
  function frustum(keyframe, length) {
    const y = length * Math.tan(keyframe.fov[0] / 2), z = length * Math.tan(keyframe.fov[1] / 2);
    const turn = new THREE.Quaternion().fromArray(keyframe.pose, 3);
    const tip = new THREE.Vector3().fromArray(keyframe.pose);
    const corners = [[y, z], [-y, z], [-y, -z], [y, -z]].map(
      (c) => new THREE.Vector3(length, c[0], c[1]).applyQuaternion(turn).add(tip));
    const out = [];
    corners.forEach((corner, i) => out.push(
      ...tip.toArray(), ...corner.toArray(), ...corner.toArray(), ...corners[(i + 1) % 4].toArray()));
    return out;
  }
  function frustums(keyframes, length, color) {
    const numbers = [];
    for (const keyframe of keyframes) for (const number of frustum(keyframe, length)) numbers.push(number);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(numbers, 3));
    return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({color: color}));
  }

  // What a picture of the whole must show.
  function bounds() {
    const box = new THREE.Box3();
    for (const object of Page.objects.values()) {
      const reach = 0.5 * Math.hypot(object.size[0], object.size[1], object.size[2]);
      const centre = new THREE.Vector3().fromArray(object.center);
      box.expandByPoint(centre.clone().addScalar(reach)).expandByPoint(centre.addScalar(-reach));
    }
    for (const p of Page.data.trajectory) box.expandByPoint(new THREE.Vector3().fromArray(p));
    if (box.isEmpty()) box.set(new THREE.Vector3(-1, -1, 0), new THREE.Vector3(1, 1, 1));
    return box;
  }

  function addFloor() {
    const box = bounds(), size = box.getSize(new THREE.Vector3()), centre = box.getCenter(new THREE.Vector3());
    const side = 2 * Math.ceil(0.5 * Math.max(size.x, size.y) + 1);
    const grid = new THREE.GridHelper(side, side, 0x888888, 0x888888);
    grid.rotation.x = Math.PI / 2;
    grid.position.set(Math.round(centre.x), Math.round(centre.y), Page.data.floor);
    grid.material.transparent = true;
    grid.material.opacity = 0.25;
    layers.floor.add(grid);
  }

  // Without a graphics card the triangles of many bodies take half of a frame's time.
  Page.view.beforeDraw.push(function () {
    const shape = Page.view.moving && Page.view.bySoftware ? coarseSphere : sphere;
    for (const shown of drawn.values()) shown.body.geometry = shape;
  });
  rebuild();
  addFloor();
  line(Page.data.trajectory, 0x2a63d4, layers.trajectory);
  line(Page.data.odometry, 0xe67814, layers.odometry);
  layers.cameras.add(frustums(Page.data.keyframes, 0.08, 0x5d82c9));
  let current = null;
  Page.on("select", mark);
  Page.on("edited", rebuild);
  Page.on("theme", mark);
  Page.on("keyframe", function (index) {
    if (current) scene.remove(current);
    current = index < 0 ? null : frustums([Page.data.keyframes[index]], 0.35, 0xd0272b);
    if (current) scene.add(current);
    Page.view.request();
  });
  return {layers, drawn, place, update, cuboid, bounds, isShown, setDoubtful};
})();
