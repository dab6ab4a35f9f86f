// The page without a server: the program in node compared with `piola run`, then the page in a real browser, from files alone.
//
// The environment variables SITE and PIOLA name the folder that `../build` makes and the program; CHROMIUM as in
// cli/browser. Screenshots go to target/page/.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";
import { after, before, test } from "node:test";
import { testPulls } from "../../../cli/browser/pulls.mjs";
import { open } from "../../../cli/browser/viewer.mjs";
import { load } from "../page/program.js";

const { SITE, PIOLA } = process.env;
const shots = fileURLToPath(new URL("../../../target/page/", import.meta.url));
const types = { ".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".wasm": "application/wasm" };
const patience = { timeout: 120_000 };
const FOLDER = "/somewhere/else/"; // the page need not be at the root of its server

let server, browser, page, faults;

before(async () => {
  mkdirSync(shots, { recursive: true });
  server = createServer(({ url }, response) => {
    const name = new URL(url, "http://localhost").pathname.replace(FOLDER, "") || "index.html";
    const file = join(SITE, normalize(name));
    if (!existsSync(file)) return response.writeHead(404).end();
    response.writeHead(200, { "Content-Type": types[extname(file)] ?? "text/plain" }).end(readFileSync(file));
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const origin = `http://127.0.0.1:${server.address().port}`;
  ({ browser, page, faults } = await open({ address: `${origin}${FOLDER}`, origin }));
});

after(async () => {
  await browser?.close();
  server?.close();
});

const figures = () => page.evaluate(() => globalThis.piola.figures());
const until = (condition, value) => page.waitForFunction(condition, value, patience);
const shoot = (name) => page.screenshot({ path: `${shots}static-${name}.png` });

/** A response with the program, as a server gives it. */
const program = () =>
  new Response(readFileSync(join(SITE, "piola.wasm")), { headers: { "Content-Type": "application/wasm" } });

/** Positions of the surface after `steps` steps of the program in node. */
async function surfaceInNode(steps) {
  const running = await load(program(), "dinosaur");
  for (let k = 0; k < steps; k++) running.hear(JSON.stringify({ run: { step: {} } }));
  running.hear(JSON.stringify({ look: {} }));
  running.turn();
  const numbers = [...running.messages()].filter((message) => typeof message !== "string").at(-1);
  const [kind, vertices] = new Uint32Array(numbers, 0, 3);
  assert.equal(kind, 1);
  return new Float32Array(numbers, 12, 3 * vertices);
}

/** Positions of the surface in a file that `piola run` has written. */
function surfaceInFile(path) {
  const bytes = readFileSync(path);
  const start = bytes.indexOf("end_header\n") + "end_header\n".length;
  const vertices = Number(bytes.toString("latin1", 0, start).match(/element vertex (\d+)/)[1]);
  return new Float32Array(bytes.buffer.slice(bytes.byteOffset + start, bytes.byteOffset + start + 12 * vertices));
}

test("the first steps are those of `piola run`", async () => {
  const steps = 30; // half a second of the pull of the scene
  const folder = mkdtempSync(join(tmpdir(), "piola-steps-"));
  try {
    execFileSync(PIOLA, ["run", "dinosaur", "--frames", String(steps), "--out", join(folder, "run")], { stdio: "ignore" });
    const expected = surfaceInFile(join(folder, "run", `frame_${String(steps).padStart(4, "0")}.ply`));
    const rest = surfaceInFile(join(folder, "run", "frame_0000.ply"));
    const found = await surfaceInNode(steps);
    const greatest = (a, b) => a.reduce((most, x, k) => Math.max(most, Math.abs(x - b[k])), 0);
    assert.equal(found.length, expected.length);
    assert.ok(greatest(found, rest) > 0.1, "it has moved");
    // Each is rounded to 24 bits, by half a unit of numbers below 4; lanes and solvers round 29 bits further down.
    assert.ok(greatest(found, expected) <= 2 * 2 ** -23, `${greatest(found, expected)} m`);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});

test("nonsense is refused with its reason", async () => {
  await assert.rejects(load(program(), "dinosaurs"), /dinosaurs/);
  const running = await load(program(), "dinosaur");
  assert.throws(() => running.hear(JSON.stringify({ leap: {} })), /leap/);
});

testPulls(() => page, until, shoot);

test("an energy is typed, a mistake is marked, and the scene begins anew", async () => {
  const field = page.locator("#energy-text");
  await field.fill("mu/2*(I1 - 3) - mu*ln(J) + mu*stiff(I1)");
  await page.locator("#mistakes:visible").waitFor();
  assert.equal(await page.textContent("#marks mark"), "stiff", "the word is marked");
  await field.fill("mu/2*(I1 - 3) - mu*ln(J) + K/2*(J - 1)^2");
  await until(() => document.getElementById("formula").textContent.includes("K"));
  const { frame } = await figures();
  await until((frame) => globalThis.piola.figures().frame > frame + 3, frame);
  await page.click("#pause");
  await page.click("#reset");
  await until(() => globalThis.piola.figures().frame === 0);
});

test("a scene that does not exist is named where the figures are", async () => {
  const stranger = await browser.newPage();
  await stranger.goto(`${page.url().split(/[?#]/)[0]}?scene=dinosaurs`);
  await stranger.waitForFunction(() => document.getElementById("trouble").textContent.includes("dinosaurs"));
  await stranger.close();
});

test("nothing went wrong on the way", () => assert.deepEqual(faults, []));
