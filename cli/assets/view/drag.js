// Hands: a vertex under the pointer is pulled where the pointer goes, in the plane through it that faces the screen.

import { Plane, Raycaster, Vector2, Vector3 } from "./three/three.module.min.js";

export class Drags {
  constructor(stage, orbit, link) {
    Object.assign(this, { stage, orbit, link });
    this.caster = new Raycaster();
    this.drags = new Map(); // by pointer: the drag's number and the plane
    this.next = 0;
    this.pointer = null; // where to look for something to grab
    const { canvas } = stage;
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerleave", () => (this.pointer = null));
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => this.up(event));
  }

  /** The vertex under a point of the window, or null. */
  vertexAt(clientX, clientY) {
    if (!this.stage.body.geometry.hasAttribute("position")) return null;
    this.aim(clientX, clientY);
    const [hit] = this.caster.intersectObject(this.stage.body, false);
    if (!hit) return null;
    const corners = [hit.face.a, hit.face.b, hit.face.c];
    const distance = (vertex) => this.stage.place(vertex).distanceToSquared(hit.point);
    return corners.reduce((best, vertex) => (distance(vertex) < distance(best) ? vertex : best));
  }

  down(event) {
    this.stage.canvas.focus({ preventScroll: true });
    const vertex = event.button === 0 && !event.shiftKey ? this.vertexAt(event.clientX, event.clientY) : null;
    if (vertex === null || this.orbit.pointers.size > 0) {
      this.orbit.take(event);
      return;
    }
    const facing = this.stage.camera.getWorldDirection(new Vector3());
    const place = this.stage.place(vertex);
    const drag = { number: this.next++, vertex, plane: new Plane().setFromNormalAndCoplanarPoint(facing, place) };
    this.drags.set(event.pointerId, drag);
    this.stage.canvas.setPointerCapture(event.pointerId);
    this.stage.canvas.classList.add("pulling");
    this.pull(drag, place);
  }

  move(event) {
    const drag = this.drags.get(event.pointerId);
    if (!drag) {
      this.pointer = event.buttons ? null : [event.clientX, event.clientY];
      return;
    }
    this.aim(event.clientX, event.clientY);
    const target = this.caster.ray.intersectPlane(drag.plane, new Vector3());
    if (target) this.pull(drag, target);
  }

  pull({ number, vertex }, target) {
    this.link.actLater(`drag ${number}`, { pull: { drag: number, vertex, target: target.toArray() } });
  }

  up(event) {
    const drag = this.drags.get(event.pointerId);
    if (!drag) return;
    this.drags.delete(event.pointerId);
    this.link.forget(`drag ${drag.number}`);
    this.link.act({ release: { drag: drag.number } });
    if (this.drags.size === 0) this.stage.canvas.classList.remove("pulling");
  }

  /** Once for each picture: shows whether there is something to grab. */
  hover() {
    if (!this.pointer || this.drags.size > 0) return;
    this.stage.canvas.classList.toggle("over", this.vertexAt(...this.pointer) !== null);
    this.pointer = null;
  }

  aim(clientX, clientY) {
    const { left, top, width, height } = this.stage.canvas.getBoundingClientRect();
    const place = new Vector2(2 * (clientX - left) / width - 1, 1 - 2 * (clientY - top) / height);
    this.caster.setFromCamera(place, this.stage.camera);
  }
}
