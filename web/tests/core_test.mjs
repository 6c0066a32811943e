// The core as the page calls it: maps, worlds, hashes, followers, recordings; what is refused, and what ends it.
// WOODLOUSE_CORE: core.wasm; WOODLOUSE_RECORDINGS: recordings of the scenarios (tests/web).
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { Core } from '../page/core/core.js';
import { CoreEnded } from '../page/core/instance.js';
import { RecordingDesk } from '../page/core/recording_desk.js';

const { WOODLOUSE_CORE, WOODLOUSE_RECORDINGS = '' } = process.env;
const skip = WOODLOUSE_CORE ? false : 'WOODLOUSE_CORE names no core.wasm';
const module = WOODLOUSE_CORE ? await WebAssembly.compile(readFileSync(WOODLOUSE_CORE)) : null;
const fresh = () => Core.load(module);
const map = name => readFileSync(new URL(`../../maps/${name}.json`, import.meta.url), 'utf8');
const recording = name => readFileSync(join(WOODLOUSE_RECORDINGS, name));

test("a louse's fields tile its bytes", { skip }, async () => {
  const core = await fresh();
  assert.deepEqual(core.fields.map(field => field.name).slice(0, 4), ['id', 'phase', 'x', 'y']);
  let end = 0;
  for (const { offset, size } of core.fields) {
    assert.equal(offset, end);
    end += size;
  }
  assert.equal(core.rows.size, end);
});

test("a map is opened by its definition and by the wire's line, and its own text gives it again", { skip }, async () => {
  const core = await fresh();
  const ground = core.openMap(map('volcano'), 60);
  assert.match(ground.hash, /^[0-9a-f]{16}$/);
  assert.equal(core.openMap(ground.definitionText, 60).hash, ground.hash);
  const line = `{"type":"map","name":"volcano","hash":"${ground.hash}","definition":${ground.definitionText}}`;
  assert.equal(core.openMapLine(line, 60).hash, ground.hash);
  const grid = ground.grid(3, 3);
  const [x0, y0, x1, y1] = ground.domain;
  const middle = ground.sample((x0 + x1) / 2, (y0 + y1) / 2);
  assert.deepEqual([...grid.slice(12, 15)], [middle.z, middle.zx, middle.zy].map(Math.fround));
  assert.equal(ground.sample(1e9, 1e9).z, ground.sample(x1, y1).z);
});

test('numbers of every size are read and written as the same doubles', { skip }, async () => {
  const core = await fresh();
  const of = height => `{"name":"n","terrain":{"origin":[0,0],"spacing":[2000,2000],"heights":[[${height},0,0,0],[0,0,0,0],[0,0,0,0],[0,0,0,0]]}}`;
  for (const height of ['5e-324', '2.2250738585072014e-308', '1e-300', '-1.7976e-5', '0.1', '-0.0', '123456.78901', '4.9e-3', '0.00390625', '1e-7', '1.5e-10', '0.30000000000000004']) {
    const ground = core.openMap(of(height), 60);
    assert.ok(Object.is(ground.definition.terrain.heights[0][0], Number(height)), `${height}: ${ground.definitionText}`);
    assert.equal(core.openMap(ground.definitionText, 60).hash, ground.hash);
  }
});

test("a big map's overview is drawn, and nothing is computed on it", { skip }, async () => {
  const core = await fresh();
  const line = '{"type":"map","name":"alps","hash":"0123456789abcdef","definition":{"name":"alps","terrain":{"file":"alps.flt","storage":"tiles","fingerprint":"00c0ffee00c0ffee"}},'
    + '"overview":true,"knots":{"origin":[-600,-600],"spacing":[400,400],"columns":4,"rows":4,"heights":[[0,0,0,0],[0,1,1,0],[0,1,1,0],[0,0,0,0]]}}';
  const ground = core.openMapLine(line, 60);
  assert.equal(ground.isExact, false);
  assert.deepEqual(ground.domain, [-600, -600, 600, 600]);
  assert.throws(() => ground.world(), /only drawn/);
});

test('what is no map is refused in words, and the core goes on', { skip }, async () => {
  const core = await fresh();
  for (const text of ['', '{', '{"name":1}', '[]', 'null', '{"name":"x","terrain":{"file":"../etc/passwd"}}', '\u0000', '{'.repeat(100_000)])
    assert.throws(() => core.openMap(text, 60), error => error instanceof Error && !(error instanceof CoreEnded) && error.message.length > 0);
  // Ragged rows whose product no memory holds.
  const rows = Array.from({ length: 70_000 }, () => '[]').join();
  assert.throws(() => core.openMap(`{"name":"r","terrain":{"spacing":1,"heights":[[${"0,".repeat(69_999)}0],${rows}]}}`, 60), /heights/);
  for (const line of ['', '{}', '{"type":"hello"}', '{"type":"map","name":"a","hash":"0","definition":{}}'])
    assert.throws(() => core.openMapLine(line, 60), error => !(error instanceof CoreEnded));
  assert.equal(core.openMap(map('hills'), 60).name, 'hills');
});

test('worlds step lice, each for itself', { skip }, async () => {
  const core = await fresh();
  const ground = core.openMap(map('hills'), 60);
  const [start] = ground.spawns();
  const [one, other] = [ground.world(), ground.world()];
  one.put({ ...start, id: 7 });
  other.put({ ...start, id: 7 });
  assert.ok(one.thrust(7, 2, 0.5, -0.5, 4294967295));
  one.step(60);
  other.step(60);
  assert.notDeepEqual(one.find(7), other.find(7));
  other.put({ ...start, id: 7 });
  assert.ok(other.thrust(7, 2, 0.5, -0.5, 4294967295));
  for (let k = 0; k < 60; ++k) other.step();
  assert.deepEqual(one.lice(), other.lice());
  assert.equal(one.thrust(8, 1, 1, 0, 1), false);
  assert.equal(one.thrust(7, 2, 1, 1, 1), false);  // longer than 1
  assert.throws(() => one.put({ ...start, id: 9, x: NaN }), /no louse/);
  assert.throws(() => one.put({ ...start, id: 9, phase: 3 }), /no louse/);
  assert.throws(() => one.put({ ...start, id: 9, thrust_kind: 2, tx: 1e300, ticks_left: 60 }), /no louse/);
  assert.ok(one.erase(7));
  assert.equal(one.find(7), null);
});

test('lice step together, in lanes, as each does alone, without', { skip }, async () => {
  const core = await fresh();
  for (const name of ['volcano', 'jumps', 'arena', 'torus', 'hills']) {
    const ground = core.openMap(map(name), 60), [start] = ground.spawns(), [x0, y0, x1, y1] = ground.domain;
    const together = ground.world(), alone = ground.world();
    const lice = Array.from({ length: 41 }, (_, k) => ({ ...start, id: k + 1, x: x0 + (x1 - x0) * (k * 0.618034 % 1), y: y0 + (y1 - y0) * (k * 0.754878 % 1), vx: k % 7 - 3, vy: k % 5 - 2 }));
    const thrusts = (world, id, tick) => world.thrust(id, 1 + id % 2, Math.cos(id + tick) * (id % 2 ? 0.7 : 1), id % 2 ? Math.sin(id * tick) * 0.7 : 0, 4294967295);
    for (const louse of lice) together.put(louse);
    for (let tick = 0; tick < 300; tick += 30) {
      const before = together.lice();
      for (const { id } of before) assert.ok(thrusts(together, id, tick));
      together.step(30);
      const expected = before.map(louse => {
        alone.clear();
        alone.put(louse);
        assert.ok(thrusts(alone, louse.id, tick));
        alone.step(30);
        return alone.find(louse.id);
      });
      assert.deepEqual(together.lice(), expected, `${name}, ${tick}`);
    }
  }
});

test('a call by a handle that is none ends the instance, and says so', { skip }, async () => {
  const core = await fresh();
  assert.throws(() => core.instance.call('world_step', 99, 1), error => error instanceof CoreEnded && /handle/.test(error.message));
  assert.throws(() => core.openMap(map('hills'), 60), CoreEnded);
});

test("a room's lines are followed, and each of their steps proven", { skip }, async () => {
  const core = await fresh();
  const lines = recording('joins_leaves_respawns.ndjson').toString().split('\n');
  const follower = core.follower();
  assert.equal(follower.tick, -1);
  for (const line of lines.slice(0, 40)) assert.ok(follower.take(line), JSON.stringify(follower.facts()));
  assert.ok(follower.tick > 0);
  assert.ok(follower.proven > 0);
  assert.ok(follower.lice().length > 0);
  assert.equal(follower.game(), null);
  const ground = follower.ground();
  assert.equal(ground.hz, follower.facts().hz);
});

test('the first line that differs is told, and nothing further is taken', { skip }, async () => {
  const core = await fresh();
  const lines = recording('joins_leaves_respawns.ndjson').toString().split('\n');
  const at = lines.findIndex((line, k) => k > 20 && line.includes('"inputs":[['));
  const follower = core.follower();
  lines[at] = lines[at].replace(/"hash":"(.)/, (_, digit) => `"hash":"${digit === "0" ? 1 : 0}`);
  lines.slice(0, at).forEach(line => assert.ok(follower.take(line)));
  const { tick } = follower;
  assert.equal(follower.take(lines[at]), false);
  assert.equal(follower.tick, -1);
  assert.equal(follower.difference.tick, tick + 1);
  assert.equal(follower.take(lines[at + 1]), false);
  for (const line of ['', '{', 'null', '{"step":1}', '{"type":"x"}', '\u0000', 'x'.repeat(1 << 20)]) assert.equal(core.follower().take(line), false);
});

test('a recording is sought in, stepped and verified', { skip }, async () => {
  const desk = new RecordingDesk(module);
  const bytes = recording('race_ring.ndjson.zst');
  const info = await desk.open(bytes);
  assert.equal(info.mode, 'race');
  const middle = Math.floor((info.first + info.last) / 2);
  const there = await desk.seek(middle);
  assert.equal(there.tick, middle);
  assert.equal(there.difference, null);
  assert.equal(there.game.phase.length > 0, true);
  await desk.seek(middle - 10);
  assert.deepEqual((await desk.advance(10)).lice, there.lice);
  assert.equal((await desk.seek(info.last)).tick, info.last);
  assert.equal((await desk.advance(5)).tick, info.last);
  const told = [];
  assert.deepEqual(await desk.verify(bytes, ticks => told.push(ticks)), { ok: 1, text: `ok ticks 0 to ${info.last}\n` });
  assert.ok(told.length > 0 && told.every((ticks, k) => ticks > (told[k - 1] ?? 0) && ticks <= info.last), told.join());
  await assert.rejects(desk.open(new Uint8Array([1, 2, 3])), /the recording/);
});

test('a recording goes on in a fresh instance when the one it was in has ended', { skip }, async () => {
  const desk = new RecordingDesk(module);
  const info = await desk.open(recording('map_hills.ndjson'));
  const before = await desk.seek(info.last - 3);
  assert.throws(() => desk.core.instance.call('world_step', 99, 1), CoreEnded);
  assert.deepEqual(await desk.seek(info.last - 3), before);
  assert.equal((await desk.advance(2)).tick, info.last - 1);
});
