"use strict";
// The cloud. Its points come in a random order, so that the first ones are a picture of all.
Page.cloud = (function () {
  const kFewest = 4000;                // points while the view moves
  const kSlow = 70, kFast = 35;        // time of a frame beyond which fewer, below which more are drawn [ms]
  const head = Page.data.cloud, block = Page.byId("cloud-data");
  if (!head.points) return {points: null};
  const text = atob(block.textContent), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  block.remove();

  const view = new DataView(bytes.buffer), numbers = new Uint16Array(3 * head.points);
  for (let i = 0; i < numbers.length; ++i) numbers[i] = view.getUint16(2 * i, true);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(numbers, 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(bytes.subarray(6 * head.points, 9 * head.points), 3, true));
  const normals = new Int8Array(bytes.buffer, 9 * head.points);
  geometry.setAttribute("facing", new THREE.BufferAttribute(normals, 3, true));
  const material = new THREE.PointsMaterial({size: 2, sizeAttenuation: false, vertexColors: THREE.VertexColors});
  // Points of which one would see the back are left out: near walls do not hide the room. Neither are
  // those at a grazing angle shown, for normals are noisy (0.15 is the cosine).
  material.onBeforeCompile = function (shader) {
    const last = shader.vertexShader.lastIndexOf("}");
    shader.vertexShader = "attribute vec3 facing;\n" + shader.vertexShader.slice(0, last) +
      "if (dot(normalize((modelViewMatrix * vec4(facing, 0.0)).xyz), normalize(mvPosition.xyz)) > -0.15) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);\n}";
  };
  const points = new THREE.Points(geometry, material);
  points.position.fromArray(head.origin);
  points.scale.setScalar(head.step);
  Page.shapes.layers.cloud.add(points);

  let moving = Math.min(head.points, 60000);
  Page.view.beforeDraw.push(function (elapsed) {
    if (elapsed > kSlow && elapsed < 1000) moving = Math.max(kFewest, Math.round(0.7 * moving));
    if (elapsed > 0 && elapsed < kFast) moving = Math.min(head.points, Math.round(1.15 * moving));
    geometry.setDrawRange(0, Page.view.moving ? moving : head.points);
    points.material.size = Page.view.moving ? 3 : 2;
  });
  return {points};
})();
