import assert from 'node:assert/strict';
import test from 'node:test';
import { between, Ways } from '../page/live/ways.js';
import { applied, COLUMNS, Frames } from '../page/live/frames.js';

const louse = (more) => ({ id: 1, phase: 0, x: 0, y: 0, vx: 0, vy: 0, heading_x: 1, heading_y: 0, distance: 0, flight_z: 0, ...more });
const row = (id, x, vx = 0) => [id, x * 1024, 0, vx * 1024, 0, 1024, 0, 0, 0];
const QUANTUM = [1, ...Array(8).fill(1 / 1024)];
const frames = () => new Frames(60, COLUMNS, QUANTUM);
const straight = new Ways([-20, -20, 20, 20]);

test('between two snapshots a louse is on the curve through both places with both velocities', () => {
  const seconds = 0.05, g = -9.81, at = (t) => louse({ x: 3 * t + g * t * t / 2, vx: 3 + g * t });
  for (const t of [0, 0.25, 0.5, 1]) {
    const drawn = between(at(0), at(seconds), seconds, t, straight);
    assert.ok(Math.abs(drawn.x - at(t * seconds).x) < 1e-12, `at ${t}`);  // a parabola is one of its curves
  }
});

test('where edges wrap the way leads over the seam', () => {
  const wrapping = new Ways([-20, -20, 20, 20], [true, true]);
  const drawn = between(louse({ x: 19.9, vx: 4 }), louse({ x: -19.9, vx: 4 }), 0.05, 0.5, wrapping);
  assert.ok(Math.abs(Math.abs(drawn.x) - 20) < 1e-9);
  assert.deepEqual(wrapping.way(19, 0, -19, 0), [2, 0]);
  assert.deepEqual(wrapping.place(21, -21), [-19, 19]);
});

test('who jumped is not drawn in flight', () => {
  const drawn = between(louse({ x: 0 }), louse({ x: 15 }), 0.05, 0.5, straight);
  assert.equal(drawn.x, 0);
});

test('deltas are against their key, not against each other, and any may be lost', () => {
  const shown = frames();
  assert.equal(shown.merge({ type: 'key', tick: 60, louse: [row(1, 0), row(2, 5)] }), 'taken');
  assert.equal(shown.merge({ type: 'delta', tick: 66, base: 60, louse: [row(1, 1), row(3, 7)], gone: [2] }), 'taken');
  assert.deepEqual([...shown.newest.lice.keys()].sort(), [1, 3]);
  assert.equal(shown.merge({ type: 'delta', tick: 69, base: 60, louse: [row(2, 6)], gone: [] }), 'taken');
  assert.deepEqual([...shown.newest.lice.values()].map(({ id, x }) => [id, x]).sort(), [[1, 0], [2, 6]]);
});

test('a delta without its key asks for one, an old frame is passed over, strange columns are told', () => {
  const shown = frames();
  assert.equal(shown.merge({ type: 'delta', tick: 63, base: 60, louse: [] }), 'missing');
  assert.equal(shown.merge({ type: 'key', tick: 120, louse: [row(1, 0)] }), 'taken');
  assert.equal(shown.merge({ type: 'key', tick: 120, louse: [row(1, 0)] }), 'stale');
  assert.equal(shown.merge({ type: 'key', tick: 180, louse: [[1, 2]] }), 'unreadable');
});

test('of a game the delta changes those members alone, and of crumbs those slots', () => {
  const whole = { phase: 'play', round: 1, until: 900, crumbs: [[0, 1, 1, 1], [1, 2, 2, 3]], table: [[1, 4]] };
  assert.deepEqual(applied(whole, { crumbs: [[1, 2, 2, 0]], table: [[1, 7]] }),
    { phase: 'play', round: 1, until: 900, crumbs: [[0, 1, 1, 1], [1, 2, 2, 0]], table: [[1, 7]] });
  assert.equal(applied(whole, undefined), whole);
});

test('beyond the newest snapshot a louse is thought on for a quarter of a second', () => {
  const shown = frames();
  shown.merge({ type: 'key', tick: 0, louse: [row(1, 0, 2)] });
  assert.ok(Math.abs(shown.at(6, straight)[0].x - 0.2) < 1e-9);
  assert.ok(Math.abs(shown.at(600, straight)[0].x - 0.5) < 1e-9);
});
