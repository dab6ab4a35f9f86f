// The line itself, to the program that has served this page.

/** Opens a socket, which says and hears what `link.js` does. */
export function openLine() {
  // The secret of the address that the program has printed opens the line, too.
  const token = new URLSearchParams(location.search).get("token") ?? "";
  const socket = new WebSocket(`ws://${location.host}/socket?token=${encodeURIComponent(token)}`);
  socket.binaryType = "arraybuffer";
  return socket;
}
