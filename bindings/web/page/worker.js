// The thread of the program: hears the page, makes steps when they are due, and says what the program has to say.

import { load } from "./program.js";

let program = null;
let timer = null;

/** Lets the program work until there is nothing to do. */
function turn() {
  clearTimeout(timer);
  const rest = program.turn();
  for (const message of program.messages()) {
    if (typeof message === "string") postMessage(message);
    else postMessage(message, [message]);
  }
  if (rest < Infinity) timer = setTimeout(turn, rest);
}

/** Does what may end the program, and says why it has ended. */
async function attempt(action) {
  try {
    await action();
  } catch (error) {
    clearTimeout(timer);
    postMessage({ ended: `The program has ended: ${error.message}` });
  }
}

/** The first message is the name of a scene; the page says no more until it has heard something. */
onmessage = ({ data: scene }) =>
  attempt(async () => {
    program = await load(fetch(new URL("./piola.wasm", import.meta.url)), scene);
    onmessage = ({ data }) =>
      attempt(() => {
        program.hear(data);
        turn();
      });
    turn();
  });
