// The page in a real browser: it shows the body, lets itself be used, asks for nothing elsewhere and complains of nothing.
//
// `npm test` uses target/debug/piola and Debian's chromium; PIOLA and CHROMIUM name others. Screenshots go to target/page/.

import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { after, before, test } from "node:test";
import { isAtRest, testPulls } from "./pulls.mjs";
import { grabTail, open, view } from "./viewer.mjs";

const shots = fileURLToPath(new URL("../../target/page/", import.meta.url));
const patience = { timeout: 60_000 };
let viewer, browser, page, faults;

before(async () => {
  mkdirSync(shots, { recursive: true });
  viewer = await view("dinosaur");
  ({ browser, page, faults } = await open(viewer));
});

after(async () => {
  await browser?.close();
  viewer?.stop();
});

const figures = () => page.evaluate(() => globalThis.piola.figures());
const until = (condition, value) => page.waitForFunction(condition, value, patience);
const shoot = (name) => page.screenshot({ path: `${shots}${name}.png` });

testPulls(() => page, until, shoot);

test("the speed of the steps is shown", async () => assert.notEqual(await page.textContent("#speed"), "–"));

test("pulled by its tail, several body heights far, it comes back", async () => {
  // From farther away, so that several body lengths fit into the window.
  const { x, y, width, height } = await page.locator("#stage").boundingBox();
  await page.mouse.move(x + 20, y + 20);
  for (let k = 0; k < 12; k++) await page.mouse.wheel(0, 120);
  await page.waitForTimeout(500);
  const { at: [tailX, tailY] } = await grabTail(page);
  for (let k = 1; k <= 40; k++) {
    await page.mouse.move(tailX + (x + width - 30 - tailX) * k / 40, tailY + (y + 60 - tailY) * k / 40);
  }
  await until(() => globalThis.piola.figures().from_rest > 3);
  await shoot("far");
  await page.mouse.up();
  await until(isAtRest);
  assert.equal((await figures()).inverted, 0);
  for (let k = 0; k < 12; k++) await page.mouse.wheel(0, -120);
});

test("beside the body the mouse turns the view, and pulls nothing", async () => {
  const before = await page.evaluate(() => globalThis.piola.where(0));
  await page.mouse.move(100, 150);
  await page.mouse.down();
  await page.mouse.move(180, 160, { steps: 4 });
  await page.mouse.up();
  const after = await page.evaluate(() => globalThis.piola.where(0));
  assert.ok(Math.hypot(after[0] - before[0], after[1] - before[1]) > 5, "the view has turned");
  assert.equal((await figures()).pulls.length, 0);
});

test("a slider changes a parameter, and nonsense is refused beside it", async () => {
  const kappa = page.locator(".slider", { has: page.locator("label", { hasText: /^kappa$/ }) });
  const field = kappa.locator("input[type=number]");
  const before = Number(await field.inputValue());
  await kappa.locator("input[type=range]").focus();
  for (let k = 0; k < 5; k++) await page.keyboard.press("ArrowRight");
  assert.ok(Number(await field.inputValue()) > before);
  await field.fill("-1");
  await field.press("Enter");
  await kappa.locator(".refusal:visible").waitFor();
  assert.match(await kappa.locator(".refusal").textContent(), /kappa/);
  await shoot("refused");
  await field.fill(String(before));
  await field.press("Enter");
  await kappa.locator(".refusal").waitFor({ state: "hidden" });
});

test("the material changes while the body moves", async () => {
  await page.selectOption("#material", "stable_neo_hookean");
  await until(() => document.querySelectorAll("#parameters .slider").length === 2);
  assert.match(await page.textContent("#formula"), /ψ = /);
  const { frame } = await figures();
  await until((frame) => globalThis.piola.figures().frame > frame + 3, frame);
});

test("an energy is typed while the body moves, and shared by its address", async () => {
  const field = page.locator("#energy-text");
  assert.match(await field.inputValue(), /fn StableNeoHookean/, "the energy in use is shown");
  await field.fill("mu/2*(I1 - 3) - mu*ln(J) + lamda/2*ln(J)^2 + mu*stiff(I1)");
  await page.locator("#mistakes:visible").waitFor();
  assert.match(await page.textContent("#mistakes"), /stiff/);
  assert.equal(await page.textContent("#marks mark"), "stiff", "the word is marked");
  const under = await page.locator("#marks mark").boundingBox();
  const around = await field.boundingBox();
  assert.ok(under.x > around.x && under.y > around.y && under.y < around.y + around.height, "where it stands");
  const { frame } = await figures();
  await until((frame) => globalThis.piola.figures().frame > frame, frame); // the energy before is still in use
  await shoot("mistake");
  await page.selectOption("#material", "neo_hookean");
  await until(() => document.getElementById("energy-text").value.includes("fn NeoHookean"));
  assert.ok(await page.locator("#mistakes").isHidden(), "a choice puts an end to what was typed");
  await field.fill("mu/2*(I1 - 3) - mu*ln(J) + K/2*(J - 1)^2");
  await until(() => document.getElementById("formula").textContent.includes("K"));
  assert.ok(await page.locator("#mistakes").isHidden());
  const names = await page.locator("#parameters .slider label").allTextContents();
  assert.deepEqual(names, ["mu", "K"]);
  const bulk = page.locator(".slider", { has: page.locator("label", { hasText: /^K$/ }) }).locator("input[type=number]");
  await bulk.fill("300000");
  await bulk.press("Enter");
  await until(() => new URLSearchParams(location.hash.slice(1)).get("K") === "300000");
  await shoot("typed");
  const address = page.url();
  await page.selectOption("#material", "stable_neo_hookean");
  await until(() => location.hash === "");

  const friend = await browser.newPage();
  await friend.goto(address);
  await friend.waitForFunction(() => document.querySelectorAll("#parameters .slider").length === 2 &&
    document.getElementById("formula").textContent.includes("K"));
  const values = await friend.locator("#parameters input[type=number]").evaluateAll((fields) => fields.map(({ value }) => Number(value)));
  assert.equal(values[1], 300000);
  await friend.close();
  await page.selectOption("#material", "stable_neo_hookean");
  await until(() => document.getElementById("formula").textContent.includes("3/4"));
});

test("pause, step, reset, wireframe, by keys and buttons", async () => {
  await page.locator("#stage").focus();
  await page.keyboard.press("w");
  assert.ok(await page.locator("#wireframe").isChecked());
  await page.keyboard.press("Space");
  await until(() => globalThis.piola.figures().paused);
  const { frame } = await figures();
  await page.keyboard.press(".");
  await until((frame) => globalThis.piola.figures().frame === frame + 1, frame);
  await page.click("#reset");
  await until(() => globalThis.piola.figures().frame === 0);
  await page.click("#step");
  await until(() => globalThis.piola.figures().frame === 1);
  await shoot("wireframe");
  await page.click("#save");
  await page.locator("#restore:enabled").waitFor();
  await page.click("#step");
  await until(() => globalThis.piola.figures().frame === 2);
  await page.keyboard.press("b");
  await until(() => globalThis.piola.figures().frame === 1);
  await page.click("#pause");
  await until(() => !globalThis.piola.figures().paused);
});

test("without the token there is no page, but a word on where it is", async () => {
  const stranger = await browser.newPage();
  const answer = await stranger.goto(viewer.origin);
  assert.equal(answer.status(), 403);
  assert.match(await stranger.textContent("body"), /Open the address that `piola view` has printed/);
  await stranger.close();
});

test("nothing went wrong on the way", () => {
  assert.deepEqual(faults, []);
  assert.ok(viewer.isRunning());
});
