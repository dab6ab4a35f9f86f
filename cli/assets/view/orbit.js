// Where the view is taken from: turned around a point, moved closer, shifted.

import { Spherical, Vector3 } from "./three/three.module.min.js";

const TURN = 0.006; // radians for each pixel
const ZOOM = 0.0012; // of the logarithm of the distance, for each unit of a wheel
const LOWEST = 0.02; // from straight up or down, radians

export class Orbit {
  constructor(camera, element, onChange) {
    this.camera = camera;
    this.element = element;
    this.onChange = onChange;
    this.target = new Vector3();
    this.spherical = new Spherical(1, 1, 0);
    this.range = [0.1, 10];
    this.pointers = new Map();
    element.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    element.addEventListener("contextmenu", (event) => event.preventDefault());
    element.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"]) {
      element.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
    }
  }

  /** Looks at a point from a distance; angles in degrees as in the program: about y from z to x, and above the horizon. */
  look(target, distance, azimuth, elevation) {
    this.target.copy(target);
    this.spherical.set(distance, Math.PI / 2 - elevation * Math.PI / 180, azimuth * Math.PI / 180);
    this.range = [0.1 * distance, 8 * distance];
    this.place();
  }

  /** Takes a pointer that has grabbed nothing else. */
  take(event) {
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    this.element.setPointerCapture(event.pointerId);
  }

  move(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY];
    const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
    if (this.pointers.size > 1) {
      const spread = () => {
        const [[ax, ay], [bx, by]] = this.pointers.values();
        return Math.max(1, Math.hypot(ax - bx, ay - by));
      };
      const wide = spread();
      this.pointers.set(event.pointerId, now);
      this.zoom(wide / spread());
      this.shift(dx / 2, dy / 2);
    } else if (event.buttons & 6 || event.shiftKey) {
      this.shift(dx, dy);
    } else {
      this.spherical.theta -= TURN * dx;
      this.spherical.phi = Math.min(Math.PI - LOWEST, Math.max(LOWEST, this.spherical.phi - TURN * dy));
    }
    this.pointers.set(event.pointerId, now);
    this.place();
  }

  wheel(event) {
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 : 1;
    this.zoom(Math.exp(ZOOM * lines * event.deltaY));
    this.place();
  }

  zoom(factor) {
    const [nearest, farthest] = this.range;
    this.spherical.radius = Math.min(farthest, Math.max(nearest, factor * this.spherical.radius));
  }

  /** By pixels, so that the point in the middle follows the pointer. */
  shift(dx, dy) {
    const scale = 2 * this.spherical.radius * Math.tan(this.camera.fov * Math.PI / 360) / this.element.clientHeight;
    const [right, up] = [new Vector3(), new Vector3()];
    this.camera.matrix.extractBasis(right, up, new Vector3());
    this.target.addScaledVector(right, -dx * scale).addScaledVector(up, dy * scale);
  }

  place() {
    this.camera.position.setFromSpherical(this.spherical).add(this.target);
    this.camera.lookAt(this.target);
    this.camera.updateMatrix();
    this.camera.updateMatrixWorld();
    this.onChange();
  }
}
