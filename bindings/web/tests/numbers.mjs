// Compares numbers and times of the page with those of the native program: `PAGE=folder NATIVE=program MODELS=folder
// node numbers.mjs`.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const { PAGE, NATIVE, MODELS } = process.env;
globalThis.ehl = { model: (name) => new Uint8Array(readFileSync(join(MODELS, `${name}.rom`))) };
const { initSync, run } = await import(pathToFileURL(join(PAGE, "ehl_web.js")));
const { MODULE } = await import(pathToFileURL(join(PAGE, "files.js")));
initSync({ module: readFileSync(join(PAGE, MODULE.file)) });

const line = "grid: Uniform(dx: 0.01, domain: (-4.5, 2.0)), ";
const ball = "grid: Plane(dx: 0.04, dy: 0.04, domain: (-4.0, 2.0, -2.5)), ";
const sweep = (contact, grid, over, method) =>
  `Scene(version: 1, title: "numbers", ${contact}at: Moes(m: 20.0, l: 6.0), ${grid}study: Sweep(over: [${over}], methods: [${method}]))`;
const values = (name, list) => `(vary: ${name}, values: List([${list}]))`;
const ms = values("M", [5, 10, 20, 40, 80, 120, 160, 200].map((m) => m.toFixed(1)));
const ls = values("L", ["3.0", "6.0", "9.0", "12.0", "15.0"]);
const kinds = {
  "reduced line": [sweep("", "", `${ms}, ${ls}`, "Reduced()"), 1e-13, 2.5],
  "full line": [sweep("", line, `${ms}, ${ls}`, "Full"), 1e-12, 1.7],
  "reduced ball": [sweep("contact: Point, ", "", `${values("M", ["20.0", "40.0", "80.0", "160.0"])}, ${values("L", ["4.0", "7.0", "10.0", "13.0"])}`, "Reduced()"), 1e-10, 1.8],
  "full ball": [sweep("contact: Point, ", ball, `${values("M", ["30.0", "60.0"])}, ${values("L", ["5.0", "10.0"])}`, "Full"), 1e-10, 3],
};

const folder = mkdtempSync(join(tmpdir(), "ehl-numbers-"));
const median = (list) => list.sort((a, b) => a - b)[Math.floor(list.length / 2)];
// Differences of nearly equal numbers are only rounding errors.
const ROUNDED = /residual|iterations|error_bound/;
let contacts = 0;
let where = "";
let failures = 0;
for (const [name, [scene, tolerance, slower]] of Object.entries(kinds)) {
  const file = join(folder, "scene.ron");
  writeFileSync(file, scene);
  spawnSync(NATIVE, ["run", file, "--out", folder], { env: { ...process.env, RAYON_NUM_THREADS: "1" }, stdio: "ignore" });
  // Commas within quotes belong to the text.
  const cells = (line) => line.split(/,(?=(?:[^"]*"[^"]*")*[^"]*$)/);
  const rows = (text) => text.trim().split("\n").map(cells);
  const [titles, ...native] = rows(readFileSync(join(folder, "scene.sweep.csv"), "utf8"));
  const [own, ...page] = rows(run(scene));
  assert.deepEqual(own, titles);
  assert.equal(page.length, native.length);
  contacts += native.length;
  let worst = 0;
  const times = { native: [], page: [] };
  for (const [row, cells] of native.entries()) {
    for (const [column, cell] of cells.entries()) {
      const other = page[row][column];
      if (titles[column].endsWith("wall_s")) {
        times.native.push(Number(cell));
        times.page.push(Number(other));
      } else if (cell !== "" && Number.isFinite(Number(cell)) && !ROUNDED.test(titles[column])) {
        const difference = Math.abs(Number(other) - Number(cell)) / Math.max(Math.abs(Number(cell)), 1e-300);
        if (difference > worst) [worst, where] = [difference, titles[column]];
      } else if (!ROUNDED.test(titles[column])) assert.equal(other, cell, titles[column]);
    }
  }
  const ratio = median(times.page) / median(times.native);
  const holds = worst <= tolerance && ratio <= slower;
  failures += holds ? 0 : 1;
  console.log(`${holds ? "ok  " : "FAIL"} ${name}: differs by at most ${worst.toExponential(1)} in ${where} (${tolerance}), takes ${ratio.toFixed(2)} times as long (${slower})`);
}
rmSync(folder, { recursive: true });
console.log(`${contacts} contacts; ${Object.keys(kinds).length - failures} passed, ${failures} failed`);
process.exit(failures > 0 ? 1 : 0);
