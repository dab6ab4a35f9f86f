// A viewer and a browser that looks at it.

import { spawn } from "node:child_process";
import { once } from "node:events";
import { existsSync, readFileSync } from "node:fs";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const TIP_OF_TAIL = 5; // a vertex of the dinosaur's surface
const piola = process.env.PIOLA ?? fileURLToPath(new URL("../../target/debug/piola", import.meta.url));
const browsers = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];

/** Starts `piola view` with these arguments at a free port. */
export async function view(...args) {
  const child = spawn(piola, ["view", ...args, "--port", "0"], { stdio: ["ignore", "pipe", "inherit"] });
  const ended = once(child, "exit").then(([status]) => {
    throw new Error(`${piola} has ended with status ${status}`);
  });
  const [line] = await Promise.race([once(createInterface(child.stdout), "line"), ended]);
  ended.catch(() => {}); // when it is stopped
  const address = line.match(/http:\S+/)[0];
  return {
    address,
    origin: new URL(address).origin,
    isRunning: () => child.exitCode === null && child.signalCode === null,
    stop: () => child.kill(),
    /** Memory in use, MiB. */
    memory() {
      const status = readFileSync(`/proc/${child.pid}/status`, "utf8");
      return Number(status.match(/VmRSS:\s*(\d+) kB/)[1]) / 1024;
    },
  };
}

/** Opens the page in a window of 1280 × 800; `faults` collects what a page must not do. */
export async function open(viewer) {
  const browser = await chromium.launch({
    executablePath: browsers.find((path) => path && existsSync(path)),
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  const faults = [];
  page.on("console", (message) => {
    // Reading pixels for a screenshot stalls the graphics driver, and it says so.
    const isAboutDriver = message.text().includes("GPU stall due to ReadPixels");
    if (["error", "warning"].includes(message.type()) && !isAboutDriver) faults.push(message.text());
  });
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("request", (request) => {
    const url = request.url();
    if (!url.startsWith(viewer.origin) && !url.startsWith("data:")) faults.push(`a request to ${url}`);
  });
  await page.goto(viewer.address);
  await page.waitForFunction(() => globalThis.piola?.positions() && globalThis.piola.figures());
  return { browser, page, faults };
}

/** Grabs the tip of the dinosaur's tail, which is on the screen somewhere. */
export async function grabTail(page) {
  const place = await page.evaluate((vertex) => globalThis.piola.where(vertex), TIP_OF_TAIL);
  const [x, y] = place.map(Math.round);
  // The tip itself is a pixel; what is seen of the tail lies on its side towards the body.
  for (const [dx, dy] of [[0, 0], [3, 2], [5, 4], [8, 6], [12, 8], [16, 10]]) {
    const vertex = await page.evaluate(([x, y]) => globalThis.piola.vertexAt(x, y), [x + dx, y + dy]);
    if (vertex !== null) {
      await page.mouse.move(x + dx, y + dy);
      await page.mouse.down();
      return { vertex, at: [x + dx, y + dy] };
    }
  }
  throw new Error(`there is nothing of the tail near ${x}, ${y}`);
}
