// The picture's pure parts: ribbons, trails, labels, relief, baked light, resolution.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { bake } from '../page/picture/bake.js';
import { extentOf, ticks } from '../page/picture/curves.js';
import { firstCoat } from '../page/picture/first_coat.js';
import { placeLabels } from '../page/picture/names.js';
import { Relief, roundStep } from '../page/picture/relief.js';
import { Resolution, SCALES } from '../page/picture/picture.js';
import { Ribbons, STRIDE } from '../page/picture/trails.js';
import { POINTS, Trails } from '../page/picture/trails.js';
import { SUN } from '../page/picture/vectors.js';
import { groundOf, hill, pot } from './picture_ground.mjs';
import { sequence } from './sequence.mjs';

const SAME = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const vertex = (r, k) => [...r.data.subarray(k * STRIDE, (k + 1) * STRIDE)];

test('a ribbon is as wide as asked, in pixels, across its way', () => {
  const r = new Ribbons(100);
  r.begin(SAME, 200, 100);
  r.add(-.5, 0, 0, 3, 1, 0, 0, .5);
  r.add(.5, 0, 0, 3, 1, 0, 0, .5);
  assert.equal(r.count, 4);
  for (const k of [0, 2]) {
    const [a, b] = [vertex(r, k), vertex(r, k + 1)];
    assert.ok(Math.abs(Math.abs(a[1] - b[1]) * 50 - 6) < 1e-4 && Math.abs(a[0] - b[0]) < 1e-6);
    assert.deepEqual(a.slice(4), [.5, 0, 0, .5], 'colours are already times alpha');
  }
});

test('two ribbons in one strip are joined by triangles without area alone', () => {
  const r = new Ribbons(100);
  r.begin(SAME, 200, 100);
  for (const [y, from] of [[-.5, -.9], [.5, .2]]) {
    r.cut();
    for (let k = 0; k < 4; k++) r.add(from + k * .15, y, 0, 2, 1, 1, 1, 1);
  }
  let wide = 0;
  for (let k = 0; k + 2 < r.count; k++) {
    const [a, b, c] = [vertex(r, k), vertex(r, k + 1), vertex(r, k + 2)];
    const area = Math.abs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
    const ys = [a, b, c].map(v => v[1]);
    if (Math.max(...ys) - Math.min(...ys) > .5) assert.ok(area < 1e-9, `triangle ${k} spans both`);
    if (area > 1e-9) wide++;
  }
  assert.equal(wide, 12);
});

test('what lies behind the eye cuts a ribbon, and a full one takes no more', () => {
  const r = new Ribbons(8), m = [...SAME];
  m[15] = 0, m[11] = -1;  // w = -z
  r.begin(m, 100, 100);
  r.add(0, 0, -1, 1, 1, 1, 1, 1), r.add(0, 0, 1, 1, 1, 1, 1, 1), r.add(1, 0, -1, 1, 1, 1, 1, 1);
  assert.equal(r.count, 0);
  for (let k = 0; k < 50; k++) r.add(k, 0, -1, 1, 1, 1, 1, 1);
  assert.ok(r.count <= 8 && r.data.every(Number.isFinite));
});

test('trails keep their last points, break at leaps, and forget who has gone', () => {
  const trails = new Trails();
  let now = 0;
  for (let k = 0; k < 100; k++) if (trails.isDue(now += 60)) trails.add(1, k, 0, 0, 16), trails.sweep();
  const trail = trails.trails.get(1);
  assert.equal(trail.count, POINTS);
  assert.ok(trail.points.filter((_, i) => i % 4 === 3).every(cut => cut === 0));
  trails.isDue(now += 200), trails.add(1, 500, 0, 0, 16), trails.add(2, 0, 0, 0, 1), trails.sweep();
  assert.equal(trail.points[4 * ((trail.end + POINTS - 1) % POINTS) + 3], 1);
  trails.isDue(now += 200), trails.add(2, 0, 0, 0, 1), trails.sweep();
  assert.ok(!trails.trails.has(1) && trails.trails.has(2));
  const slow = new Trails();  // a page that draws once a second
  for (let k = 0; k < 10; k++) slow.isDue(1000 * k + 1), slow.add(1, 10 * k, 0, 0, 10), slow.sweep();
  assert.ok(slow.trails.get(1).points.filter((_, i) => i % 4 === 3).every(cut => cut === 0), 'gaps of points are bridged');
  trails.isDue(now - 5000);
  assert.equal(trails.trails.size, 0, 'a jump back in time begins anew');
});

test('labels lie inside, none over another, yours always', () => {
  const next = sequence(3), free = { left: 20, top: 40, right: 700, bottom: 500 };
  for (let round = 0; round < 50; round++) {
    const wanted = Array.from({ length: 120 }, (_, k) => ({ key: k, x: 20 + 680 * next(), y: 60 + 430 * next(), reach: 8, width: 30 + 60 * next(), height: 16, rank: next() }));
    wanted[17].rank = Infinity;
    const widths = new Map(wanted.map(w => [w.key, w.width])), placed = [...placeLabels(wanted, free, 40)];
    assert.ok(placed.length > 10 && placed.length <= 40 && placed[0][0] === 17);
    placed.forEach(([key, a], i) => {
      const w = widths.get(key);
      assert.ok(a.x >= free.left && a.x + w <= free.right && a.y >= free.top && a.y + 16 <= free.bottom);
      for (const [other, b] of placed.slice(0, i))
        assert.ok(a.x >= b.x + widths.get(other) || b.x >= a.x + w || a.y >= b.y + 16 || b.y >= a.y + 16);
    });
  }
});

test('a relief tells pots from hills, and a level map has no contours, whatever its rounding', () => {
  const domain = [-20, -20, 20, 20];
  assert.ok(new Relief(groundOf(domain, 61, 61, pot)).potness > .2);
  assert.ok(new Relief(groundOf(domain, 61, 61, hill)).potness < -.1);
  const level = new Relief(groundOf(domain, 21, 21, (x, y) => 12 + 1e-12 * Math.sin(x * y)));
  assert.ok(level.isFlat && level.interval === 0 && level.exaggeration === 1 && Number.isFinite(level.tone(12)));
  const low = new Relief(groundOf(domain, 61, 61, (x, y) => hill(x, y) / 5));
  assert.ok(low.exaggeration > 1.5 && low.exaggeration <= 2);
  assert.throws(() => new Relief({ domain, columns: 9, rows: 9, grid: new Float32Array(9) }));
});

test('tones ascend with height from 0 to 1; contours are round and not too many', () => {
  const relief = new Relief(groundOf([-43, -30, 43, 30], 87, 61, hill));
  let last = -1;
  for (let k = 0; k <= 100; k++) {
    const tone = relief.tone(relief.lowest + (relief.highest - relief.lowest) * k / 100);
    assert.ok(tone >= last && tone >= 0 && tone <= 1);
    last = tone;
  }
  const lines = (relief.highest - relief.lowest) / relief.interval;
  assert.ok(lines > 5 && lines <= 16);
  for (const v of [.0013, .7, 1, 3, 99]) {
    const step = roundStep(v), digit = step / 10 ** Math.floor(Math.log10(step) + 1e-9);
    assert.ok(step >= v * (1 - 1e-9) && step < 2.5 * v * (1 + 1e-9) && [1, 2, 5].some(d => Math.abs(digit - d) < 1e-6), `${v}: ${step}`);
  }
});

test('heights between the grid\'s points are between theirs', () => {
  const relief = new Relief(groundOf([-20, -20, 20, 20], 81, 81, pot)), next = sequence(5);
  for (let k = 0; k < 1000; k++) {
    const x = 40 * next() - 20, y = 40 * next() - 20;
    assert.ok(Math.abs(relief.heightAt(x, y) - pot(x, y)) < .005);
  }
  assert.equal(relief.heightAt(1e9, 0), relief.heightAt(20, 0));
});

test('level ground is fully lit; behind a wall towards the sun lies its shadow, as long as the sun is low', () => {
  assert.ok(Math.abs(Math.hypot(...SUN) - 1) < 1e-3);
  const level = bake(groundOf([-20, -20, 20, 20], 41, 41, () => 3), 1);
  assert.ok(level.every(v => v === 255));
  // a ridge along the sun's own normal
  const high = 4, flat = Math.hypot(SUN[0], SUN[1]), along = (x, y) => (x * SUN[0] + y * SUN[1]) / flat;
  const ground = groundOf([-20, -20, 20, 20], 161, 161, (x, y) => high * Math.exp(-(along(x, y) ** 2) * 4)), light = bake(ground, 1);
  const at = (x, y) => light[2 * (Math.round((y + 20) * 4) * 161 + Math.round((x + 20) * 4))];
  const reach = high * flat / SUN[2], behind = s => at(-SUN[0] / flat * s, -SUN[1] / flat * s);
  assert.ok(behind(reach * .5) < 60, `${behind(reach * .5)}`);
  assert.ok(behind(reach * 1.8) > 200, `${behind(reach * 1.8)}`);
  assert.ok(at(SUN[0] / flat * 3, SUN[1] / flat * 3) > 200, 'before the wall there is sun');
  assert.ok(light[2 * (80 * 161 + 80) + 1] > light[2 * (80 * 161 + 84) + 1], 'a ridge sees more sky than its foot');
});

test('shadows go on over edges that wrap', () => {
  const f = (x, y) => 3 * Math.exp(-((x + 19) ** 2) / 2) + 3 * Math.exp(-((x - 21) ** 2) / 2) + 0 * y;
  const walls = bake(groundOf([-20, -20, 20, 20], 81, 81, f), 1), wraps = bake(groundOf([-20, -20, 20, 20], 81, 81, f, { wraps: [true, true] }), 1);
  let differ = 0;
  for (let k = 0; k < walls.length; k += 2) if (wraps[k] !== walls[k]) differ++;
  assert.ok(differ > 0);
});

test('resolution falls while frames are slow, never below 0.6, and comes back when there is room', () => {
  const resolution = new Resolution();
  let now = 0;
  const run = (ms, frames) => { for (let k = 0; k < frames; k++) resolution.frame(now += ms, ms); };
  run(16, 100);
  assert.equal(resolution.scale, 1);
  run(5000, 10);
  assert.equal(resolution.scale, 1, 'a page that was away is no slow one');
  run(90, 100);
  assert.equal(resolution.scale, Math.min(...SCALES));
  assert.ok(Math.min(...SCALES) >= .6);
  run(16, 4000);
  assert.equal(resolution.scale, 1);
  // a machine that keeps up at the coarser scale alone does not flicker between them
  const border = new Resolution();
  let changes = 0, last = border.scale;
  for (let k = 0, t = 0; k < 5000; k++) {
    const ms = border.scale === 1 ? 80 : 30;
    border.frame(t += ms, ms);
    if (border.scale !== last) changes++, last = border.scale;
  }
  assert.ok(changes <= 12, `${changes} changes in 150 s`);
});

test('an axis has round numbers, few of them, all on it; curves of nothing have a size', () => {
  const next = sequence(9);
  for (let k = 0; k < 500; k++) {
    const a = (next() - .5) * 10 ** (8 * next() - 4), b = a + 10 ** (8 * next() - 4) + Math.abs(a) * 1e-6, found = ticks(a, b, 6);
    assert.ok(found.length >= 1 && found.length <= 7, `${a} ${b}: ${found}`);
    assert.ok(found.every(t => t >= a - (b - a) * 1e-6 && t <= b + (b - a) * 1e-6));
  }
  for (const series of [[], [{ name: 'a', x: [], y: [] }], [{ name: 'a', x: [0, 1], y: [5, 5] }], [{ name: 'a', x: [0, 1], y: [NaN, Infinity] }]]) {
    const { x0, x1, y0, y1 } = extentOf(series);
    assert.ok(x1 > x0 && y1 > y0 && [x0, x1, y0, y1].every(Number.isFinite));
  }
});

test('the first coat is brighter towards the sun, by height or by slope, and never burnt out', () => {
  const ramps = new Uint8Array(2048).fill(128, 0, 1024).fill(64, 1024);
  const coat = (f, slope = false, sun = 1) => firstCoat(new Relief(groundOf([-20, -20, 20, 20], 41, 41, f)), ramps, slope, sun);
  const at = (painted, i, j) => painted.subarray(4 * (41 * j + i), 4 * (41 * j + i) + 4);
  const towards = coat((x, y) => -.5 * (x * SUN[0] + y * SUN[1])), away = coat((x, y) => .5 * (x * SUN[0] + y * SUN[1]));
  assert.ok(at(towards, 20, 20)[0] > at(away, 20, 20)[0] + 30);
  assert.equal(at(towards, 20, 20)[3], 255);
  assert.ok(at(coat(hill, true), 20, 20)[0] < at(coat(hill), 20, 20)[0], 'the slope has colours of its own');
  const glaring = coat(hill, false, 20);
  for (let k = 0; k < glaring.length; k += 4) assert.ok(glaring[k] > 200 && glaring[k] <= 255);
});
