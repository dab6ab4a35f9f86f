// Lanes of WebAssembly in node: reference cases within the bound that all back ends keep, and the bits of the portable lanes.
//
// The environment variables NATIVE, PORTABLE and SIMD128 name builds of `piola-web-points`; `../check` makes them.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { before, test } from "node:test";
import { run } from "./points.mjs";

const BOUND = 30; // of ‖X − X*‖ in units of u (‖X*‖ + sens), as in tests/tests/reference.rs
const FILES = ["cases", "cases-more", "cases-further", "cases-ordinary"];
const { NATIVE, PORTABLE, SIMD128 } = process.env;
const formats = [
  { single: false, u: 2 ** -53, narrow: (x) => x },
  { single: true, u: 2 ** -24, narrow: Math.fround },
];

/** Requests for all cases, those of one material together, with the cases. */
const requests = [];
before(() => {
  const groups = new Map();
  for (const file of FILES) {
    const url = new URL(`../../../tests/reference/${file}.json`, import.meta.url);
    for (const one of JSON.parse(readFileSync(url)).cases) {
      const key = JSON.stringify([one.material, one.params]);
      groups.set(key, [...(groups.get(key) ?? []), one]);
    }
  }
  for (const cases of groups.values()) {
    const [{ material, params }] = cases;
    const parameters = Object.fromEntries(Object.entries(params).map(([name, value]) => [name, [value].flat()]));
    for (const format of formats) {
      const judged = cases.filter((one) => !format.single || one.f32_exact);
      const request = { material, parameters, single: format.single, F: judged.map(({ F }) => F) };
      if (judged.length > 0) requests.push({ format, cases: judged, text: JSON.stringify(request) });
    }
  }
});

/** Answers of a program to all requests. */
async function answers(program) {
  const lines = await run(program, [], requests.map(({ text }) => `${text}\n`).join(""));
  assert.equal(lines.length, requests.length);
  return lines.map((line) => JSON.parse(line));
}

const norm = (x) => {
  const largest = Math.max(...x.map(Math.abs));
  return largest === 0 ? 0 : largest * Math.hypot(...x.map((entry) => entry / largest));
};

/** The greatest error in any case, in units of u (‖X*‖ + sens). */
function worst(found) {
  let [greatest, judged] = [0, 0];
  requests.forEach(({ format: { u, narrow }, cases }, k) => {
    cases.forEach((one, point) => {
      const quantities = [["P", 9, one.sens.P], ["dPdF", 81, one.sens.dPdF], ["dPdF_psd", 81, one.sens.psd]];
      const leaves = ["P", "dPdF"].some((name) => one[name].some((text) => !Number.isFinite(narrow(Number(text)))));
      assert.equal(found[k].nonfinite[point], leaves, `${one.id}: whether the format holds it`);
      if (leaves) return;
      for (const [name, length, sensitivity] of quantities) {
        const exact = one[name].map(Number);
        if (exact.some((entry) => !Number.isFinite(narrow(entry)))) continue;
        const values = found[k][name].slice(length * point, length * (point + 1));
        const distance = norm(values.map((value, entry) => value - exact[entry]));
        const error = distance === 0 ? 0 : distance / (u * (norm(exact) + sensitivity));
        assert.ok(error <= BOUND, `${one.id}: the error of ${name} is ${error}`);
        greatest = Math.max(greatest, error);
        judged += 1;
      }
    });
  });
  return { greatest, judged };
}

for (const [program, name] of [[PORTABLE, "without simd128"], [SIMD128, "with simd128"]]) {
  test(`reference cases ${name}`, async (t) => {
    const found = await answers(program);
    const { greatest, judged } = worst(found);
    assert.ok(judged > 3000, `${judged} results`);
    t.diagnostic(`at most ${greatest.toFixed(1)} u (‖X*‖ + sens) in ${judged} results`);
    // Where the processor has a fused multiply-add in its base instructions, its portable lanes use that.
    if (process.arch !== "x64") return;
    const native = await answers(NATIVE);
    found.forEach((answer, k) => assert.deepEqual(answer, native[k], requests[k].text));
  });

  test(`functions ${name} have the bits of the processor's portable lanes`, async (t) => {
    if (process.arch !== "x64") return t.skip("those of this processor fuse multiplication and addition");
    const native = await run(NATIVE, ["--functions"]);
    assert.equal(native.length, 34);
    assert.deepEqual(await run(program, ["--functions"]), native);
  });
}
