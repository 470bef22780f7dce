"use strict";
// The view: camera, lights, and when to draw. Nothing is drawn unless something changed. While the
// view moves a part of the cloud is drawn; when it rests, all of it.
Page.view = (function () {
  const kRest = 250;  // after the last movement [ms]
  const canvas = Page.byId("gl"), frame = Page.byId("view");
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(45, 1, 0.05, 500);
  camera.up.set(0, 0, 1);
  // Without a graphics card smooth edges cost most of the time.
  function isDrawnBySoftware() {
    const gl = document.createElement("canvas").getContext("webgl");
    const names = gl && gl.getExtension("WEBGL_debug_renderer_info");
    return Boolean(names && /swiftshader|llvmpipe|software|basic render/i.test(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)));
  }
  const bySoftware = isDrawnBySoftware();
  let renderer = null;
  try {
    renderer = new THREE.WebGLRenderer({canvas: canvas, antialias: !bySoftware});
  } catch (error) {
    Page.note("This browser has no WebGL: the map cannot be drawn, tables and images can be used.");
  }
  scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8a8a, 0.75));
  const sun = new THREE.DirectionalLight(0xffffff, 0.45);
  sun.position.set(0.4, -0.6, 1);
  scene.add(sun);
  const controls = new THREE.OrbitControls(camera, canvas);
  controls.screenSpacePanning = true;
  controls.maxDistance = 200;

  const view = {scene, camera, controls, canvas, bySoftware, moving: false, beforeDraw: [], afterDraw: [], frames: 0};
  let requested = false, timer = 0, lastFrame = 0;

  function draw(now) {
    requested = false;
    if (!renderer) return;
    for (const step of view.beforeDraw) step(view.moving ? now - lastFrame : 0);
    lastFrame = now;
    renderer.render(scene, camera);
    ++view.frames;
    for (const step of view.afterDraw) step();
  }

  view.request = function () {
    if (requested) return;
    requested = true;
    requestAnimationFrame(draw);
  };
  view.move = function () {
    view.moving = true;
    clearTimeout(timer);
    timer = setTimeout(function () {
      view.moving = false;
      view.request();
      Page.emit("rest");
    }, kRest);
    view.request();
  };
  view.resize = function () {
    const width = frame.clientWidth, height = frame.clientHeight;
    if (!renderer || !width || !height) return;
    renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    view.request();
  };
  view.lookFrom = function (eye, target) {
    camera.position.copy(eye);
    controls.target.copy(target);
    controls.update();
    view.move();
  };
  // The ray through a pointer event's place.
  view.rayAt = function (event) {
    const box = canvas.getBoundingClientRect();
    const ray = new THREE.Raycaster();
    ray.setFromCamera({x: (event.clientX - box.left) / box.width * 2 - 1,
                       y: 1 - (event.clientY - box.top) / box.height * 2}, camera);
    return ray;
  };
  // Where a point of the map appears [px]; null behind the camera.
  view.pixelOf = function (point) {
    const p = point.clone().project(camera);
    if (p.z > 1 || p.z < -1) return null;
    return {x: (p.x + 1) / 2 * frame.clientWidth, y: (1 - p.y) / 2 * frame.clientHeight};
  };
  view.useTheme = function () {
    scene.background = new THREE.Color(Page.themeColor("--back"));
    view.request();
  };

  controls.addEventListener("change", view.move);
  new ResizeObserver(view.resize).observe(frame);
  return view;
})();
