// A picture that stands is not drawn again, and one in which anything changes is.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Stillness } from '../page/picture/fine_drawing.js';
import { Trails } from '../page/picture/trails.js';

const louse = (id, more = {}) => ({ id, phase: 0, x: id, y: 2, z: 3, zx: .1, zy: .2, vx: 1, vy: 0, heading_x: 1, heading_y: 0, flight_z: 0, flight_vz: 0, distance: 5, name: `louse ${id}`, colour: id, outline: false, ...more });
const NONE = { gates: [], crumbs: [], ring: null, ghosts: [], arrow: null };
const scene = (more = {}, ofFirst = {}) => ({ lice: [louse(1, ofFirst), louse(2)], you: 0, follow: 0, marks: NONE, ...more });

const picture = (more = {}) => ({ canvas: { width: 640, height: 400 }, camera: { width: 1280, height: 800, insets: { left: 1, top: 2, right: 3, bottom: 4 }, matrix: [1, 0, 0, 1] },
  drawing: { isFine: true, isPainted: true, version: 3 }, palette: 'default', theme: 'dark', relief: 'hills', isBaked: true, staging: { trails: new Trails() }, ...more });

/** Whether it stands after 1.9 s of the same, if the last picture is of `last`, and so. */
function standsAt(one, last = one, more = {}) {
  const shown = picture(), stillness = new Stillness();
  for (let now = 0; now < 1900; now += 100) stillness.stands(one, shown, now);
  Object.assign(shown, more);
  return stillness.stands(last, shown, 1900);
}

test('it stands once the same was asked for a second long, and not before', () => {
  const shown = picture(), stillness = new Stillness(), found = [];
  for (let now = 0; now <= 1200; now += 100) found.push(stillness.stands(scene(), shown, now));
  assert.deepEqual(found, [...Array(10).fill(false), true, true, true]);
});

test('anything of a louse that is drawn moves it, and a louse more or less', () => {
  assert.equal(standsAt(scene(), scene()), true);
  for (const name of Object.keys(louse(1))) assert.equal(standsAt(scene(), scene({}, { [name]: 'other' })), false, name);
  assert.equal(standsAt(scene(), scene({ lice: [louse(1)] })), false);
  assert.equal(standsAt(scene(), scene({ lice: [louse(1), louse(2), louse(3)] })), false);
  assert.equal(standsAt(scene({}, { z: NaN })), true, 'what is nowhere stands, too');
});

test('all else that it depends on moves it', () => {
  const { canvas, camera, drawing } = picture();
  for (const more of [{ theme: 'light' }, { palette: 'other' }, { relief: 'a like one' }, { isBaked: false }, { canvas: { ...canvas, width: 641 } }, { camera: { ...camera, matrix: [1, 0, 0, 2] } },
    { camera: { ...camera, insets: { ...camera.insets, left: 2 } } }, { drawing: { ...drawing, version: 4 } }, { drawing: { ...drawing, isPainted: false } }])
    assert.equal(standsAt(scene(), scene(), more), false, JSON.stringify(more));
  assert.equal(standsAt(scene(), scene({ follow: 2 })), false);
  assert.equal(standsAt(scene(), scene(), { theme: 'dark' }), true);
});

test('what pulses never stands', () => {
  assert.equal(standsAt(scene({ you: 2 })), false);
  for (const [name, mark] of Object.entries({ gates: [{}], crumbs: [{}], ghosts: [{}], ring: {}, arrow: {} })) assert.equal(standsAt(scene({ marks: { ...NONE, [name]: mark } })), false, name);
  assert.equal(standsAt(scene({ marks: null })), true);
});

test('trails stay, however long it stands', () => {
  const shown = picture(), stillness = new Stillness(), { trails } = shown.staging;
  trails.isDue(0), trails.add(1, 0, 0, 0, 1), trails.sweep();
  for (let now = 0; now <= 60000; now += 500) stillness.stands(scene(), shown, now);
  assert.equal(shown.last, -Infinity, 'nothing is learned of frames that are not drawn');
  assert.ok(!trails.isDue(60100) && trails.isDue(60200) && trails.trails.size === 1);
});
