// What is seen: the body on its floor under a warm key light and a cool sky, as in the pictures that `piola run` makes.

import * as THREE from "./three/three.module.min.js";

// Linear colours, as in the program's own pictures.
const FLOOR = [0.8, 0.8, 0.795];
const HAZE = [0.9, 0.915, 0.94];
const KEY = [0.6, 0.57, 0.52];
const SKY = [0.4, 0.43, 0.48];
const INK = [0.08, 0.085, 0.1];
const PULL = [0.75, 0.13, 0.05];
const MAX_PULLS = 64;

const linear = ([r, g, b]) => new THREE.Color().setRGB(r, g, b, THREE.LinearSRGBColorSpace);

export class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.VSMShadowMap;
    this.camera = new THREE.PerspectiveCamera(32, 1, 0.01, 100);
    this.scene = new THREE.Scene();
    this.scene.background = linear(HAZE);
    this.isStale = true;

    // Irradiance on open floor is one: of a lamp it is intensity times cosine, and reflectance is divided by π.
    this.sky = new THREE.HemisphereLight(linear(SKY), linear([0.3, 0.3, 0.29]), Math.PI);
    this.key = new THREE.DirectionalLight(linear(KEY), Math.PI);
    this.key.castShadow = true;
    this.key.shadow.mapSize.set(512, 512);
    this.key.shadow.radius = 4;
    this.key.shadow.blurSamples = 10;
    this.key.shadow.bias = -0.004;
    this.scene.add(this.sky, this.key, this.key.target);

    this.floor = new THREE.Mesh(
      new THREE.PlaneGeometry(2, 2).rotateX(-Math.PI / 2),
      new THREE.MeshLambertMaterial({ color: linear(FLOOR) }),
    );
    this.floor.receiveShadow = true;
    this.body = new THREE.Mesh(
      new THREE.BufferGeometry(),
      new THREE.MeshStandardMaterial({ roughness: 0.62, metalness: 0, side: THREE.DoubleSide }),
    );
    this.body.castShadow = this.body.receiveShadow = true;
    this.cage = new THREE.LineSegments(
      new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({ color: linear(INK), transparent: true, opacity: 0.45 }),
    );
    this.cage.visible = false;
    this.springs = new THREE.LineSegments(
      new THREE.BufferGeometry().setAttribute("position", attribute(new Float32Array(6 * MAX_PULLS))),
      new THREE.LineBasicMaterial({ color: linear(PULL), depthTest: false }),
    );
    this.handles = new THREE.InstancedMesh(
      new THREE.SphereGeometry(1, 20, 12),
      new THREE.MeshBasicMaterial({ color: linear(PULL), depthTest: false }),
      2 * MAX_PULLS,
    );
    this.springs.renderOrder = this.handles.renderOrder = 1;
    this.pulls = [];
    // Positions move with each frame: nothing is culled by where it was.
    for (const moving of [this.body, this.cage, this.springs, this.handles]) {
      moving.frustumCulled = false;
      moving.material.fog = false;
    }
    this.scene.add(this.floor, this.body, this.cage, this.springs, this.handles);
  }

  /** Sets the scene for a body of these bounds at rest, m, and of this linear colour. */
  furnish([low, high], colour, azimuth) {
    const [min, max] = [new THREE.Vector3(...low), new THREE.Vector3(...high)];
    const size = max.distanceTo(min);
    this.height = max.y - min.y;
    this.centre = min.clone().add(max).multiplyScalar(0.5);
    this.size = size;
    this.body.material.color = linear(colour);

    // High over the left shoulder of whoever looks from where the scene is looked at.
    const angle = azimuth * Math.PI / 180;
    const from = new THREE.Vector3(Math.sin(angle), 0, Math.cos(angle));
    const left = new THREE.Vector3(0, 1, 0).cross(from).negate();
    const towards = new THREE.Vector3(0, 1.5, 0).addScaledVector(left, 0.6).addScaledVector(from, 0.75).normalize();
    this.key.intensity = Math.PI / towards.y;
    this.key.target.position.copy(this.centre);
    this.key.position.copy(this.centre).addScaledVector(towards, 4 * size);
    const reach = 2 * size;
    Object.assign(this.key.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: size, far: 8 * size });
    this.key.shadow.camera.updateProjectionMatrix();

    this.floor.position.set(this.centre.x, min.y - 0.002 * size, this.centre.z);
    this.floor.scale.setScalar(40 * size);
    this.scene.fog = new THREE.Fog(linear(HAZE));
    Object.assign(this.camera, { near: 0.02 * size, far: 60 * size });
    this.resize();
  }

  /** The surface's triangles and the cage's edges, whose positions are to come. */
  connect(triangles, edges) {
    this.body.geometry.dispose();
    this.body.geometry = new THREE.BufferGeometry().setIndex(new THREE.BufferAttribute(triangles.slice(), 1));
    this.cage.geometry.dispose();
    this.cage.geometry = new THREE.BufferGeometry().setIndex(new THREE.BufferAttribute(edges.slice(), 1));
  }

  /** A new frame. */
  move(vertices, nodes) {
    const geometry = this.body.geometry;
    if (!geometry.hasAttribute("position")) {
      geometry.setAttribute("position", attribute(new Float32Array(vertices.length)));
      geometry.setAttribute("normal", attribute(new Float32Array(vertices.length)));
      // Rays are cast at every triangle; where the body was says nothing.
      geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), Infinity);
      this.cage.geometry.setAttribute("position", attribute(new Float32Array(nodes.length)));
    }
    const { position, normal } = geometry.attributes;
    position.array.set(vertices);
    smooth(position.array, geometry.index.array, normal.array);
    this.cage.geometry.attributes.position.array.set(nodes);
    for (const changed of [position, normal, this.cage.geometry.attributes.position]) changed.needsUpdate = true;
    this.isStale = true;
  }

  /** Which vertex is pulled where. */
  show(pulls) {
    this.pulls = pulls;
    this.isStale = true;
  }

  place(vertex) {
    return new THREE.Vector3().fromBufferAttribute(this.body.geometry.attributes.position, vertex);
  }

  drawPulls() {
    const lines = this.springs.geometry.attributes.position;
    const at = new THREE.Matrix4();
    this.pulls.forEach(([vertex, target], k) => {
      const ends = [this.place(vertex), new THREE.Vector3(...target)];
      ends.forEach((end, side) => {
        lines.setXYZ(2 * k + side, end.x, end.y, end.z);
        // Of the same size on the screen however far away; the target's is the smaller one.
        const radius = (side ? 0.004 : 0.0055) * this.camera.position.distanceTo(end);
        this.handles.setMatrixAt(2 * k + side, at.makeScale(radius, radius, radius).setPosition(end));
      });
    });
    this.springs.geometry.setDrawRange(0, 2 * this.pulls.length);
    this.handles.count = 2 * this.pulls.length;
    lines.needsUpdate = this.handles.instanceMatrix.needsUpdate = true;
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(1, height);
    this.camera.updateProjectionMatrix();
    this.isStale = true;
  }

  /** Draws what has changed; says whether there was anything. */
  draw() {
    if (!this.isStale || !this.body.geometry.hasAttribute("position")) return false;
    this.isStale = false;
    this.drawPulls();
    // The floor fades into the haze behind the body, from however far away both are seen.
    this.scene.fog.near = 1.2 * this.camera.position.distanceTo(this.centre) + 0.4 * this.size;
    this.scene.fog.far = this.scene.fog.near + 12 * this.size;
    this.renderer.render(this.scene, this.camera);
    return true;
  }
}

function attribute(array) {
  return new THREE.BufferAttribute(array, 3).setUsage(THREE.DynamicDrawUsage);
}

/** Normals of the vertices: the sum of those of the triangles around each, weighted by area; the shader makes them unit. */
function smooth(positions, triangles, normals) {
  normals.fill(0);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ax = positions[a], ay = positions[a + 1], az = positions[a + 2];
    const ux = positions[b] - ax, uy = positions[b + 1] - ay, uz = positions[b + 2] - az;
    const vx = positions[c] - ax, vy = positions[c + 1] - ay, vz = positions[c + 2] - az;
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    for (const corner of [a, b, c]) {
      normals[corner] += nx;
      normals[corner + 1] += ny;
      normals[corner + 2] += nz;
    }
  }
}
