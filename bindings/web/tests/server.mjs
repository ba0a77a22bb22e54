// Simple static server like that of any host: no special headers, with its own path.
import { createServer } from "node:http";
import { readFileSync } from "node:fs";
import { extname, join, normalize } from "node:path";

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml", ".wasm": "application/wasm" };

// Serves a folder below a path, and counts the transferred bytes. Uses brotli if the client supports it.
export function serve(folder, path) {
  const counted = { bytes: 0, files: [], first: null };
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url, "http://host");
    const name = pathname === path ? "index.html" : normalize(pathname.slice(path.length));
    try {
      if (!pathname.startsWith(path) || name.startsWith("..")) throw new Error("elsewhere");
      const packed = (request.headers["accept-encoding"] ?? "").includes("br");
      const content = readFileSync(join(folder, packed ? `${name}.br` : name));
      // The service worker is requested after the first picture.
      if (name === "offline.js") counted.first ??= { bytes: counted.bytes };
      counted.bytes += content.length;
      counted.files.push(name);
      const headers = { "content-type": TYPES[extname(name)] ?? "application/octet-stream", "cache-control": "no-cache" };
      response.writeHead(200, packed ? { ...headers, "content-encoding": "br" } : headers).end(content);
    } catch {
      response.writeHead(404).end();
    }
  });
  return new Promise((resolve) => {
    server.listen(0, "127.0.0.1", () => {
      resolve({ address: `http://127.0.0.1:${server.address().port}${path}`, counted, close: () => server.close() });
    });
  });
}
