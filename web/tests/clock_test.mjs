import assert from 'node:assert/strict';
import test from 'node:test';
import { ServerClock, Timeline } from '../page/live/timeline.js';
import { Pace, ServerWord } from '../page/live/word.js';

/** Numbers from 0 to 1, the same each time. */
function chances(seed) {
  let state = seed;
  return () => (state = (state * 1103515245 + 12345) % 2147483648) / 2147483648;
}

test('a clock shows the earliest arrivals\' line, whatever the others were late by', () => {
  const clock = new ServerClock(60), chance = chances(7);
  let worst = 0;
  for (let k = 0; k < 400; k++) {
    const sent = k / 20, now = sent + 0.05 + 0.04 * chance();
    clock.observe(k * 3, now);
    if (k > 100) worst = Math.max(worst, Math.abs(clock.tick(now) - (now - 0.05) * 60));
  }
  assert.ok(worst < 0.5, `${worst} ticks off`);
});

test('what a clock shows never goes back', () => {
  const clock = new ServerClock(60), chance = chances(3);
  let last = -1;
  for (let k = 0; k < 400; k++) {
    const now = k / 20 + 0.3 * chance();
    clock.observe(k * 3, k / 20 + 0.3);
    const tick = clock.tick(Math.max(now, k / 20));
    assert.ok(tick >= last);
    last = tick;
  }
});

test('a clock falls with a server that has lost time, and only then', () => {
  const clock = new ServerClock(60);
  for (let k = 0; k < 40; k++) clock.observe(k * 3, k / 20);
  for (let k = 40; k < 43; k++) clock.observe(k * 3, k / 20 + 0.3);  // three late frames are no reason
  assert.ok(Math.abs(clock.tick(43 / 20) - 129) < 1);
  for (let k = 43; k < 120; k++) clock.observe(k * 3, k / 20 + 1);
  assert.ok(Math.abs(clock.tick(120 / 20 + 1) - 360) < 2);
});

test('a server that says nothing for 1.5 s is told of, one that says anything is not', () => {
  const word = new ServerWord();
  word.heard(10);
  assert.equal(word.silence(11.4), null);
  assert.ok(word.silence(11.6) > 1.5);
  word.heard(11.6);
  assert.equal(word.silence(12), null);
});

test('a tick that is shown again stands, and the next one goes on after it stood', () => {
  const word = new ServerWord();
  word.expect(20);
  assert.equal(word.shown(5, 1), true);  // nothing was known before
  assert.equal(word.shown(8, 1.05), false);
  assert.equal(word.shown(8, 3), false);
  assert.ok(word.stands && !word.goesOn(3));
  assert.equal(word.shown(9, 3.1), true);
  assert.ok(!word.stands && word.goesOn(3.1));
});

test('a page whose frames are more than a second old for three asks for half, and not before', () => {
  const pace = new Pace(60);
  const halves = [];
  for (let k = 0; k < 200; k++) {
    const lag = k < 60 ? 0 : Math.min(5, (k - 60) / 20);
    if (pace.observe(k * 3, k / 20 + lag)) halves.push((k - 60) / 20);
  }
  assert.ok(halves[0] > 1.4 && halves[0] < 4, `first after ${halves[0]} s`);
  const healthy = new Pace(60);
  for (let k = 0; k < 400; k++) assert.equal(healthy.observe(k * 3, k / 20 + (k % 10 ? 0.1 : 0.9)), false);
});

test('a game that was paused for long is not one whose frames come late', () => {
  const timeline = new Timeline({ tick_hz: 60, state_hz: 20, fields: [], quantum: [] }, 0);
  const told = [];
  for (let frame = 0, now = 0; frame < 400; frame++, now += 0.05) {
    if (frame === 100 || frame === 200) {  // it says so, and stands
      timeline.word.paused();
      now += 7;
    }
    told.push(timeline.observe(3 * frame, now));
  }
  assert.deepEqual(told.flatMap(({ isAnew }, frame) => (isAnew ? [frame] : [])), [0, 100, 200]);
  assert.ok(!told.some(({ isTooOld }) => isTooOld));
});

test('a page that comes later and later does not keep up, whatever was before', () => {
  const timeline = new Timeline({ tick_hz: 60, state_hz: 20, fields: [], quantum: [] }, 0);
  let isTooOld = false;
  for (let frame = 0; frame < 200; frame++) isTooOld ||= timeline.observe(3 * frame, frame * 0.07).isTooOld;
  assert.ok(isTooOld);
});

test('a server that stood for a second and a half is not a page that does not keep up', () => {
  const asked = (trip) => {
    const timeline = new Timeline({ tick_hz: 60, state_hz: 20, fields: [], quantum: [] }, 0);
    let isTooOld = false;
    for (let frame = 0; frame < 400; frame++) isTooOld ||= timeline.observe(3 * frame, frame / 20 + (frame < 100 ? 0 : 1.5), trip).isTooOld;
    return isTooOld;
  };
  assert.equal(asked(0.02), false);
  assert.equal(asked(1.52), true);  // its answers, too, wait behind what was not read
});
