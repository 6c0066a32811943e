#!/usr/bin/env node
// What the page costs a browser, beside its budgets: bytes, the first picture, frames and script of 200 lice, acks over a line of
// 150 ms, a recording verified, memory after 500 seeks.
//
//   bench/page_cost.mjs BIN [--idle SECONDS] [bytes | first | frames | acks | recordings | hour | stay ...]
//
// BIN is a tree's folder of programs, built with its page. Chromium draws by software (SwiftShader). --idle: how long 100 lice are watched
// for the memory of a long stay (600; 3600 is the hour of the budget), in a small window. Parts by name: those alone. Needs chromium, and `npm install` in web/tests/browser.
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import http from 'node:http';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const programs = path.resolve(process.argv[2] ?? 'build/release/bin');
process.env.WOODLOUSE_BIN = programs;
const at = process.argv.indexOf('--idle');
const IDLE_S = at > 0 ? Number(process.argv[at + 1]) : 600;
const PARTS = ['bytes', 'first', 'frames', 'acks', 'recordings', 'hour', 'stay'], named = PARTS.filter((part) => process.argv.includes(part)), wanted = named.length ? named : PARTS;
const FIRST_PICTURES = 7, STARTING = 2500, FRAMES_S = 10, PLAY_S = 20, VERIFIED = 7, SEEKS = 500;
const { browsed, Served, shown, SlowLine, until } = await import('../web/tests/browser/served.mjs');

const median = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];
const spread = (values, digits = 0) => `${median(values).toFixed(digits)} (${Math.min(...values).toFixed(digits)} to ${Math.max(...values).toFixed(digits)})`;
const say = (what, is, goal) => console.log(`${what.padEnd(72)} ${is}${goal ? `   goal ${goal}` : ''}`);
const CROWD = ['--map', 'volcano', '--bots', '200', '--bots-alone', 'play', '--seed', '5'];

/** Within a page, before it begins: notes when the first frame with lice in it is computed to its last pixel. */
function noteFirstPicture() {
  const look = () => {
    const { picture } = window.woodlouse ?? {};
    if (!picture?.peopled) return void requestAnimationFrame(look);
    picture.drawing.gl.readPixels(0, 0, 1, 1, WebGL2RenderingContext.RGBA, WebGL2RenderingContext.UNSIGNED_BYTE, new Uint8Array(4));
    window.firstPicture = performance.now();
  };
  requestAnimationFrame(look);
}

/** Milliseconds from the navigation until the first frame with lice in it is computed to its last pixel, in a browser that runs but
 * has nothing of the page: a new profile, and STARTING ms after its start. */
async function firstPicture(address) {
  const context = await browsed(), page = context.pages()[0];
  await page.addInitScript(noteFirstPicture);
  await page.waitForTimeout(STARTING);
  await page.goto(address);
  await until(page, () => window.firstPicture > 0, 60000);
  const took = await page.evaluate(() => window.firstPicture);
  await context.close();
  return took;
}

/** The least that a page with WebGL can be: one triangle over all of the window, by a context as the page's. What its first picture
 * takes is the browser's own. */
const ONE_TRIANGLE = `<!doctype html><style>html, body, canvas { margin: 0; width: 100%; height: 100%; display: block }</style><canvas></canvas><script>
const canvas = document.querySelector('canvas'), gl = canvas.getContext('webgl2', { alpha: false, antialias: false, powerPreference: 'low-power' });
canvas.width = innerWidth, canvas.height = innerHeight, gl.viewport(0, 0, canvas.width, canvas.height);
const program = gl.createProgram();
for (const [kind, text] of [[gl.VERTEX_SHADER, 'void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0, 1); }'],
  [gl.FRAGMENT_SHADER, 'precision mediump float; out vec4 colour; void main() { colour = vec4(0.2, 0.5, 0.3, 1); }']]) {
  const shader = gl.createShader(kind);
  gl.shaderSource(shader, '#version 300 es\\n' + text), gl.compileShader(shader), gl.attachShader(program, shader);
}
gl.linkProgram(program), gl.useProgram(program);
requestAnimationFrame(() => { gl.drawArrays(gl.TRIANGLES, 0, 3); window.woodlouse = { picture: { peopled: true, drawing: { gl } } }; });
</script>`;

async function serveOneTriangle() {
  const server = http.createServer((_, answer) => answer.writeHead(200, { 'Content-Type': 'text/html' }).end(ONE_TRIANGLE));
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { address: `http://127.0.0.1:${server.address().port}/`, end: () => server.close() };
}

/** Two programs that do nothing but take a core each. */
function load() {
  const busy = Array.from({ length: os.cpus().length }, () => spawn(process.execPath, ['-e', 'for (;;);'], { stdio: 'ignore' }));
  return () => busy.forEach((one) => one.kill('SIGKILL'));
}

async function bytes(served) {
  const index = await (await fetch(served.web)).text();
  const asked = new Set(['', ...[...index.matchAll(/(?:href|src)="([^"]+)"/g)].map(([, name]) => name)]);
  const context = await browsed(), page = context.pages()[0];
  await page.addInitScript(noteFirstPicture);
  await shown(page, served.web);
  await until(page, () => window.firstPicture > 0, 60000);
  const document = await page.evaluate(() => performance.getEntriesByType('navigation')[0].encodedBodySize);
  const first = await page.evaluate(() => performance.getEntriesByType('resource').filter(({ startTime }) => startTime < window.firstPicture).map(({ name, encodedBodySize }) => [name, encodedBodySize]));
  await context.close();
  const core = first.filter(([name]) => name.endsWith('.wasm')), rest = first.filter(([name]) => /\.(js|css|svg)$/.test(name));
  const sum = (files) => files.reduce((total, [, size]) => total + size, 0);
  say('the page without its core, as sent for the first picture [KB]', `${((sum(rest) + document) / 1e3).toFixed(1)} in ${rest.length + 1} files (of ${asked.size} named by the first)`, '35');
  say('core.wasm, as sent [KB]', (sum(core) / 1e3).toFixed(1), '320');
}

async function frames(served) {
  const context = await browsed(), page = context.pages()[0];
  await shown(page, served.web);
  await page.waitForTimeout(8000);  // until the resolution has settled, and light and shadow are baked
  const measured = await page.evaluate((seconds) => new Promise((resolve) => {
    const { woodlouse } = window, own = woodlouse.frame.bind(woodlouse), scripts = [], begun = performance.now();
    woodlouse.frame = (now) => {
      const from = performance.now();
      own(now);
      scripts.push(performance.now() - from);
      if (from - begun > seconds * 1000) resolve({ scripts, fps: scripts.length / (from - begun) * 1000, scale: woodlouse.picture.resolution.scale, lice: woodlouse.source.lice.length });
    };
  }), FRAMES_S);
  await context.close();
  say(`${measured.lice} lice, 1280x800, software GL: frames a second`, `${measured.fps.toFixed(1)} at ${measured.scale} of the resolution`, '20, not below 0.6');
  say('  own script a frame, median [ms]', median(measured.scripts).toFixed(2), '3');
}

async function acks() {
  const served = await Served.start('--map', 'hills', '--bots', '4', '--bots-alone', 'play', '--seed', '5');
  const line = await SlowLine.to(Number(served.port), 75, 40), context = await browsed(), page = context.pages()[0];
  for (const [what, address] of [['localhost', served.web], ['150 ms and 40 ms of jitter', line.web]]) {
    await shown(page, `${address}?play`);
    await until(page, () => window.woodlouse.room.own?.pilot?.louse);
    const keys = ['w', 'a', 'd', ' ', 's'];
    for (const begun = Date.now(), k = { k: 0 }; Date.now() - begun < PLAY_S * 1000; k.k++) {
      await page.keyboard.down(keys[k.k % keys.length]);
      await page.waitForTimeout(150 + (k.k * 137) % 500);
      await page.keyboard.up(keys[k.k % keys.length]);
    }
    const { exact, corrected } = await page.evaluate(() => ({ exact: window.woodlouse.room.own.pilot.prediction.exact, corrected: window.woodlouse.room.own.pilot.prediction.corrected }));
    say(`acks whose state the page already had, ${what}`, `${exact} of ${exact + corrected}`, 'all');
  }
  await context.close();
  line.stop();
  await served.stop();
}

/** A recording of `ticks` steps of `lice` house bots, which stay awake. */
async function recorded(lice, ticks, folder) {
  const file = path.join(folder, `${lice}.ndjson.zst`);
  const server = spawn(path.join(programs, 'woodlouse-server'), ['--map', 'volcano', '--bots', String(lice), '--bots-alone', 'play', '--seed', '5', '--ticks', String(ticks), '--record', file, '--listen', '127.0.0.1:0'], { stdio: 'ignore' });
  await new Promise((resolve) => server.once('exit', resolve));
  return file;
}

/** Milliseconds until the recording that is open stands at a tick. */
const sought = (page, to) => page.evaluate(async (tick) => {
  const { player } = window.woodlouse, told = player.onSeek, begun = performance.now();
  await new Promise((resolve) => {
    player.onSeek = () => { told(); resolve(undefined); };
    player.seek(tick);
  });
  player.onSeek = told;
  return performance.now() - begun;
}, to);

async function recordings(served) {
  const folder = mkdtempSync(path.join(os.tmpdir(), 'woodlouse-'));
  const file = await recorded(200, 1800, folder);
  const context = await browsed(), page = context.pages()[0];
  await shown(page, served.web);
  const held = readFileSync(file).toString('base64');
  await page.evaluate((text) => { const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0)); window.woodlouse.open(new Blob([bytes]), 'crowd.ndjson.zst'); }, held);
  await until(page, () => window.woodlouse.player?.ground);
  const verified = async (isPlaying) => {
    const times = [];
    for (let k = 0; k < VERIFIED; k++) {
      const [took, ok] = await page.evaluate(async (plays) => {
        const { player } = window.woodlouse, begun = performance.now();
        player.isPlaying = plays;
        await player.verify();
        return [performance.now() - begun, player.verdict.ok];
      }, isPlaying);
      if (ok !== 1) throw new Error('a good recording was not verified');
      times.push(took);
    }
    return spread(times);
  };
  say('a recording of 200 lice and 1800 ticks verified while it plays, drawn by software [ms]', await verified(true));
  await page.evaluate(async () => {
    const { picture, player } = window.woodlouse;
    player.isPlaying = false;
    for (let drawn = -1; drawn !== picture.peopled; await new Promise((resolve) => setTimeout(resolve, 500))) drawn = picture.peopled;
  });
  say('  the same, while it is held: a picture that stands is not drawn again [ms]', await verified(false), '165');
  const session = await context.newCDPSession(page);
  const heap = async () => { await session.send('HeapProfiler.collectGarbage'); return (await session.send('Runtime.getHeapUsage')).usedSize / 1e6; };
  const before = await heap(), seeks = [];
  for (let k = 0; k < SEEKS; k++) seeks.push(await sought(page, (k * 977) % 1800));
  await page.waitForTimeout(1000);
  say(`JS heap before and after ${SEEKS} seeks [MB]`, `${before.toFixed(1)}, ${(await heap()).toFixed(1)}`, 'flat, 45');
  await context.close();
  rmSync(folder, { recursive: true, force: true });
}

/** An hour of 100 lice: opened, looked at in ten places, verified. */
async function hour(served) {
  const folder = mkdtempSync(path.join(os.tmpdir(), 'woodlouse-'));
  const player = spawn(path.join(programs, 'woodlouse-replay-speed'), [path.join(path.dirname(fileURLToPath(import.meta.url)), '../maps/volcano.json'), folder, '--keep'], { stdio: 'ignore' });
  await new Promise((resolve) => player.once('exit', resolve));
  const kept = readFileSync(path.join(folder, 'speed.ndjson.zst'));
  const context = await browsed(), page = context.pages()[0], session = await context.newCDPSession(page);
  await page.route('**/hour.ndjson.zst', (route) => route.fulfill({ body: kept }));
  await shown(page, served.web);
  const opened = await page.evaluate(async () => {
    const blob = await (await fetch('/hour.ndjson.zst')).blob(), begun = performance.now();
    await window.woodlouse.open(blob, 'hour.ndjson.zst');
    window.woodlouse.player.isPlaying = false;
    return performance.now() - begun;
  });
  const times = [];
  for (let k = 0; k < 10; k++) times.push(await sought(page, (k * 0.618034 % 1) * 216000 | 0));
  const [took, ok] = await page.evaluate(async () => {
    const begun = performance.now();
    await window.woodlouse.player.verify();
    return [performance.now() - begun, window.woodlouse.player.verdict.ok];
  });
  if (ok !== 1) throw new Error('a good recording was not verified');
  await session.send('HeapProfiler.collectGarbage');
  const heap = (await session.send('Runtime.getHeapUsage')).usedSize / 1e6;
  say(`an hour of 100 lice (${(kept.length / 1e6).toFixed(1)} MB packed) opened [ms]`, opened.toFixed(0));
  say('  ten places in it [ms]', spread(times));
  say('  all of it verified [s], and the JS heap then [MB]', `${(took / 1e3).toFixed(1)}, ${heap.toFixed(1)}`, 'heap 45');
  await context.close();
  rmSync(folder, { recursive: true, force: true });
}

async function longStay() {
  const served = await Served.start('--map', 'volcano', '--bots', '100', '--bots-alone', 'play', '--seed', '5');
  const context = await browsed({ viewport: { width: 400, height: 260 } }), page = context.pages()[0];
  await shown(page, served.web);
  const session = await context.newCDPSession(page), heaps = [];
  for (let k = 0; k <= 6; k++) {
    await page.waitForTimeout(k === 0 ? 10000 : IDLE_S * 1000 / 6);
    await session.send('HeapProfiler.collectGarbage');
    heaps.push((await session.send('Runtime.getHeapUsage')).usedSize / 1e6);
  }
  say(`JS heap while 100 lice are watched for ${IDLE_S} s, after a collection [MB]`, heaps.map((heap) => heap.toFixed(1)).join(' '), 'flat, 45');
  await context.close();
  await served.stop();
}

const served = await Served.start(...CROWD);
if (wanted.includes('bytes')) await bytes(served);
const triangle = await serveOneTriangle();
for (const isLoaded of wanted.includes('first') ? [false, true] : []) {
  const rest = isLoaded ? load() : () => {}, took = [], least = [];
  for (let k = 0; k < FIRST_PICTURES; k++) least.push(await firstPicture(triangle.address)), took.push(await firstPicture(served.web));
  rest();
  const when = isLoaded ? 'both cores taken' : 'idle';
  say(`first picture, 200 lice, nothing kept from before, ${when} [ms]`, spread(took), isLoaded ? '1000' : '500');
  say(`  of a page of one triangle, by turns, ${when} [ms]; above it`, `${spread(least)}; ${spread(took.map((one, k) => one - least[k]))}`);
}
triangle.end();
if (wanted.includes('frames')) await frames(served);
if (wanted.includes('acks')) await acks();
if (wanted.includes('recordings')) await recordings(served);
if (wanted.includes('hour')) await hour(served);
await served.stop();
if (wanted.includes('stay')) await longStay();
