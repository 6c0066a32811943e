// What a scene becomes: every number finite, whoever is meant is told, whatever lies outside is pointed at.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Camera } from '../page/picture/camera.js';
import { drawMarks } from '../page/picture/marks.js';
import { buildScenery } from '../page/picture/scenery.js';
import { Batch } from '../page/picture/batch.js';
import { Relief } from '../page/picture/relief.js';
import { Staging } from '../page/picture/staging.js';
import { groundOf, hill, pot } from './picture_ground.mjs';
import { sequence } from './sequence.mjs';

const louse = (id, x, y, more = {}) => ({ id, colour: id, phase: 0, x, y, vx: 1, vy: 0, heading_x: 1, heading_y: 0, flight_z: 0, flight_vz: 0, distance: 5, z: 0, zx: 0, zy: 0, name: `louse ${id}`, ...more });
const MARKS = {
  gates: [{ a: [-5, 2], b: [-5, -2], number: 1, state: 'passed' }, { a: [5, 2], b: [5, -2], number: 2, state: 'next' }, { a: [18, 18], b: [19.4, 19], number: 3, state: 'later', air: true }],
  crumbs: [{ x: 0, y: 4, value: 1 }, { x: -19, y: 19, value: 3 }],
  ghosts: [{ ...louse(0, 3, 3), name: undefined, colour: undefined, kind: 'record' }],
  arrow: { x: 20, y: 20 },
};

function staged(scene, { f = hill, more = {}, view = 'orbit', now = 1000, width = 1280, height = 800, palette = 'default', calm = true } = {}) {
  const relief = new Relief(groundOf([-20, -20, 20, 20], 41, 41, f, more)), camera = new Camera(calm), staging = new Staging();
  staging.drawMarks = drawMarks;
  camera.setStage(relief.stage(relief.lowest - 3));
  camera.view = view;
  staging.setRelief(relief);
  const look = { camera, palette, theme: 'dark', calm };
  for (let k = 0; k < 20; k++) {
    camera.update(width, height, now + 130 * k, staging.find(scene, scene.follow || camera.follow));
    staging.stage(scene, look, now + 130 * k, width, height);
  }
  return { staging, camera, relief };
}
function check(staging) {
  for (const what of ['solid', 'decals', 'air', 'through', 'ribbons']) {
    const { data, count } = staging[what];
    for (let k = 0; k < 8 * count; k++) if (!Number.isFinite(data[k])) assert.fail(`${what}: number ${k % 8} of vertex ${k >> 3} is ${data[k]}`);
    for (let k = 0; k < count; k++) assert.ok(data[8 * k + 7] >= 0 && data[8 * k + 7] <= 1.0001, `${what}: alpha ${data[8 * k + 7]}`);
  }
  for (let k = 0; k < 16 * staging.instances; k++) assert.ok(Number.isFinite(staging.data[k]));
}

test('all that is drawn is finite, on every ground, in every view, in every mode', () => {
  const next = sequence(2), lice = [louse(1, 0, 0, { heading_x: 0, heading_y: 0, vx: 0 }), louse(2, -20, 20), louse(3, 20, -20, { phase: 2, flight_z: 30, flight_vz: -50 }),
    louse(4, 1e-9, 0, { phase: 2, flight_z: -400, vx: 0 })];
  for (let k = 5; k < 90; k++) lice.push(louse(k, 40 * next() - 20, 40 * next() - 20, { zx: 8 * next() - 4, zy: 8 * next() - 4, distance: 1e6 * next() }));
  for (const f of [hill, pot, () => 0])
    for (const more of [{}, { wraps: [true, true], edges: 'wrap' }, { centre: { x: 0, y: 0 } }, { centre: [1, 2], edges: 'open' }])
      for (const view of ['orbit', 'follow', 'map'])
        for (const state of ['free', 'yours', 'held', 'contested']) {
          const ring = { x: 1, y: 1, radius: 3, state, colour: 4, next: state === 'free' ? null : { x: 8, y: 8, radius: 2 } };
          const { staging, relief } = staged({ lice, you: 2, follow: 3, marks: { ...MARKS, ring } }, { f, more, view });
          check(staging);
          assert.equal(staging.instances, lice.length + 1);
          const scenery = { floor: new Batch(), border: new Batch(), walls: new Batch() };
          buildScenery(scenery, relief, -5, 'light');
          for (const batch of Object.values(scenery)) for (let k = 0; k < 8 * batch.count; k++) assert.ok(Number.isFinite(batch.data[k]));
          assert.equal(scenery.border.count > 0, 'centre' in more || scenery.walls.count > 0);
        }
});

test('you are told by a badge with your colour, before all others; ghosts are outlines and can not be picked', () => {
  const { staging } = staged({ lice: [louse(1, 0, 0), louse(2, 3, 0), louse(3, 6, 0, { isGhost: true })], you: 2, marks: MARKS });
  const you = staging.names.find(n => n.text === 'you');
  assert.ok(you && you.badge && you.rank === Infinity && you.colour === 0xff3870);
  assert.deepEqual([0, 1, 2, 3].map(k => staging.data[16 * k + 11]), [0, 0, 1, 1]);
  const record = staging.names.find(n => n.text === 'record');
  assert.ok(record && record.colour > 0, 'a ghost without a colour has that of its kind');
  assert.deepEqual(staging.shown.filter(s => s.id !== 0).map(s => s.id).sort(), [1, 2, 3]);
});

test('seven colours and four coats make 28 lice different', () => {
  const { staging } = staged({ lice: Array.from({ length: 29 }, (_, k) => louse(k + 1, k - 14, 0, { colour: k })) });
  const looks = new Set();
  for (let k = 0; k < 29; k++) looks.add(staging.data.slice(16 * k + 12, 16 * k + 16).join());
  assert.equal(looks.size, 28);
});

test('a goal or yourself outside the picture is pointed at from its edge, on the right side', () => {
  for (const [yaw, x, y] of [[0, 20, 20], [0, 20, -20], [2, -20, 0], [-2.2, 0, 20]]) {
    const scene = { lice: [louse(1, 0, 0)], follow: 1, marks: { arrow: { x, y } } }, { staging, camera } = staged(scene, { f: () => 0, view: 'follow', width: 500, height: 400 });
    camera.yaw = yaw, camera.zoom(3);
    camera.update(500, 400, 9e3, staging.find(scene, 1));
    staging.stage(scene, { camera, palette: 'default', theme: 'dark', calm: true }, 9e3, 500, 400);
    const [arrow] = staging.arrows;
    assert.ok(arrow.x >= 0 && arrow.x <= 500 && arrow.y >= 0 && arrow.y <= 400);
    // over the map the goal is to the right of "up" by its bearing
    const bearing = camera.azimuth - Math.atan2(y, x), side = Math.sin(bearing), ahead = Math.cos(bearing);
    if (Math.abs(side) > .4) assert.equal(Math.sign(Math.cos(arrow.angle)), Math.sign(side), `${yaw} ${x} ${y}`);
    if (Math.abs(ahead) > .6) assert.equal(Math.sign(-Math.sin(arrow.angle)), Math.sign(ahead), `${yaw} ${x} ${y}`);
  }
});

test('who is followed and has gone for a while stays where the camera was', () => {
  const scene = { lice: [louse(1, 5, 5)], follow: 1 }, { staging } = staged(scene);
  assert.equal(staging.find({ lice: [] }, 1).x, 5);
  assert.equal(staging.find({ lice: [] }, 2), null);
});

test('what flies is drawn at its height, with its shadow on the ground', () => {
  const { staging, relief } = staged({ lice: [louse(1, 0, 0, { phase: 2, flight_z: 20 })], you: 0 }, { f: () => 2 });
  assert.ok(staging.data[2] > 19 * relief.exaggeration);
  let lowest = Infinity;
  for (let k = 0; k < staging.decals.count; k++) lowest = Math.min(lowest, staging.decals.data[8 * k + 2]);
  assert.ok(lowest < 2.5);
  assert.ok(staging.ribbons.count >= 4, 'a stalk between them');
});

test('over an edge that wraps all goes on: the camera, others, trails, gates', () => {
  const relief = new Relief(groundOf([-20, -20, 20, 20], 41, 41, (x, y) => Math.cos(Math.PI * x / 20) + Math.cos(Math.PI * y / 20), { wraps: [true, true] }));
  const camera = new Camera(false), staging = Object.assign(new Staging(), { drawMarks }), look = { camera, palette: 'default', theme: 'dark', calm: false };
  camera.setStage(relief.stage(-5));
  camera.view = 'follow';
  staging.setRelief(relief);
  let last = null, lastCount = 0;
  for (let k = 0; k < 400; k++) {
    let x = -18 + k * .1;  // once round, past the seam
    if (x >= 20) x -= 40;
    const scene = { lice: [louse(1, x, 3), louse(2, x + 3 >= 20 ? x - 37 : x + 3, 3)], follow: 1, marks: { gates: [{ a: [-19, 2], b: [-19, -2], number: 1, state: 'next' }, { a: [0, 2], b: [0, -2], number: 2, state: 'later' }] } };
    camera.update(800, 600, 33 * k, staging.find(scene, 1));
    staging.stage(scene, look, 33 * k, 800, 600);
    check(staging);
    assert.ok(Math.abs(staging.data[16] - staging.data[0] - 3) < 1e-5, `the other is 3 m ahead, at ${k}: ${staging.data[16] - staging.data[0]}`);
    const [me] = staging.shown;
    if (last && k > 60) assert.ok(Math.hypot(me.x - last.x, me.y - last.y) < 4, `frame ${k}: ${me.x - last.x} ${me.y - last.y}`);
    if (k > 200) assert.ok(staging.ribbons.count > 20 && Math.abs(staging.ribbons.count - lastCount) < 30, 'trails are not cut');
    last = me, lastCount = staging.ribbons.count;
  }
});

test('trails of a held recording stay, and go on with it', () => {
  const relief = new Relief(groundOf([-20, -20, 20, 20], 41, 41, hill)), camera = new Camera(true), staging = new Staging();
  camera.setStage(relief.stage(-3));
  staging.setRelief(relief);
  let now = 0, x = -10;
  const show = (frames, speed) => {
    for (let k = 0; k < frames; k++) {
      now += 50, x += speed;
      camera.update(800, 600, now, null);
      staging.stage({ lice: [louse(1, x, 0), louse(2, 5, 5)] }, { camera, palette: 'default', theme: 'dark', calm: true }, now, 800, 600);
    }
    return staging.ribbons.count;
  };
  const moving = show(60, .15), held = show(200, 0);
  assert.ok(moving > 20 && Math.abs(held - moving) <= 2, `${moving} ${held}`);
  show(5, .15);
  assert.ok(staging.trails.trails.get(1).count > 10);
});

test('lice at no place that can be drawn are left out, and the camera stays with what can', () => {
  const wild = [[NaN, 0], [Infinity, 0], [0, -Infinity], [1e300, 1e300], [undefined, 0]].map(([x, y], k) => louse(10 + k, x, y));
  const { staging, camera } = staged({ lice: [louse(1, 5, 5), ...wild, louse(20, 0, 0, { phase: 2, flight_z: NaN })], follow: 10 }, { view: 'follow' });
  check(staging);
  assert.equal(staging.instances, 1);
  assert.ok(camera.matrix.every(Number.isFinite));
});
