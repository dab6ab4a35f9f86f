// Pulls at random for a long time: nothing that is not a number, no growth of memory, no line that breaks.
//
// `node soak.mjs --minutes 15 --scene dinosaur`; prints a line a minute and ends with status 1 where something is wrong.

import { parseArgs } from "node:util";
import { open, view } from "./viewer.mjs";

const { values } = parseArgs({
  options: { minutes: { type: "string", default: "15" }, scene: { type: "string", default: "dinosaur" } },
});
const minutes = Number(values.minutes);
const GROWTH = 8; // MiB that the allocator may take after the first minute

let seed = 1;
/** Between 0 and 1, the same sequence each time: a multiplicative generator modulo 2³¹ − 1. */
const random = () => (seed = (seed * 48271) % 0x7fffffff) / 0x7fffffff;

const viewer = await view(values.scene);
const { browser, page, faults } = await open(viewer);
const { x, y, width, height } = await page.locator("#stage").boundingBox();
const inside = () => [x + width * (0.05 + 0.9 * random()), y + height * (0.05 + 0.9 * random())];

const start = Date.now();
const elapsed = () => (Date.now() - start) / 60_000;
let [pulls, refused, inverted, memory, warm, reported] = [0, 0, 0, 0, null, 0];
const problems = [];
while (elapsed() < minutes && problems.length === 0) {
  // Only the body can be grabbed: a vertex at random, where it is on the screen.
  const [px, py] = await page.evaluate((share) => {
    const count = globalThis.piola.positions().length / 3;
    return globalThis.piola.where(Math.floor(share * count));
  }, random());
  await page.mouse.move(px, py);
  await page.mouse.down();
  const [tx, ty] = inside();
  await page.mouse.move(tx, ty, { steps: 1 + Math.floor(8 * random()) });
  await page.waitForTimeout(1500 * random());
  const state = await page.evaluate(() => ({
    ...globalThis.piola.figures(),
    isFinite: globalThis.piola.positions().every(Number.isFinite),
    sight: document.getElementById("trouble").textContent,
  }));
  pulls += state.pulls.length;
  inverted = Math.max(inverted, state.inverted);
  await page.mouse.up();
  await page.waitForTimeout(1500 * random());
  if (!state.isFinite) problems.push("a position is not finite");
  if (state.trouble) {
    // A refusal to step is honest, and the page says so; go on from the start.
    refused += 1;
    console.log(`step ${state.frame}: ${state.trouble}`);
    await page.click("#reset");
    await page.click("#pause");
  } else if (state.sight) problems.push(state.sight);
  if (faults.length > 0) problems.push(...faults);
  if (!viewer.isRunning()) problems.push("the viewer has ended");
  else memory = viewer.memory();
  if (elapsed() > 1 && warm === null) warm = memory;
  if (warm !== null && memory > warm + GROWTH) problems.push(`memory grew from ${warm} to ${memory} MiB`);
  if (elapsed() >= reported + 1) {
    reported = Math.floor(elapsed());
    console.log(`${reported} min: ${pulls} pulls, at most ${inverted} elements inverted, ${memory.toFixed(1)} MiB`);
  }
}
const before = await page.evaluate(() => globalThis.piola.figures().frame);
await page.waitForFunction((frame) => globalThis.piola.figures().frame > frame, before);
const isBack = await page.waitForFunction(() => globalThis.piola.figures().from_rest < 1e-3, null, { timeout: 60_000 })
  .then(() => "back at rest", () => "in another equilibrium");
console.log(`${elapsed().toFixed(1)} min, ${pulls} pulls, at most ${inverted} elements inverted, ${refused} steps refused, ` +
  `the body ${isBack}, memory ${warm?.toFixed(1)} MiB after a minute, ${memory.toFixed(1)} MiB at the end`);
console.log(problems.length === 0 ? "nothing went wrong" : problems.join("\n"));
await browser.close();
viewer.stop();
process.exitCode = problems.length === 0 ? 0 : 1;
