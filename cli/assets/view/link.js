// The line to the program. Asks for one frame at a time, and drops nothing into a queue: of what a slider or the mouse
// says while an answer is under way, the last word counts.

import { openLine } from "./line.js";

const AGAIN_AFTER = 1000; // ms, after the line has broken

/**
 * Opens the line and keeps it open. `on` has a function for each kind of message: `topology(triangles, edges)`,
 * `positions(vertices, nodes)`, `setup`, `figures`, `refused`, and `line(isOpen)`.
 */
export function connect(on) {
  let socket = null;
  let looks = false; // whether a frame has been asked for
  let acts = false; // whether acts have been sent since the last frame
  const pending = new Map(); // by what they change, the last wins

  const open = () => {
    socket = openLine();
    socket.onopen = () => {
      looks = acts = false;
      on.line(true);
    };
    socket.onclose = (event) => {
      on.line(false, event.reason);
      setTimeout(open, AGAIN_AFTER);
    };
    socket.onmessage = ({ data }) => (typeof data === "string" ? text(data) : binary(data));
  };

  const text = (data) => {
    for (const [kind, content] of Object.entries(JSON.parse(data))) on[kind](content);
  };

  const binary = (data) => {
    const [kind, first, second] = new Uint32Array(data, 0, 3);
    if (kind === 0) {
      on.topology(new Uint32Array(data, 12, 3 * first), new Uint32Array(data, 12 + 12 * first, 2 * second));
    } else {
      looks = acts = false;
      on.positions(new Float32Array(data, 12, 3 * first), new Float32Array(data, 12 + 12 * first, 3 * second));
    }
  };

  const isOpen = () => socket?.readyState === WebSocket.OPEN;
  const send = (message) => isOpen() && socket.send(JSON.stringify(message));

  open();
  return {
    /** Says when steps are made. */
    run: (run) => send({ run }),
    /** Does something to the body. */
    act: (act) => send({ act }),
    /** The same, unless something else is said of the same `subject` before the program has time for it. */
    actLater: (subject, act) => pending.set(subject, act),
    /** Forgets what was to be done to the subject. */
    forget: (subject) => pending.delete(subject),
    /** Once for each picture: passes on what is pending and asks for the next frame. */
    turn() {
      if (!isOpen()) return;
      if (!acts) {
        for (const act of pending.values()) send({ act });
        acts = pending.size > 0;
        pending.clear();
      }
      if (!looks) send({ look: {} });
      looks = true;
    },
  };
}
