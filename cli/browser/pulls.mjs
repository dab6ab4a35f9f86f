// What the page does with a dinosaur that is pulled, whoever serves it.

import assert from "node:assert/strict";
import { test } from "node:test";
import { grabTail } from "./viewer.mjs";

/** Whether the body of the page is at rest after the pull of its scene; runs in the page. */
export const isAtRest = () => globalThis.piola.figures().from_rest < 1e-3 && globalThis.piola.figures().time > 2.5;

/** Tests of a page that `pageOf` gives once it is open; `until` waits for a condition in it, `shoot` takes a screenshot. */
export function testPulls(pageOf, until, shoot) {
  test("the body comes to rest after the pull of its scene", async () => {
    const page = pageOf();
    await page.click("#real-time"); // as fast as possible
    await until(isAtRest);
    await page.click("#real-time");
    assert.equal(await page.textContent("#scene"), "dinosaur");
    assert.ok((await page.locator("#material option").count()) >= 55, "the whole catalogue can be chosen");
    await shoot("rest");
  });

  test("a vertex follows the mouse and comes back when it is let go", async () => {
    const page = pageOf();
    const place = (vertex) => page.evaluate((vertex) => globalThis.piola.where(vertex), vertex);
    const { vertex, at: [x, y] } = await grabTail(page);
    const before = await place(vertex);
    for (let k = 1; k <= 10; k++) await page.mouse.move(x - 4 * k, y + 16 * k);
    await until(([vertex, y]) => globalThis.piola.where(vertex)[1] > y + 100, [vertex, before[1]]);
    assert.equal(await page.evaluate(() => globalThis.piola.figures().pulls.length), 1);
    await shoot("pulled");
    await page.mouse.up();
    await until(() => globalThis.piola.figures().pulls.length === 0);
    await until(isAtRest);
    const after = await place(vertex);
    assert.ok(Math.hypot(after[0] - before[0], after[1] - before[1]) < 2, "it is back within two pixels");
  });
}
