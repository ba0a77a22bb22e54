// Stores the files of the page, so that it opens without a network after the first visit.
import { CACHE, MODULE, MODELS } from "./files.js";

const HASHED = /-[0-9a-f]{16}\.\w+$/;
const PAGE = ["./", "./start.js", "./lanes.js", "./worker.js", "./files.js", "./ehl_web.js", "./style.css", "./icon.svg"];

self.addEventListener("install", (event) => {
  // The page itself has already stored the large files.
  event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll(PAGE)).then(() => self.skipWaiting()));
});

self.addEventListener("activate", (event) => {
  // Deletes files of previous versions.
  const known = new Set([MODULE, ...Object.values(MODELS)].map(({ file }) => new URL(file, self.location).href));
  const clean = async () => {
    const cache = await caches.open(CACHE);
    for (const request of await cache.keys()) {
      if (HASHED.test(request.url) && !known.has(request.url)) await cache.delete(request);
    }
    await self.clients.claim();
  };
  event.waitUntil(clean());
});

self.addEventListener("fetch", (event) => {
  const { request } = event;
  if (request.method !== "GET" || new URL(request.url).origin !== self.location.origin) return;
  event.respondWith(answer(request));
});

// A file with a hash in its name never changes. Other files are requested again if there is a network.
async function answer(request) {
  const cache = await caches.open(CACHE);
  const kept = await cache.match(request, { ignoreSearch: true });
  if (kept && HASHED.test(new URL(request.url).pathname)) return kept;
  try {
    const fresh = await fetch(request);
    if (fresh.ok) await cache.put(request, fresh.clone());
    return fresh;
  } catch (why) {
    if (kept) return kept;
    throw why;
  }
}
