// The program in WebAssembly, with texts and buffers in place of addresses.

const NOTHING = 0;
const TEXT = 1;

/** Loads the program from a response, or the promise of one, and begins a scene; throws where there is none of that name. */
export async function load(response, scene) {
  const imports = { browser: { now: () => performance.now() } };
  const { instance } = await WebAssembly.instantiateStreaming(response, imports);
  const program = new Program(instance.exports);
  program.tell(scene, instance.exports.begin);
  return program;
}

export class Program {
  constructor(exports) {
    this.exports = exports;
  }

  /** Makes a step if one is due; returns after how many milliseconds the next one is. */
  turn() {
    return this.exports.turn();
  }

  /** Hears a message of the page; throws where it is none. */
  hear(message) {
    this.tell(message, this.exports.hear);
  }

  /** Messages for the page: texts, and buffers of numbers. */
  *messages() {
    for (let kind; (kind = this.exports.next()) !== NOTHING; ) {
      const { memory, message, length } = this.exports;
      const start = message() >>> 0;
      const bytes = memory.buffer.slice(start, start + length());
      yield kind === TEXT ? new TextDecoder().decode(bytes) : bytes;
    }
  }

  tell(text, listen) {
    const bytes = new TextEncoder().encode(text);
    const start = this.exports.room(bytes.length) >>> 0;
    new Uint8Array(this.exports.memory.buffer).set(bytes, start);
    if (!listen()) throw new Error([...this.messages()].join(" ") || "it has not begun");
  }
}
