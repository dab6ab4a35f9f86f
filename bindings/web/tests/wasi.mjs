// Runs a program for WASI in node, with the files and the variables of this machine: `node wasi.mjs PROGRAM ARGUMENTS`.

import { readFileSync } from "node:fs";
import { WASI } from "node:wasi";

const args = process.argv.slice(2);
const wasi = new WASI({ version: "preview1", args, env: process.env, preopens: { "/": "/" } });
const module = await WebAssembly.compile(readFileSync(args[0]));
wasi.start(await WebAssembly.instantiate(module, wasi.getImportObject()));
