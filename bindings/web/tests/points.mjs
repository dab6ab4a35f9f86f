// The program `piola-web-points`, on the processor itself or in node.

import { spawnSync } from "node:child_process";
import { closeSync, mkdtempSync, openSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { WASI } from "node:wasi";

/** Lines that the program answers with these arguments and this input. */
export async function run(program, args, input = "") {
  const folder = mkdtempSync(join(tmpdir(), "piola-points-"));
  const [asked, answered] = ["asked", "answered"].map((name) => join(folder, name));
  writeFileSync(asked, input);
  const [stdin, stdout] = [openSync(asked, "r"), openSync(answered, "w")];
  try {
    const status = program.endsWith(".wasm")
      ? await runInNode(program, args, stdin, stdout)
      : spawnSync(program, args, { stdio: [stdin, stdout, "inherit"] }).status;
    if (status !== 0) throw new Error(`${program} has ended with status ${status}`);
    return readFileSync(answered, "utf8").split("\n").slice(0, -1);
  } finally {
    closeSync(stdin);
    closeSync(stdout);
    rmSync(folder, { recursive: true, force: true });
  }
}

async function runInNode(program, args, stdin, stdout) {
  const wasi = new WASI({ version: "preview1", args: [program, ...args], stdin, stdout, returnOnExit: true });
  const module = await WebAssembly.compile(readFileSync(program));
  return wasi.start(await WebAssembly.instantiate(module, wasi.getImportObject())) ?? 0;
}
