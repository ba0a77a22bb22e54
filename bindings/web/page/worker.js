// Instance of the program that does tasks of the page, one after the other.
import { initSync, work } from "./ehl_web.js";
import { MODELS } from "./files.js";

let wishes = [];
let memory;
// Addresses of the model files that the page has already fetched.
let files = {};

// Returns true if an address of the page still exists. The request is synchronous because the worker is busy with its
// task.
function exists(address) {
  try {
    const request = new XMLHttpRequest();
    request.open("GET", address, false);
    request.send();
    return request.status === 200;
  } catch {
    return false;
  }
}

globalThis.ehl = {
  model(name) {
    try {
      const request = new XMLHttpRequest();
      request.open("GET", files[name] ?? MODELS[name].file, false);
      request.responseType = "arraybuffer";
      request.send();
      return request.status === 200 ? new Uint8Array(request.response) : undefined;
    } catch {
      // Without a network, the program reports that the model is missing.
      return undefined;
    }
  },
  send(ticket, event) {
    const bytes = event.slice();
    postMessage({ ticket, bytes, memory: memory.buffer.byteLength }, [bytes.buffer]);
  },
  stops: () => (exists(wishes[0]) ? 0 : exists(wishes[1]) ? 1 : 2),
  post: () => false,
  stop() {},
  fetch_model() {},
  download() {},
  pick() {},
  keep: () => "a worker has no storage",
  kept() {},
  link() {},
  news() {},
  fragment: () => "",
};

onmessage = ({ data: { module, ticket, kind, bytes, wishes: given, models } }) => {
  if (module) {
    memory = initSync({ module }).memory;
    return;
  }
  wishes = given;
  files = models;
  try {
    work(ticket, kind, bytes);
    postMessage({ ticket, ended: true, memory: memory.buffer.byteLength });
  } catch (why) {
    // After a panic, this instance cannot continue.
    console.error(why);
    postMessage({ ticket, broken: true });
  }
};
