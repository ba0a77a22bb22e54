// Starts the explorer on the canvas, and provides the browser functions that it needs.
import init, { start, deliver, dropped, opened } from "./ehl_web.js";
import { CACHE, MODULE, MODELS } from "./files.js";
import { LIVE, Lanes } from "./lanes.js";

const element = (id) => document.getElementById(id);
const LARGEST_FILE = 64 << 20;

function say(text) {
  element("what").textContent = text;
}

// Errors are shown above the last picture.
function failed(text) {
  element("waiting").className = "";
  element("progress").hidden = true;
  say(text);
}

// Fetches a file with a hash in its name, once for all visits, with progress in bytes.
async function fetched(file, progress) {
  // The cache is not available on insecure connections.
  const cache = await globalThis.caches?.open(CACHE).catch(() => undefined);
  const kept = await cache?.match(file);
  const response = kept ?? (await fetch(file));
  if (response.ok && !kept) cache?.put(file, response.clone()).catch(() => {});
  if (!response.ok) throw new Error(`${file}: ${response.status} ${response.statusText}`);
  if (!response.body) return new Uint8Array(await response.arrayBuffer());
  const reader = response.body.getReader();
  const parts = [];
  let length = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    parts.push(value);
    length += value.length;
    progress?.(length);
  }
  const bytes = new Uint8Array(length);
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}

const models = new Map();
async function model(name, progress) {
  if (!(name in MODELS)) throw new Error(`there is no model ${name}`);
  if (models.has(name)) return;
  const bytes = await fetched(MODELS[name].file, progress);
  models.set(name, bytes);
  lanes.files[name] = URL.createObjectURL(new Blob([bytes]));
  // The program reads the file in a task of its own, so that the page stays responsive.
  await new Promise((resolve) => setTimeout(resolve));
}

const lanes = new Lanes((ticket, bytes) => deliver(ticket, bytes));

globalThis.ehl = {
  download(name, bytes) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([bytes], { type: "application/octet-stream" }));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  },
  pick(endings, ticket) {
    const input = document.createElement("input");
    input.type = "file";
    input.accept = endings;
    input.addEventListener("change", () => chosen(input.files[0], (bytes) => deliver(ticket, bytes)));
    input.addEventListener("cancel", () => deliver(ticket, undefined));
    input.click();
  },
  keep(name, text) {
    try {
      localStorage.setItem(name, text);
    } catch (refused) {
      return `the storage of the browser is full or not available (${refused.name})`;
    }
  },
  kept: (name) => localStorage.getItem(name) ?? undefined,
  post: (lane, ticket, kind, task) => lanes.post(lane, ticket, kind, task),
  stop: (ticket, times) => lanes.stop(ticket, times),
  fetch_model(name, ticket) {
    model(name).then(() => deliver(ticket, new Uint8Array()), () => deliver(ticket, undefined));
  },
  model: (name) => models.get(name),
  link(fragment) {
    if (location.hash !== fragment) history.replaceState(history.state, "", fragment || location.pathname + location.search);
  },
  news(text) {
    if (element("news").textContent !== text) element("news").textContent = text;
  },
  fragment: () => location.hash,
  send() {},
  stops: () => 0,
};

// Reads a file that was chosen or dropped: its name, a zero, its content. Files that are too large are not read.
async function chosen(file, take) {
  if (!file) return take(undefined);
  const name = new TextEncoder().encode(file.name);
  if (file.size > LARGEST_FILE) return take(name);
  const content = new Uint8Array(await file.arrayBuffer());
  const bytes = new Uint8Array(name.length + 1 + content.length);
  bytes.set(name);
  bytes.set(content, name.length + 1);
  take(bytes);
}

for (const event of ["dragover", "drop"]) {
  window.addEventListener(event, (happened) => {
    happened.preventDefault();
    happened.stopImmediatePropagation();
    if (event === "drop") chosen(happened.dataTransfer.files[0], (bytes) => bytes && dropped(bytes));
  }, { capture: true });
}

window.addEventListener("hashchange", () => opened(location.hash));

// Chromium reports a wrong number of device pixels while it emulates a tablet. The explorer would then be drawn larger
// than it is touched. Without this number, it computes its size from `devicePixelRatio`.
async function checkPixels(canvas) {
  const told = globalThis.ResizeObserverEntry?.prototype;
  if (!told || !("devicePixelContentBoxSize" in told)) return;
  const width = await new Promise((resolve) => {
    const observer = new ResizeObserver(([entry]) => {
      observer.disconnect();
      resolve(entry.devicePixelContentBoxSize[0].inlineSize);
    });
    observer.observe(canvas);
    // A hidden page observes nothing.
    setTimeout(resolve, 500);
  });
  if (Math.abs(width - canvas.clientWidth * devicePixelRatio) > 1.5) delete told.devicePixelContentBoxSize;
}

async function run() {
  if (typeof WebAssembly !== "object") throw new Error("this browser has no WebAssembly");
  const sizes = { module: MODULE.bytes, line: MODELS.line.bytes };
  const done = { module: 0, line: 0 };
  const progress = (which) => (length) => {
    done[which] = length;
    element("progress").value = (done.module + done.line) / (sizes.module + sizes.line);
  };
  const line = model("line", progress("line"));
  const bytes = await fetched(MODULE.file, progress("module"));
  const module = await WebAssembly.compile(bytes);
  lanes.module = module;
  // Its instance starts while that of the page does.
  lanes.worker(LIVE);
  const { memory } = await init({ module_or_path: module });
  globalThis.ehl.memory = () => memory.buffer.byteLength + lanes.memory();
  await line;
  say("The program starts.");
  await checkPixels(element("explorer"));
  await start(element("explorer"));
  element("waiting").className = "done";
  element("explorer").focus();
  performance.mark("started");
  if ("serviceWorker" in navigator && location.protocol !== "file:") navigator.serviceWorker.register("offline.js").catch(() => {});
}

window.addEventListener("error", ({ error }) => {
  if (error instanceof WebAssembly.RuntimeError) {
    failed("The program has stopped unexpectedly. Load the page again: your last changes are kept.");
  }
});

run().catch((why) => failed(`The program could not be started: ${why.message ?? why}`));
