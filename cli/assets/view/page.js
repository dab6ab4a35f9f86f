// The page: a stage with a body, a panel, drags, and the line to the program that all of it hangs on.

import { Drags } from "./drag.js";
import { connect } from "./link.js";
import { Orbit } from "./orbit.js";
import { Panel } from "./panel.js";
import { Stage } from "./stage.js";

const COUNTED = 2000; // ms over which pictures are counted
const BROKEN = "The line to the program is broken. Is it still running? A new one prints a new address.";
const FIT = 1.6; // distance of the eye, in diagonals of the body

const canvas = document.getElementById("stage");
const stage = new Stage(canvas);
const orbit = new Orbit(stage.camera, canvas, () => (stage.isStale = true));
let scene = null;

const link = connect({
  topology: (triangles, edges) => stage.connect(triangles, edges),
  positions: (vertices, nodes) => stage.move(vertices, nodes),
  setup(setup) {
    if (setup.scene !== scene) {
      scene = setup.scene;
      stage.furnish(setup.bounds, setup.colour, setup.azimuth);
      orbit.look(stage.centre, FIT * stage.size, setup.azimuth, setup.elevation);
    }
    panel.setUp(setup);
    panel.editor.takeFromAddress();
  },
  figures(figures) {
    panel.setFigures(figures);
    stage.show(figures.pulls);
    if (figures.pulls.length > 0) document.getElementById("hint").classList.add("known");
  },
  refused: (refusal) => panel.refuse(refusal),
  line: (isOpen, reason) => panel.trouble(isOpen ? null : reason || BROKEN),
});
const panel = new Panel(link, (isVisible) => {
  stage.cage.visible = isVisible;
  stage.isStale = true;
});
const drags = new Drags(stage, orbit, link);
new ResizeObserver(() => stage.resize()).observe(canvas);

const drawn = []; // when the last pictures were drawn
function picture(now) {
  link.turn();
  drags.hover();
  if (stage.draw()) drawn.push(now);
  while (drawn.length > 0 && drawn[0] < now - COUNTED) drawn.shift();
  panel.setFramesPerSecond(drawn.length > 1 ? 1000 * (drawn.length - 1) / (drawn.at(-1) - drawn[0]) : null);
  requestAnimationFrame(picture);
}
requestAnimationFrame(picture);

// For the console and for scripts: where a vertex is in the window, which one is at a point, and the figures.
globalThis.piola = {
  where(vertex) {
    const place = stage.place(vertex).project(stage.camera);
    const { left, top, width, height } = canvas.getBoundingClientRect();
    return [left + 0.5 * (1 + place.x) * width, top + 0.5 * (1 - place.y) * height];
  },
  vertexAt: (x, y) => drags.vertexAt(x, y),
  positions: () => stage.body.geometry.attributes.position?.array ?? null,
  figures: () => panel.figures,
};
