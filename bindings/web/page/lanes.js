// Workers for long tasks, one per lane. A worker is started when it is first needed, and again after it has ended.

// Time after which a worker that does not react to 0, 1 or 2 stop requests is ended, in milliseconds. After the first
// request, trainings still process partial results.
const PATIENCE = [Infinity, 1500, 300];
// The memory of an instance never shrinks. A worker with more than this number of bytes is ended after it has been idle
// for this number of milliseconds. The next task starts another one.
const LARGE = 64 << 20;
const REST = 2000;
// Lane of the reduced solves for the picture. Its worker may be larger, because another one must read the models again.
export const LIVE = 2;
const LARGE_LIVE = 160 << 20;
// Memory of all workers above which idle ones are ended: those of other lanes at once, that of the live picture after
// its rest.
const MOST = 240 << 20;

export class Lanes {
  constructor(deliver) {
    this.deliver = deliver;
    this.module = null;
    this.workers = new Map();
    this.tasks = new Map();
    this.spare = [];
    this.nothing = new Blob(["go on"]);
    // Addresses of the model files that the page has fetched, which need no network.
    this.files = {};
  }

  post(lane, ticket, kind, task) {
    if (!this.module) return false;
    // The worker checks whether these addresses still exist. This way it receives a stop request without returning.
    // Making an address takes a millisecond, so that those of ended tasks are used again.
    const wishes = [1, 2].map(() => this.spare.pop() ?? URL.createObjectURL(this.nothing));
    this.tasks.set(ticket, { lane, wishes, revoked: 0 });
    const bytes = task.slice();
    const worker = this.worker(lane);
    worker.asked = performance.now();
    worker.postMessage({ ticket, kind, bytes, wishes, models: this.files }, [bytes.buffer]);
    return true;
  }

  worker(lane) {
    let worker = this.workers.get(lane);
    if (!worker) {
      worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module", name: `solver ${lane}` });
      worker.postMessage({ module: this.module });
      worker.onmessage = ({ data: { ticket, bytes, ended, broken, memory } }) => {
        worker.memory = memory ?? worker.memory;
        if (bytes && this.tasks.has(ticket)) this.deliver(ticket, bytes);
        if (ended) {
          this.forget(ticket);
          setTimeout(() => this.workers.get(lane) === worker && this.free(), REST);
        }
        if (broken) this.end(lane);
        if (this.memory() > MOST) this.free();
      };
      worker.onerror = () => this.end(lane);
      this.workers.set(lane, worker);
    }
    return worker;
  }

  // Ends idle workers with much memory, the largest first.
  free() {
    const bySize = [...this.workers].sort(([, a], [, b]) => (b.memory ?? 0) - (a.memory ?? 0));
    for (const [lane, worker] of bySize) {
      const rests = performance.now() - worker.asked >= REST;
      const much = worker.memory > (lane === LIVE ? LARGE_LIVE : LARGE) || this.memory() > MOST;
      const soon = this.memory() > MOST && lane !== LIVE;
      if (much && (rests || soon) && this.running(lane) === undefined) this.end(lane);
    }
  }

  // Memory of the workers in bytes.
  memory() {
    return [...this.workers.values()].reduce((sum, { memory }) => sum + (memory ?? 0), 0);
  }

  stop(ticket, times) {
    const task = this.tasks.get(ticket);
    if (!task) return;
    const wanted = Math.min(times, 2);
    for (; task.revoked < wanted; task.revoked += 1) URL.revokeObjectURL(task.wishes[task.revoked]);
    if (PATIENCE[wanted] < Infinity) {
      setTimeout(() => this.running(task.lane) === ticket && this.end(task.lane), PATIENCE[wanted]);
    }
  }

  // The running task of a lane: the first one that has not ended. A waiting task receives its stop request when its
  // turn comes; the tasks before it are not affected.
  running(lane) {
    return [...this.tasks].find(([, task]) => task.lane === lane)?.[0];
  }

  forget(ticket) {
    const task = this.tasks.get(ticket);
    if (task) this.spare.push(...task.wishes.slice(task.revoked));
    this.tasks.delete(ticket);
  }

  // Ends a worker. Its tasks are lost, and reported as lost.
  end(lane) {
    this.workers.get(lane)?.terminate();
    this.workers.delete(lane);
    const lost = [...this.tasks].filter(([, task]) => task.lane === lane).map(([ticket]) => ticket);
    lost.forEach((ticket) => this.forget(ticket));
    lost.forEach((ticket) => this.deliver(ticket, undefined));
  }
}
