// A picture that stands is not drawn again, and one in which anything changes is.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Stillness } from '../page/picture/fine_drawing.js';
import { Resolution } from '../page/picture/picture.js';
import { Trails } from '../page/picture/trails.js';

const louse = (id, more = {}) => ({ id, phase: 0, x: id, y: 2, z: 3, zx: .1, zy: .2, vx: 1, vy: 0, heading_x: 1, heading_y: 0, flight_z: 0, flight_vz: 0, distance: 5, name: `louse ${id}`, colour: id, outline: false, ...more });
const NONE = { gates: [], crumbs: [], ring: null, ghosts: [], arrow: null };
const scene = (more = {}, ofFirst = {}) => ({ lice: [louse(1, ofFirst), louse(2)], you: 0, follow: 0, marks: NONE, ...more });

const picture = (more = {}) => ({ camera: { width: 1280, height: 800, view: 'orbit', insets: { left: 1, top: 2, right: 3, bottom: 4 }, matrix: [1, 0, 0, 1] }, resolution: new Resolution(),
  drawing: { isFine: true, isPainted: true, version: 3, isSoftware: true, fine: { kept: 2 } }, palette: 'default', theme: 'dark', relief: 'hills', isBaked: true, staging: { trails: new Trails() }, last: 0, ...more });

/** A picture that stands after 2.5 s of that scene. */
function stood(one, shown = picture()) {
  const stillness = new Stillness();
  let stands = false;
  for (let now = 0; now < 2500; now += 100) stands = stillness.stands(one, shown, now);
  return { stillness, shown, stands };
}

/** Whether it stands still with `last`, and so. */
function standsWith(last, more = {}) {
  const { stillness, shown, stands } = stood(scene());
  assert.equal(stands, true);
  Object.assign(shown, more);
  return stillness.stands(last, shown, 2500);
}

test('it stands once the same was asked for a second long and was drawn some times, and not before', () => {
  const shown = picture(), stillness = new Stillness(), found = [];
  for (let now = 0; now <= 1600; now += 100) found.push(stillness.stands(scene(), shown, now));
  assert.equal(found.indexOf(true), 15);
  assert.ok(found.slice(15).every((stands) => stands));
  const slow = new Stillness(), rarely = [];
  for (let now = 0; now <= 7000; now += 1000) rarely.push(slow.stands(scene(), shown, now));
  assert.equal(rarely.indexOf(true), 6, 'one second is one picture where a frame takes as long');
});

test('anything of a louse that is drawn moves it, and a louse more or less', () => {
  assert.equal(standsWith(scene()), true);
  for (const name of Object.keys(louse(1))) assert.equal(standsWith(scene({}, { [name]: 'other' })), false, name);
  assert.equal(standsWith(scene({ lice: [louse(1)] })), false);
  assert.equal(standsWith(scene({ lice: [louse(1), louse(2), louse(3)] })), false);
  assert.equal(stood(scene({}, { z: NaN })).stands, true, 'what is nowhere stands, too');
});

test('a rounding error is no motion, and many of them are', () => {
  const turned = (k) => scene({}, { heading_x: Math.SQRT1_2 + (k % 2) * 1.1e-16 });
  const { shown } = stood(turned(0)), stillness = new Stillness(), found = [];
  for (let k = 0; k < 30; k++) found.push(stillness.stands(turned(k), shown, 100 * k));
  assert.equal(found.at(-1), true);
  let moved = false;
  for (let k = 0; k < 30; k++) moved ||= !stillness.stands(scene({}, { heading_x: Math.SQRT1_2 + k * 1e-10 }), shown, 3000 + 10 * k);
  assert.ok(moved);
});

test('all else that it depends on moves it', () => {
  const { camera, drawing } = picture(), worn = new Trails();
  worn.isDue(0), worn.add(1, 0, 0, 0, 1), worn.sweep();
  for (const more of [{ theme: 'light' }, { palette: 'other' }, { relief: 'a like one' }, { isBaked: false }, { camera: { ...camera, width: 1281 } }, { camera: { ...camera, matrix: [1, 0, 0, 2] } },
    { camera: { ...camera, view: 'follow' } }, { camera: { ...camera, insets: { ...camera.insets, left: 2 } } }, { drawing: { ...drawing, version: 4 } }, { drawing: { ...drawing, isPainted: false } },
    { staging: { trails: worn } }])
    assert.equal(standsWith(scene(), more), false, JSON.stringify(more));
  assert.equal(standsWith(scene({ follow: 2 })), false);
  assert.equal(standsWith(scene(), { theme: 'dark' }), true);
});

test('what pulses never stands', () => {
  assert.equal(stood(scene({ you: 2 })).stands, false);
  for (const [name, mark] of Object.entries({ gates: [{}], crumbs: [{}], ghosts: [{}], ring: {}, arrow: {} })) assert.equal(stood(scene({ marks: { ...NONE, [name]: mark } })).stands, false, name);
  assert.equal(stood(scene({ marks: null })).stands, true);
});

test('it stands as finely drawn as it gets, and moves as before', () => {
  const shown = picture({ resolution: new Resolution(2) }), { stillness, stands } = stood(scene(), shown);
  assert.ok(!stands && shown.resolution.at === 0, 'drawn a second time');
  let now = 2500;
  while (!stillness.stands(scene(), shown, now)) assert.ok((now += 100) < 4000);
  assert.equal(shown.last, -Infinity, 'nothing is learned of such frames');
  assert.equal(stillness.stands(scene({}, { x: 7 }), shown, now + 100), false);
  assert.equal(shown.resolution.at, 2);
  assert.equal(shown.resolution.since, now + 100);
});

test('how long its finest pictures take leaves the resolution as it is', () => {
  const shown = picture({ resolution: new Resolution(2) }), stillness = new Stillness();
  for (let now = 0; now < 9000; now += 300) {  // as Picture.draw() does, on a machine that is slow
    shown.resolution.frame(now, now - shown.last);
    shown.last = now;
    stillness.stands(scene(), shown, now);
  }
  assert.equal(shown.resolution.at, 0);
});

test('it does not stand before its ground is smooth, where a processor draws', () => {
  const { drawing } = picture();
  assert.equal(stood(scene(), picture({ drawing: { ...drawing, fine: { kept: 1 } } })).stands, false);
  assert.equal(stood(scene(), picture({ drawing: { ...drawing, isSoftware: false, fine: { kept: 0 } } })).stands, true);
});

test('trails stay, however long it stands', () => {
  const shown = picture(), stillness = new Stillness(), { trails } = shown.staging;
  trails.isDue(0), trails.add(1, 0, 0, 0, 1), trails.sweep();
  for (let now = 0; now <= 60000; now += 500) stillness.stands(scene(), shown, now);
  assert.ok(!trails.isDue(60100) && trails.isDue(60200) && trails.trails.size === 1);
});
