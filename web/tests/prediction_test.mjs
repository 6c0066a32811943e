import assert from 'node:assert/strict';
import test from 'node:test';
import { ServerClock } from '../page/live/timeline.js';
import { busy, HZ, play } from './line.mjs';
import { GhostRun, isDrive } from '../page/live/own/ghosts.js';
import { Lead, Pilot } from '../page/live/own/pilot.js';
import { Steering } from '../page/live/own/steering.js';
import { Ways } from '../page/live/ways.js';

/** Level ground without friction, by the interface of the core's World: enough to see who is told what, and when. */
class LevelWorld {
  #lice = new Map();
  put(louse) { this.#lice.set(louse.id, { ...louse }); }
  clear() { this.#lice.clear(); }
  lice() { return [...this.#lice.values()].map((louse) => ({ ...louse })); }
  thrust(id, kind, x, y, ticks) { Object.assign(this.#lice.get(id), { thrust_kind: kind, tx: x, ty: y, ticks_left: ticks }); }
  step(ticks) {
    for (let k = 0; k < ticks; k++) for (const louse of this.#lice.values()) {
      if (louse.ticks_left > 0) {
        louse.vx += louse.tx * 4 / HZ;
        louse.vy += louse.ty * 4 / HZ;
        if (louse.ticks_left < 4294967295 && --louse.ticks_left === 0) Object.assign(louse, { thrust_kind: 0, tx: 0, ty: 0 });
      }
      louse.x += louse.vx / HZ;
      louse.y += louse.vy / HZ;
    }
  }
}
const BEGIN = { id: 7, phase: 0, x: 1, y: 2, vx: 0, vy: 0, heading_x: 1, heading_y: 0, tx: 0, ty: 0, flight_z: 0, flight_vz: 0, distance: 0, thrust_kind: 0, ticks_left: 0 };

test('every ack is what the page already had, to the bit, on a short line', () => {
  const { exact, corrected, late } = play({ openWorld: () => new LevelWorld(), begin: BEGIN, delay: 0.002, jitter: 0.003, seconds: 20, hands: busy });
  assert.ok(exact > 80, `${exact} acks`);
  assert.deepEqual([corrected, late], [0, 0]);
});

test('every ack is what the page already had, to the bit, at 150 ms with 40 ms of jitter', () => {
  for (const seed of [1, 2, 3, 4, 5]) {
    const { exact, corrected, late } = play({ openWorld: () => new LevelWorld(), begin: BEGIN, delay: 0.075, jitter: 0.04, seconds: 30, seed, hands: busy });
    assert.ok(exact > 100, `${exact} acks`);
    assert.deepEqual([seed, corrected, late], [seed, 0, 0]);
  }
});

test('every ack is what the page already had, to the bit, after a pause, too', () => {
  for (const seed of [1, 2, 3, 4, 5]) {
    const { exact, corrected } = play({ openWorld: () => new LevelWorld(), begin: BEGIN, delay: 0.075, jitter: 0.04, seconds: 20, seed, hands: busy, pause: [9.9 + seed / 30, 13] });
    assert.ok(exact > 50, `${exact} acks`);
    assert.deepEqual([seed, corrected], [seed, 0]);
  }
});

test('an input that came too late is put right by its ack, and the louse goes on from there', () => {
  const world = new LevelWorld(), steering = new Steering(HZ), clock = new ServerClock(HZ);
  const pilot = new Pilot({ hz: HZ, id: 7, steering, ways: new Ways(), world });
  for (let k = 0; k < 6; k++) pilot.lead.trip(0.02);
  clock.observe(100, 0);
  const asked = pilot.update(0, clock);
  const you = (tick, more) => ({ ...BEGIN, ...more, tick, heading: [1, 0], thrust: [0, 0], thrust_ticks: 0 });
  pilot.acknowledge({ seq: asked.seq, tick: asked.tick, margin_us: 9000, late: false, dropped: false, you: you(asked.tick + 1) });
  steering.lookAlong(0);
  steering.hold('up', 0.02);
  const push = pilot.update(0.02, clock);
  for (let k = 2; k < 40; k++) pilot.update(k / 60, clock);
  const before = pilot.prediction.louse.x;
  const late = you(push.tick + 4, { vx: 4 / HZ, x: 1 + 4 / HZ / HZ });
  pilot.acknowledge({ seq: push.seq, tick: push.tick + 3, margin_us: 1000, late: true, dropped: false, you: { ...late, thrust: [1, 0], thrust_kind: 2, thrust_ticks: 23 } });
  assert.equal(pilot.prediction.corrected, 1);
  assert.ok(pilot.prediction.louse.x < before && pilot.prediction.tick === Math.floor(pilot.prediction.tick));
  assert.ok(Math.abs(pilot.louse.x - before) < 0.1, 'what was shown fades over to it');
});

test('a lead grows at once with what was late and shrinks slowly', () => {
  const lead = new Lead(HZ);
  for (let k = 0; k < 8; k++) lead.trip(0.02);
  const first = lead.ticks(0);
  lead.observe({ margin_us: 2000, tick: 110 }, 100, first);  // ten ticks late
  for (let k = 1; k <= 60; k++) lead.ticks(k / 60);
  const grown = lead.ticks(1.01);
  assert.ok(grown > first + 9, `${first} to ${grown}`);
  for (let k = 0; k < 60; k++) lead.observe({ margin_us: 1e5, tick: 200 }, 200, grown);
  assert.ok(lead.ticks(1.1) > grown - 0.5);
  assert.ok(lead.ticks(20) < grown - 3);
});

test('a drive that is driven again is where it was, forwards, back and after a leap', () => {
  const inputs = [[0, 2, 1, 0, 90], [100, 2, 0, 1, 60]];
  const run = () => new GhostRun(new LevelWorld(), { start: BEGIN, inputs, ticks: 400, lap: 0 }, HZ);
  const step = run(), places = [];
  for (let k = 0; k <= 400; k++) places.push(step.at(k).x);
  assert.equal(run().at(300).x, places[300]);
  assert.equal(step.at(50).x, places[50]);
  assert.equal(step.at(401), null);
});

test('what is no drive is none', () => {
  const drive = { start: BEGIN, inputs: [[0, 2, 1, 0, 90]], ticks: 400, lap: 0 };
  assert.ok(isDrive(drive, HZ));
  for (const wrong of [null, { ...drive, ticks: 0 }, { ...drive, inputs: [[0, 2, 1, 1, 90]] }, { ...drive, inputs: [[5, 2, 1, 0, 9], [4, 2, 1, 0, 9]] },
    { ...drive, inputs: [[0, 3, 1, 0, 9]] }, { ...drive, inputs: [[0, 2, NaN, 0, 9]] }, { ...drive, inputs: 'x' }]) assert.ok(!isDrive(wrong, HZ));
});
