// How far the steps of one louse err, as the page asks its core: in a world of its own, where ticks are run again, and of a recording.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { Core } from '../page/core/core.js';
import { CoreEnded } from '../page/core/instance.js';
import { LouseError } from '../page/core/louse_error.js';
import { RecordingDesk } from '../page/core/recording_desk.js';
import { Prediction } from '../page/live/own/prediction.js';
import { Ways } from '../page/live/ways.js';
import { errorInWords } from '../page/panels/error_figure.js';

const { WOODLOUSE_CORE, WOODLOUSE_RECORDINGS = '' } = process.env;
const skip = WOODLOUSE_CORE ? false : 'WOODLOUSE_CORE names no core.wasm';
const module = WOODLOUSE_CORE ? await WebAssembly.compile(readFileSync(WOODLOUSE_CORE)) : null;
const ground = async () => (await Core.load(module)).openMap(readFileSync(new URL('../../maps/hills.json', import.meta.url), 'utf8'), 60);
const HELD = 4294967295;

/** What the server says of a louse before step `tick`. */
const stated = (louse, tick) => ({
  id: louse.id, phase: louse.phase, x: louse.x, y: louse.y, vx: louse.vx, vy: louse.vy, heading: [louse.heading_x, louse.heading_y], thrust: [louse.tx, louse.ty], flight_z: louse.flight_z,
  flight_vz: louse.flight_vz, distance: louse.distance, thrust_kind: louse.thrust_kind, thrust_ticks: louse.ticks_left, tick,
});

test('an error is told in the words of the terminal', () => {
  assert.equal(errorInWords({ of_play: 1.23e-7, worst: 0, worst_tick: 1234, apart: 5.61e-12, apart_seconds: 10 }),
    'error 1.2e-07 m/s of play, worst 0.0e+00 m at tick 1234; twin at half the step 5.6e-12 m away after 10 s');
  assert.equal(errorInWords(null), 'error -- m/s of play');
});

test('ticks of the prediction count once they have settled, and those that are run again as they were run last', { skip }, async () => {
  const hills = await ground(), [start] = hills.spawns(), push = { kind: 2, x: 0.8, y: 0.6, ticks: HELD };
  const straight = hills.world(), other = new LouseError(hills, 'roam', 0);
  straight.put(start);
  straight.thrust(start.id, push.kind, push.x, push.y, push.ticks);
  const prediction = new Prediction(hills.world(), new Ways(hills.domain, hills.wraps));
  prediction.acknowledge({ seq: 0, tick: 1, you: stated(start, 1) });
  const error = prediction.error = new LouseError(hills, 'roam', 60);
  prediction.advance(40);  // without the push, which the server has taken
  assert.equal(error.count(1000), null);
  prediction.acknowledge({ seq: 0, tick: 1, you: stated(straight.lice()[0], 1) });
  prediction.advance(200);
  for (let tick = 1; tick <= 139; tick++) {  // the last one that is 60 ticks old
    other.find(straight, start.id, tick);
    straight.step();
  }
  const reading = error.count(1000);
  assert.deepEqual(reading, other.count(1000));
  assert.ok(reading.of_play > 0 && reading.worst > 0 && reading.worst_tick >= 1, errorInWords(reading));
  error.forget();
  assert.deepEqual(error.count(1000), reading);
  error.close();
  other.close();
});

test('of a recording the error of who is measured is told, over what was stepped since the last jump', { skip }, async () => {
  const desk = new RecordingDesk(module), info = await desk.open(readFileSync(join(WOODLOUSE_RECORDINGS, 'map_hills.ndjson')));
  const { lice: [{ id }], error: none } = await desk.advance(20);
  assert.equal(none, null);
  await desk.measure(id);
  const { measured, error } = await desk.advance(20);
  assert.equal(measured, id);
  assert.ok(error.of_play >= 0 && error.worst_tick >= info.first + 20 && error.worst_tick < info.first + 40, JSON.stringify(error));
  assert.equal((await desk.seek(info.first + 20)).error, null);
  assert.deepEqual((await desk.advance(20)).error, error);
  assert.throws(() => desk.core.instance.call('world_step', 99, 1), CoreEnded);
  await desk.seek(info.first + 20);
  assert.deepEqual((await desk.advance(20)).error, error);
  await desk.measure(0);
  assert.equal((await desk.advance(1)).error, null);
});
