// The line to a program that runs in this page itself, in a thread of its own.

let line = null;

/** Opens the line, which says and hears what `link.js` does. A program that has ended is not begun again. */
export function openLine() {
  return (line ??= new Line());
}

class Line {
  readyState = WebSocket.CONNECTING;

  constructor() {
    this.worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
    this.worker.onmessage = ({ data }) => {
      if (data.ended) this.close(data.ended);
      else if (this.readyState === WebSocket.OPEN) this.onmessage({ data });
      else this.open(data);
    };
    this.worker.onerror = ({ message }) => this.close(message);
    this.worker.postMessage(new URLSearchParams(location.search).get("scene") ?? "dinosaur");
  }

  /** The first message is there as soon as the program is. */
  open(data) {
    this.readyState = WebSocket.OPEN;
    this.onopen();
    this.onmessage({ data });
  }

  send(text) {
    this.worker.postMessage(text);
  }

  close(reason) {
    this.readyState = WebSocket.CLOSED;
    this.worker.terminate();
    this.onclose({ reason: `${reason}. Load the page again to begin anew.` });
  }
}
