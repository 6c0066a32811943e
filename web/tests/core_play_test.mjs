// The page's modules over the server's own physics: core.wasm, where it is built (WOODLOUSE_CORE).
import assert from 'node:assert/strict';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import { Core } from '../page/core/core.js';
import { SideBySide } from '../page/lab/side_by_side.js';
import { Stream } from '../page/live/stream.js';
import { Ways } from '../page/live/ways.js';
import { busy, HZ, play } from './line.mjs';

const file = process.env.WOODLOUSE_CORE ?? '';
const skip = existsSync(file) ? false : 'no core.wasm: WOODLOUSE_CORE names it';
const core = skip ? null : await Core.load(readFileSync(file));
const maps = path.join(path.dirname(new URL(import.meta.url).pathname), '../../maps');

test('on every kind of ground an ack\'s state is what the page had, at 150 ms with 40 ms of jitter', { skip }, () => {
  for (const [name, mode] of [['hills', 'roam'], ['volcano', 'roam'], ['jumps', 'roam'], ['torus', 'roam'], ['arena', 'roam'], ['kepler', 'roam'], ['hoffmann_2002', 'roam'], ['crater_loop', 'race'], ['table', 'hill']]) {
    const ground = core.openMap(readFileSync(path.join(maps, `${name}.json`), 'utf8'), HZ);
    const begin = { ...ground.spawns(mode)[0], id: 7 };
    const { exact, corrected, late } = play({ openWorld: () => ground.world(mode), begin, delay: 0.075, jitter: 0.04, seconds: 12, hands: busy, ways: new Ways(ground.domain, ground.wraps) });
    assert.ok(exact > 30, `${name}: ${exact} acks`);
    assert.deepEqual([name, corrected, late], [name, 0, 0]);
  }
});

test('a recording that comes line by line is re-run, proven, and shown thirty times a second', { skip: skip || (process.env.WOODLOUSE_RECORDINGS ? false : 'no recordings: WOODLOUSE_RECORDINGS names their folder') }, () => {
  const folder = process.env.WOODLOUSE_RECORDINGS ?? '';
  const name = readdirSync(folder).find((each) => each.endsWith('.ndjson')) ?? '';
  const lines = readFileSync(path.join(folder, name), 'utf8').split('\n').filter((line) => line && !/^\{"(end|index|chat)/.test(line));
  const stream = new Stream(core);
  stream.begin(HZ, 20);
  let shown = 0;
  for (const line of lines) {
    assert.ok(stream.take(line), `${name}: ${stream.difference}`);
    shown += stream.takeSnapshots().length;
  }
  assert.ok(stream.proven > 0 && shown > 0, `${stream.proven} proven, ${shown} shown`);
  const wrong = lines.map((line) => line.replace(/"hash":"(.)/, (_, digit) => `"hash":"${digit === '0' ? '1' : '0'}`));
  const other = new Stream(core);
  other.begin(HZ, 20);
  assert.ok(wrong.some((line) => !other.take(line)));
  assert.match(other.difference, /^differs at tick \d+/);
});

test('side by side the exact run keeps its energy and the paper\'s does not, from every start', { skip }, () => {
  const lab = new SideBySide(core);
  for (let start = 0; start < 4; start++) {
    for (let k = 0; k <= 600; k++) lab.update(start * 100 + k / 60);
    assert.ok(Math.abs(lab.change('exact')) < 1e-4, `start ${start}: ${lab.change('exact')}`);
    const apart = Math.max(...lab.series.distance);
    assert.ok(apart > 0.5, `start ${start}: ${apart} m apart`);
    lab.begin(true);
  }
});
