// Builds the page: `node build.mjs PKG MODELS OUT ZOPFLI` reads the output of wasm-bindgen and the model files. It writes
// the static folder, with a hash in the name of each large file, .br and .gz next to every file, and `first-picture.txt`.
// ZOPFLI is the program that compresses the module, which takes a minute.
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { cpSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { brotliCompressSync, constants, gzipSync } from "node:zlib";

const [pkg, models, out, zopfli] = process.argv.slice(2);
const page = join(dirname(fileURLToPath(import.meta.url)), "page");
rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });

// Writes a file under a name that contains the hash of its content.
function hashed(path, name, ending) {
  const content = readFileSync(path);
  const hash = createHash("sha256").update(content).digest("hex").slice(0, 16);
  const file = `${name}-${hash}.${ending}`;
  writeFileSync(join(out, file), content);
  return { file, bytes: content.length };
}

const MODULE = hashed(join(pkg, "ehl_web_bg.wasm"), "ehl", "wasm");
const MODELS = {};
for (const file of readdirSync(models).filter((file) => file.endsWith(".rom")).sort()) {
  MODELS[basename(file, ".rom")] = hashed(join(models, file), basename(file, ".rom"), "rom");
}

for (const file of readdirSync(page)) cpSync(join(page, file), join(out, file));
cpSync(join(pkg, "ehl_web.js"), join(out, "ehl_web.js"));
const constants_ = `const CACHE = "ehl-explorer";\nconst MODULE = ${JSON.stringify(MODULE)};\nconst MODELS = ${JSON.stringify(MODELS, null, 2)};\n`;
writeFileSync(join(out, "files.js"), `${constants_}export { CACHE, MODULE, MODELS };\n`);
// Not every browser supports imports in a service worker.
const offline = readFileSync(join(page, "offline.js"), "utf8").replace(/^import .* from "\.\/files\.js";\n/m, constants_);
writeFileSync(join(out, "offline.js"), offline);

const first = ["index.html", "style.css", "icon.svg", "start.js", "lanes.js", "files.js", "ehl_web.js", MODULE.file, MODELS.line.file];
const sizes = {};
for (const file of readdirSync(out)) {
  const content = readFileSync(join(out, file));
  const params = { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_LGWIN]: 24, [constants.BROTLI_PARAM_SIZE_HINT]: content.length };
  const br = brotliCompressSync(content, { params });
  writeFileSync(join(out, `${file}.br`), br);
  if (file === MODULE.file) execFileSync(zopfli, [join(out, file)]);
  else writeFileSync(join(out, `${file}.gz`), gzipSync(content, { level: 9 }));
  const gz = readFileSync(join(out, `${file}.gz`));
  sizes[file] = { plain: content.length, br: br.length, gz: gz.length };
}
const total = (kind) => first.reduce((sum, file) => sum + sizes[file][kind], 0);
const row = (name, { plain, br, gz }) => `${name}\t${plain}\t${br}\t${gz}`;
const all = { plain: total("plain"), br: total("br"), gz: total("gz") };
writeFileSync(join(out, "first-picture.txt"), ["file\tbytes\tbrotli\tgzip", ...first.map((file) => row(file, sizes[file])), row("all", all), ""].join("\n"));
const mb = (bytes) => (bytes / 1e6).toFixed(2);
console.error(`first picture: ${mb(all.br)} MB by brotli, ${mb(all.gz)} MB by gzip`);
if (all.br > 6.5e6 || all.gz > 8.5e6) {
  console.error("the first picture is to take at most 6.5 MB by brotli and 8.5 MB by gzip");
  process.exitCode = 1;
}
