import assert from 'node:assert/strict';
import test from 'node:test';
import { aim, goalLines, marksOf, podium, scoreRows } from '../page/live/goal.js';
import { Lesson } from '../page/live/own/lesson.js';
import { OwnRun } from '../page/live/own/own_game.js';
import { Ways } from '../page/live/ways.js';
import { farewell, medalOf, medalToWin, pointer, scoreText, signedText, spanText, told } from '../page/live/words.js';

const HZ = 60, SECOND = HZ * 65536;
const words = (lines) => lines.map((line) => line.map(({ text }) => text).join('  ')).join('\n');
const louse = (id, more) => ({ id, x: 0, y: 0, vx: 0, vy: 0, distance: id, ...more });
const facts = (more) => ({ mode: 'roam', rules: null, game: null, tick: 600, hz: HZ, lice: [], ways: new Ways(), you: null, id: 0, isOwn: true, run: null, nameOf: (id) => `louse ${id}`, rank: 0, ...more });
const RACE = { laps: 3, author_ms: 60000, gates: [{ a: [-1, 0], b: [1, 0] }, { a: [9, 9], b: [11, 11], air: true }] };

test('times, signs and directions read as the terminal\'s do', () => {
  assert.equal(spanText(83.456 * SECOND, HZ), '1:23.456');
  assert.equal(spanText(-SECOND, HZ), '-0:01.000');
  assert.equal(signedText(-0.31 * SECOND, HZ), '\u22120.31');
  assert.equal(signedText(0.1 * SECOND, HZ), '+0.10');
  assert.equal(scoreText('race', 0, HZ), '--');
  assert.equal(scoreText('hill', 804, HZ), '13.4 s');
  const up = Math.PI / 2;
  assert.deepEqual([[1, 0, up], [0, 1, up], [-1, -1, up], [1, 0, 0], [0, 1, 2 * Math.PI]].map((way) => pointer(...way)), ['\u2192', '\u2191', '\u2199', '\u2191', '\u2190']);
});

test('medals are the author\'s time and 6, 20 and 50 per cent more', () => {
  assert.equal(medalOf(60000, 60 * SECOND, HZ), 'author');
  assert.equal(medalOf(60000, 63 * SECOND, HZ), 'gold');
  assert.equal(medalOf(60000, 91 * SECOND, HZ), '');
  assert.equal(medalToWin(60000, 0, HZ), 'bronze 1:30.00');
  assert.equal(medalToWin(60000, 60 * SECOND, HZ), 'all medals won');
});

test('a race tells lap, clock and the way to the next gate, and marks it', () => {
  const you = louse(7, { gate: 1, lap: 1, lap_start: 500 * 65536, score: 0 });
  const race = facts({ mode: 'race', rules: RACE, game: { phase: 'play', round: 1, until: 6600, table: [] }, you, lice: [you], id: 7, rank: 2 });
  assert.match(words(goalLines(race)), /race {2}1:40 left {2}gate 1 \u2197 14 m, fly through\nlap 2\/3 {2}0:01\.666 {2}#2\/1 {2}bronze 1:30\.00/);
  assert.deepEqual(marksOf(race).gates.map(({ state }) => state), ['passed', 'next']);
  assert.deepEqual(aim(race).at, [10, 10]);
});

test('forage points to the dearest crumb, of those the nearest, and shows no eaten ones', () => {
  const you = louse(7, { score: 12 });
  const forage = facts({ mode: 'forage', rules: { crumbs: 3 }, game: { phase: 'play', round: 2, until: 700, crumbs: [[0, 1, 0, 1], [1, 30, 0, 3], [2, 20, 0, 3], [3, 2, 0, 0]] }, you, lice: [you], id: 7 });
  assert.deepEqual(aim(forage).at, [20, 0]);
  assert.equal(marksOf(forage).crumbs.length, 3);
  assert.match(words(goalLines(forage)), /harvest \u00d72/);
});

test('a hill tells who holds it, and where it moves', () => {
  const rules = { hold_s: 60, places: [{ at: [0, 0], radius: 3 }, { at: [9, 0], radius: 2 }] };
  const hill = facts({ mode: 'hill', rules, game: { phase: 'play', round: 1, until: 9e4, place: 0, holder: 3, contested: false, moves_at: 900, table: [[3, 60]] }, id: 7 });
  assert.match(words(goalLines(hill)), /moves in 0:05/);
  assert.match(words(goalLines(hill)), /out: back at a spawn soon {2}louse 3 holds it/);
  assert.deepEqual([marksOf(hill).ring.state, marksOf(hill).ring.next.x], ['held', 9]);
});

test('rows rank by what the mode ranks by, ties as the server\'s table has them', () => {
  const lice = [louse(1, { score: 0, lap: 0, gate: 2, lap_start: 5 }), louse(2, { score: 90, lap: 0, gate: 0, lap_start: 0 }), louse(3, { score: 80, lap: 0, gate: 0, lap_start: 0 }), louse(4, { score: 0, lap: 0, gate: 0, lap_start: 0 })];
  const rows = scoreRows(facts({ mode: 'race', rules: RACE, game: { phase: 'play', table: [[3, 80], [2, 90]] }, lice }));
  assert.deepEqual(rows.map(({ id, rank }) => [id, rank]), [[3, 1], [2, 2], [1, 0], [4, 0]]);
  const ties = scoreRows(facts({ mode: 'forage', game: { phase: 'play', table: [[2, 5], [1, 5]] }, lice: [louse(1, { score: 5 }), louse(2, { score: 5 })] }));
  assert.deepEqual(ties.map(({ id }) => id), [2, 1]);
  assert.deepEqual(scoreRows(facts({ lice: [louse(1), louse(9)] })).map(({ id, measure }) => [id, measure]), [[9, '9 m'], [1, '1 m']]);
});

test('a podium has the best three that did something', () => {
  const steps = podium(facts({ mode: 'race', rules: RACE, game: { phase: 'podium', table: [[3, 62 * SECOND], [4, 0]] } }));
  assert.deepEqual(steps.map(({ name, medal }) => [name, medal]), [['louse 3', 'gold']]);
});

test('what happened is told in words, of gates only your own', () => {
  assert.equal(told({ kind: 'gate', id: 7, name: 'ann', gate: 2, lap: 0, split: 3 * SECOND, delta: -SECOND / 2 }, 7, HZ), 'gate 2 0:03.000 \u22120.50 s');
  assert.equal(told({ kind: 'gate', id: 8, name: 'bob', gate: 2, lap: 0, split: SECOND, delta: null }, 7, HZ), '');
  assert.equal(told({ kind: 'joined', id: 8, name: 'bob', role: 'bot' }, 7, HZ), 'bot bob joined');
  assert.equal(told({ kind: 'fell', id: 8, name: 'bob', by: 7 }, 7, HZ), 'you pushed bob off: +3 s');
  assert.equal(told({ kind: 'fell', id: 7, name: 'ann', by: 8 }, 7, HZ, () => 'bob', false), 'bob pushed you off');
  assert.equal(told({ kind: 'fell', id: 8, name: 'bob', by: 0 }, 7, HZ), 'bob fell off');
  assert.equal(told({ kind: 'something new', id: 8, name: 'bob' }, 7, HZ), '');
  assert.match(farewell({ code: 'banned', reason: 'until noon' }), /You are banned: until noon/);
});

test('a split flashes with its sign, a chain runs out', () => {
  const run = new OwnRun();
  run.event({ kind: 'gate', split: SECOND, delta: SECOND / 4 }, HZ, 10);
  assert.deepEqual([run.splash(11), run.splash(12.1)], [{ text: '+0.25', tone: 'bad' }, null]);
  run.event({ kind: 'crumb', value: 3, chain: 2, moment: 600 * 65536 }, HZ, 20);
  assert.equal(run.splash(20).text, '+3\u00d72');
  assert.deepEqual([run.chain(720, HZ), run.chainLeft(720, HZ), run.chain(845, HZ)], [2, 0.5, 0]);
});

test('a lesson goes on when something was really done', () => {
  assert.match(new Lesson(10, true).lines.join(), /move the stick/);
  const lesson = new Lesson(10);
  let now = 0;
  const see = (more, seconds) => { for (const end = now + seconds; now < end; now += 0.05) lesson.observe({ now, isPushing: false, heading: [1, 0], slope: 0, height: 0, speed: 0, ...more }); };
  see({}, 5);
  assert.equal(lesson.step, 'push');
  see({ isPushing: true, speed: 2 }, 1);
  assert.equal(lesson.step, 'turn');
  see({ heading: [0, 1] }, 0.2);
  assert.equal(lesson.step, 'swing');
  see({ isPushing: true, slope: -0.2, speed: 3, height: -2, heading: [0, 1] }, 1);
  see({ height: 0, heading: [0, 1] }, 0.2);
  assert.equal(lesson.step, 'praise');
  see({}, 5);
  assert.ok(lesson.isOver);
});
