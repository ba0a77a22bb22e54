// Tests the lanes of a page with workers that never end: `node lanes.mjs`.
import assert from "node:assert/strict";
import { LIVE, Lanes } from "../page/lanes.js";

const ended = [];
globalThis.Worker = class {
  postMessage({ ticket }) {
    if (ticket > 9) setTimeout(() => this.onmessage({ data: { ticket, ended: true, memory: ticket << 20 } }), 10);
  }
  terminate() {
    ended.push(this);
  }
};
const delivered = [];
const lanes = new Lanes((ticket, bytes) => delivered.push([ticket, bytes]));
lanes.module = {};
const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));
for (const [lane, ticket] of [[1, 1], [1, 2], [0, 3]]) assert(lanes.post(lane, ticket, "study", new Uint8Array(4)));

// A waiting task is stopped without affecting the task that runs before it.
lanes.stop(2, 255);
await pause(500);
assert.deepEqual([ended.length, delivered.length, lanes.running(1)], [0, 0, 1]);
// A running task that does not react ends with its worker; those of other lanes continue.
lanes.stop(1, 255);
await pause(500);
assert.deepEqual([ended.length, delivered], [1, [[1, undefined], [2, undefined]]]);
assert.equal(lanes.running(0), 3);

// An idle worker with much memory is ended, and another one does the next task.
const before = ended.length;
lanes.post(2, 40, "study", new Uint8Array(4));
lanes.post(3, 100, "study", new Uint8Array(4));
await pause(1500);
lanes.post(3, 100, "study", new Uint8Array(4));
await pause(1000);
assert.deepEqual([ended.length, [...lanes.workers.keys()]], [before, [0, 2, 3]]);
await pause(1500);
assert.deepEqual([ended.length, [...lanes.workers.keys()]], [before + 1, [0, 2]]);
assert.equal(lanes.memory(), 40 << 20);
lanes.post(3, 41, "study", new Uint8Array(4));
assert.equal(lanes.running(3), 41);

// Above the limit for all workers, idle ones are ended at once, except that of the live picture, which is ended after
// its rest.
lanes.post(LIVE, 150, "reduced solve", new Uint8Array(4));
lanes.post(4, 90, "study", new Uint8Array(4));
await pause(500);
assert.deepEqual([...lanes.workers.keys()].sort(), [0, LIVE, 3]);
await pause(2500);
assert.deepEqual([...lanes.workers.keys()].sort(), [0, LIVE, 3]);
lanes.post(LIVE, 170, "reduced solve", new Uint8Array(4));
await pause(1000);
assert(lanes.workers.has(LIVE));
await pause(1500);
assert(!lanes.workers.has(LIVE));
console.log("1 passed, 0 failed");
