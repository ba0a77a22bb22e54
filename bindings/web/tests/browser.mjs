// Tests the page in a browser like a user: `PAGE=folder BROWSER=program node browser.mjs`.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { serve } from "./server.mjs";

const { chromium } = createRequire(import.meta.url)("playwright-core");
const { PAGE, BROWSER, PICTURES } = process.env;
const FLAGS = [
  "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic",
  "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
];
const SIZE = { width: 1280, height: 800 };
// Positions on the canvas at this size.
// With other load on the machine, frames take longer.
const SLOW = Number(process.env.SLOW ?? 1);
const TABS = [348, 421, 498, 560, 638, 720, 783, 847, 904, 956];
const ROLLER = [34, 66];
const BALL = [87, 66];
const VERIFY = [862, 107];
const M = { from: [150, 93], to: [165, 93] };

const profile = mkdtempSync(join(tmpdir(), "ehl-web-"));
const server = await serve(PAGE, "/course/explorer/");
const context = await chromium.launchPersistentContext(profile, {
  executablePath: BROWSER, args: FLAGS, viewport: SIZE, acceptDownloads: true, colorScheme: "dark",
});
let page;
// Address of the first contact. A page that is opened with it does not restore the session.
let first;
const foreign = [];
const broken = [];
context.on("request", (request) => {
  const url = request.url();
  if (!url.startsWith(server.address) && !url.startsWith("blob:") && !url.startsWith("data:")) foreign.push(url);
});

// Opens the page at an address and waits for the first picture of the explorer.
async function opened(fragment = "") {
  const page = await context.newPage();
  page.on("pageerror", (error) => broken.push(String(error)));
  page.on("console", (message) => message.type() === "error" && broken.push(message.text()));
  await page.goto(server.address + fragment);
  await page.waitForFunction(() => performance.getEntriesByName("started").length > 0, null, { timeout: 60_000 });
  return page;
}

const news = (page) => page.locator("#news").textContent();
const fragment = (page) => page.evaluate(() => location.hash);
const said = (page, words, patience = 60_000) =>
  page.waitForFunction((words) => new RegExp(words).test(document.getElementById("news").textContent), words, { timeout: patience });
async function changed(page, before) {
  await page.waitForFunction((before) => location.hash !== before, before, { timeout: 20_000 });
  return fragment(page);
}
async function picture(page, name) {
  const image = await page.screenshot();
  if (PICTURES) writeFileSync(join(PICTURES, `${name}.png`), image);
  return image;
}
async function drag(page, { from, to }, steps = 20) {
  await page.mouse.move(...from);
  await page.mouse.down();
  for (let step = 1; step <= steps; step += 1) {
    const share = step / steps;
    await page.mouse.move(from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]));
    await page.waitForTimeout(16);
  }
  await page.mouse.up();
}

const tests = {
  async "the first picture comes with little data"() {
    page = await opened();
    await said(page, "Central film");
    const { bytes } = server.counted.first ?? server.counted;
    const seconds = await page.evaluate(() => performance.getEntriesByName("started")[0].startTime / 1000);
    console.log(`  first picture after ${seconds.toFixed(2)} s, ${(bytes / 1e6).toFixed(2)} MB`);
    assert(bytes < 6.5e6, `${bytes} bytes: ${server.counted.files}`);
    await picture(page, "first");
  },
  async "dragging M changes the picture and the address"(page) {
    const before = [await news(page), await changed(page, "")];
    first = before[1];
    await drag(page, M);
    const after = await changed(page, before[1]);
    await page.waitForFunction((before) => document.getElementById("news").textContent !== before, before[0], { timeout: 20_000 });
    await said(page, "Verified|Roughly right");
    assert.match(after, /^#1\./);
    await picture(page, "dragged");
  },
  async "a link opens the same contact in another page"(page) {
    const [address, words] = [await fragment(page), await news(page)];
    const other = await opened(address);
    await said(other, "Central film");
    const film = (text) => text.match(/Central film [^,]*/)[0];
    assert.equal(film(await news(other)), film(words));
    await other.close();
  },
  async "a damaged link is refused with a sentence"(page) {
    const other = await opened("#1.abcdef");
    await said(other, "damaged");
    await other.close();
  },
  async "a ball is solved in a worker while the page stays responsive"(page) {
    await page.evaluate(() => {
      window.longest = 0;
      new PerformanceObserver((list) => list.getEntries().forEach(({ duration }) => (window.longest = Math.max(window.longest, duration)))).observe({ type: "longtask" });
    });
    const before = await fragment(page);
    await page.mouse.click(...BALL);
    await changed(page, before);
    await said(page, "Verified|Roughly right", 240_000);
    await picture(page, "ball");
    const [workers, longest] = [page.workers().length, await page.evaluate(() => window.longest)];
    // The browser reports tasks above 50 ms only.
    console.log(`  longest task of the page ${longest.toFixed(0)} ms, ${workers} workers`);
    assert(workers >= 1 && longest < 50 * SLOW);
  },
  async "every tab opens"(page) {
    for (const [k, x] of TABS.entries()) {
      await page.mouse.click(x, 42);
      await page.waitForTimeout(700);
      await picture(page, `tab-${k}`);
    }
    await page.mouse.click(TABS[0], 42);
    assert.deepEqual(broken, []);
  },
  async "a drag of five seconds loses no frame"() {
    const other = await context.newPage();
    await other.addInitScript(() => {
      window.costs = [];
      const frame = window.requestAnimationFrame.bind(window);
      window.requestAnimationFrame = (call) => frame((time) => {
        const begun = performance.now();
        call(time);
        window.costs.push(performance.now() - begun);
      });
    });
    await other.goto(server.address);
    await said(other, "Verified");
    await other.evaluate(() => (window.costs.length = 0));
    await drag(other, { from: [130, 93], to: [185, 93] }, 300);
    const costs = (await other.evaluate(() => window.costs)).sort((a, b) => a - b);
    const [median, worst] = [costs[Math.floor(costs.length / 2)], costs.at(-1)];
    console.log(`  ${costs.length} frames: median ${median.toFixed(1)} ms, worst ${worst.toFixed(1)} ms`);
    await other.close();
    assert(median < 8 * SLOW && worst < 50 * SLOW);
  },
  async "two hundred random actions stay within 400 MB"() {
    const other = await opened();
    let seed = 7;
    const random = (most) => (seed = (seed * 48271) % 2147483647) % most;
    const places = [ROLLER, BALL, ...TABS.map((x) => [x, 42])];
    for (let k = 0; k < 200; k += 1) {
      if (random(3) === 0) {
        const y = [93, 121, 149][random(3)];
        await drag(other, { from: [100 + random(90), y], to: [100 + random(90), y] }, 3);
      } else await other.mouse.click(...places[random(places.length)]);
      await other.waitForTimeout(60);
    }
    const bytes = await other.evaluate(() => globalThis.ehl.memory());
    console.log(`  ${(bytes / 1e6).toFixed(0)} MB after 200 actions`);
    await other.close();
    assert(bytes < 400e6);
  },
  async "a worker that breaks costs one solve, and the next one works"() {
    const other = await opened(first);
    await other.mouse.click(...BALL);
    await said(other, "Verified|Roughly right", 240_000);
    const ball = await news(other);
    await Promise.all(other.workers().map((worker) => worker.evaluate(() => {
      globalThis.ehl.send = () => {
        throw new Error("a message that cannot be sent");
      };
    })));
    await other.mouse.click(...VERIFY);
    await other.waitForTimeout(2000);
    await picture(other, "broken worker");
    await other.mouse.click(...ROLLER);
    const roller = (ball) => {
      const { textContent } = document.getElementById("news");
      return textContent !== ball && /Verified/.test(textContent);
    };
    await other.waitForFunction(roller, ball, { timeout: 60_000 });
    await other.mouse.click(...VERIFY);
    await said(other, "Verified");
    broken.splice(0, broken.length, ...broken.filter((text) => !text.includes("a message that cannot be sent")));
    await other.close();
  },
  async "a full local storage is said, and nothing is lost"() {
    const other = await context.newPage();
    await other.addInitScript(() => {
      Storage.prototype.setItem = () => {
        throw new DOMException("full", "QuotaExceededError");
      };
    });
    await other.goto(server.address);
    await said(other, "Central film");
    const before = await fragment(other);
    await drag(other, M);
    await changed(other, before);
    await said(other, "QuotaExceededError");
    await picture(other, "quota");
    await other.close();
  },
  async "a tablet's fingers drag, tap and pinch"() {
    const browser = await chromium.launch({ executablePath: BROWSER, args: FLAGS });
    const tablet = await browser.newPage({ viewport: SIZE, hasTouch: true, deviceScaleFactor: 2, colorScheme: "light" });
    tablet.on("pageerror", (error) => broken.push(String(error)));
    await tablet.goto(server.address);
    await said(tablet, "Central film");
    const address = await fragment(tablet);
    const touch = await tablet.context().newCDPSession(tablet);
    const fingers = (type, ...points) =>
      touch.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    await fingers("touchStart", M.from);
    for (let x = M.from[0]; x <= M.to[0]; x += 3) {
      await fingers("touchMove", [x, M.from[1]]);
      await tablet.waitForTimeout(30);
    }
    await fingers("touchEnd");
    const dragged = await changed(tablet, address);
    await picture(tablet, "tablet");
    const before = await tablet.screenshot();
    await fingers("touchStart", [700, 300], [760, 300]);
    for (let k = 1; k <= 10; k += 1) {
      await fingers("touchMove", [700 - 8 * k, 300], [760 + 8 * k, 300]);
      await tablet.waitForTimeout(30);
    }
    await fingers("touchEnd");
    await tablet.waitForTimeout(500);
    const after = await picture(tablet, "pinched");
    assert(!before.equals(after), "a pinch changes nothing");
    assert.equal(await tablet.evaluate(() => window.visualViewport.scale), 1, "the page itself must not zoom");
    await tablet.touchscreen.tap(...BALL);
    await changed(tablet, dragged);
    await browser.close();
  },
  async "the back button returns to the contact before a link"() {
    const other = await opened();
    await said(other, "Central film");
    await drag(other, M);
    await other.waitForTimeout(1000);
    const [own, words] = [await fragment(other), await news(other)];
    await other.evaluate(() => (location.hash = "#embed=profiles&sliders=M,L"));
    await other.waitForTimeout(1000);
    await other.goBack();
    await other.waitForTimeout(1500);
    const film = (text) => text.match(/Central film [^,]*/)[0];
    assert.deepEqual([await fragment(other), film(await news(other))], [own, film(words)]);
    await other.close();
  },
  async "Escape cancels a solve and the next one works"(page) {
    await page.mouse.click(...VERIFY);
    await page.waitForTimeout(500);
    await page.keyboard.press("Escape");
    await page.mouse.click(...ROLLER);
    await said(page, "Verified", 60_000);
    await picture(page, "cancelled");
  },
  async "profiles are exported as a file"(page) {
    await page.keyboard.press("Control+p");
    await page.waitForTimeout(300);
    await page.keyboard.type("profiles as csv");
    await page.waitForTimeout(300);
    const [download] = await Promise.all([page.waitForEvent("download", { timeout: 20_000 }), page.keyboard.press("Enter")]);
    const text = readFileSync(await download.path(), "utf8");
    assert(download.suggestedFilename().endsWith(".csv") && text.split("\n").length > 100, text.slice(0, 200));
  },
  async "a reload restores the session"(page) {
    await page.waitForTimeout(3000);
    const words = await news(page);
    await page.evaluate(() => history.replaceState(null, "", location.pathname));
    await page.reload();
    await page.waitForFunction(() => performance.getEntriesByName("started").length > 0, null, { timeout: 60_000 });
    await said(page, "Central film");
    const film = (text) => text.match(/Central film [^,]*/)[0];
    assert.equal(film(await news(page)), film(words));
  },
  async "an embed shows one tab with chosen sliders"(page) {
    const other = await opened("#embed=profiles&sliders=M,L&lock=L");
    await said(other, "Central film");
    await picture(other, "embed");
    await other.close();
  },
  async "it opens without a network after the first visit"(page) {
    await page.evaluate(() => navigator.serviceWorker.ready);
    await context.setOffline(true);
    const other = await opened();
    await said(other, "Central film");
    await other.close();
    await context.setOffline(false);
  },
};

let failures = 0;
for (const [name, test] of Object.entries(tests)) {
  try {
    await test(page);
    console.log(`ok   ${name}`);
  } catch (why) {
    failures += 1;
    console.log(`FAIL ${name}\n     ${why.stack ?? why}`);
    if (page) await picture(page, "failed").catch(() => {});
  }
}
await context.close();
server.close();
rmSync(profile, { recursive: true, force: true });
for (const [what, list] of Object.entries({ "requests elsewhere": foreign, "errors in the page": broken })) {
  if (list.length > 0) console.log(`FAIL ${what}: ${[...new Set(list)].slice(0, 5).join("\n     ")}`);
  failures += list.length > 0 ? 1 : 0;
}
console.log(`${Object.keys(tests).length + 2 - failures} passed, ${failures} failed`);
process.exit(failures > 0 ? 1 : 0);
