import assert from 'node:assert/strict';
import test, { afterEach } from 'node:test';
import { Door, Link, waitBefore } from '../page/live/link.js';
import { decoded, isRecorded } from '../page/live/messages.js';
import { Room } from '../page/live/room.js';

const HELLO = { type: 'hello', protocol: 1, behavior: 10, server: 's', session: '1', rooms: ['hills', 'volcano'], features: ['rules', 'inputs'], limits: {} };
const WELCOME = {
  type: 'welcome', id: 7, name: 'ann', resume_token: 'abc', resumed: false, room: 'hills', mode: 'roam', tick: 5, tick_hz: 60, state_hz: 20, fields: ['id'], quantum: [1],
  format: 'quantized', map: { name: 'hills', hash: '0123456789abcdef', extent: [-20, -20, 20, 20], bytes: 9 }, physics: { gravity: 9.81, thrust_max: 4, edges: 'walls' }, players: [],
};

/** As a WebSocket of the browser, without a network. */
class Wire {
  static all = [];
  constructor(url) { Object.assign(this, { url, readyState: 1, bufferedAmount: 0, sent: [] }); Wire.all.push(this); }
  send(text) { this.sent.push(JSON.parse(text)); }
  close() { this.readyState = 3; }
  say(...messages) { this.onmessage({ data: messages.map((m) => (typeof m === 'string' ? m : JSON.stringify(m)) + '\n').join('') }); }
}

const links = [];
afterEach(() => links.splice(0).forEach((link) => link.stop()));  // a line that is waited for would keep the test alive

function linked(more = {}) {
  const heard = [], lost = [], recorded = [];
  Wire.all = [];
  const link = new Link({ url: 'ws://x/ws', Socket: Wire, joinOf: () => ({ role: 'player', name: 'ann' }), on: (message) => heard.push(message), onRecorded: (line) => recorded.push(line),
                          onLost: (closing, again) => lost.push({ ...closing, again }), ...more });
  links.push(link);
  link.start();
  return { link, heard, lost, recorded, wire: () => Wire.all.at(-1) };
}

test('the page joins once the server has said hello, and says nothing before its welcome', () => {
  const { link, wire } = linked();
  link.send({ type: 'chat', text: 'early' });
  assert.deepEqual(wire().sent, []);
  wire().say(HELLO);
  assert.deepEqual(wire().sent, [{ type: 'join', protocol: 1, role: 'player', name: 'ann' }]);
  wire().say(WELCOME);
  link.send({ type: 'chat', text: 'hi' });
  assert.deepEqual(wire().sent.at(-1), { type: 'chat', text: 'hi' });
  link.stop();
  assert.deepEqual(wire().sent.at(-1), { type: 'leave' });
});

test('a line that breaks is tried again, later and later, and never by all at once', (t) => {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  const { lost, wire } = linked();
  const waits = [];
  for (let k = 0; k < 8; k++) {
    const before = Wire.all.length;
    wire().onclose({});
    waits.push(lost.at(-1).again);
    t.mock.timers.tick(lost.at(-1).again * 1000 + 1);
    assert.equal(Wire.all.length, before + 1);
  }
  assert.ok(waits[0] <= 0.375 && waits[7] >= 4 && waits[7] <= 12, waits.join());
  assert.ok(waitBefore(3, 0) < waitBefore(3, 1));
});

test('who was sent out, banned or replaced does not come back by itself', () => {
  for (const code of ['kicked', 'banned', 'replaced', 'flood', 'bad_protocol']) {
    const { link, lost, wire } = linked();
    wire().say(HELLO, WELCOME, { type: 'bye', code, text: 'because', resumable: false });
    wire().onclose({});
    assert.deepEqual([lost[0].code, lost[0].again, link.phase], [code, null, 'stopped']);
  }
  const { lost, wire } = linked();
  wire().say(HELLO, WELCOME, { type: 'bye', code: 'shutdown', text: 'the server stops', resumable: false });
  wire().onclose({});
  assert.ok(lost[0].again > 0);
});

test('a full room is tried again when the server says so', () => {
  const { lost, wire } = linked();
  wire().say(HELLO, { type: 'error', code: 'room_full', text: 'full', fatal: false, retry_after_ms: 7000 });
  assert.ok(lost[0].again >= 7);
});

test('an open line that says nothing for five seconds is a broken one', (t) => {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  const { lost, wire } = linked();
  wire().say(HELLO, WELCOME);
  t.mock.timers.tick(4900);
  wire().say({ type: 'pong', t: 1 });
  t.mock.timers.tick(4900);
  assert.equal(lost.length, 0);
  t.mock.timers.tick(200);
  assert.equal(lost[0].reason, 'the server has fallen silent');
});

test('what is no message of the protocol ends the line with words, a newer type is passed over', () => {
  for (const line of ['nonsense', '{"type":"key","tick":"x","louse":[]}', '[1]', '{"type":"key","tick":1,"hash":"a","louse":[[1,null]]}', '{"type":"event","n":1,"tick":1,"kind":"chat","id":1}']) {
    const { lost, wire } = linked();
    wire().say(HELLO, WELCOME, line.startsWith('{"type"') ? line : JSON.stringify({ type: 'hello' }));
    assert.match(lost[0].reason, /no woodlouse server/);
  }
  for (const wrong of [{ tick_hz: 1e9 }, { state_hz: 0 }, { rules: { gates: [1] } }, { rules: { places: [{ at: [1, null] }] } }, { players: [{ id: 1, name: 2, role: 'bot' }] }])
    assert.throws(() => decoded(JSON.stringify({ ...WELCOME, ...wrong })), /other fields/, JSON.stringify(wrong));
  assert.equal(decoded('{"type":"fireworks"}'), null);
  assert.throws(() => decoded('nonsense'), /no JSON/);
  assert.throws(() => decoded('{"type":"__proto__"}') ?? assert.fail('null'));
});

test('a page that does not know yet what it computes by joins when it does', (t) => {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  const door = new Door({ role: 'spectator', name: 'eve', room: 'volcano', token: '' }, null);
  const { link, lost, wire } = linked({ joinOf: (hello) => door.joinOf(hello) });
  wire().say(HELLO);
  t.mock.timers.tick(9000);
  assert.deepEqual([wire().sent, lost], [[], []]);
  door.ownBehavior = 10;
  link.joinAgain();
  assert.deepEqual(wire().sent.map(({ type, stream }) => [type, stream]), [['join', 'inputs']]);
});

test('lines of a recording are told from messages', () => {
  const { recorded, wire } = linked();
  wire().say(HELLO, { ...WELCOME, stream: 'inputs' }, '{"keyframe":812,"hash":"x"}');
  assert.deepEqual(recorded, ['{"keyframe":812,"hash":"x"}']);
  assert.ok(!isRecorded('{"type":"event"}'));
});

test('a door asks for inputs where it can compute as the server does, else for frames, and finds another way where it is refused', () => {
  const door = new Door({ role: 'spectator', name: 'eve', room: 'volcano', token: '' }, 10);
  assert.equal(door.joinOf(HELLO).stream, 'inputs');
  assert.equal(door.joinOf(HELLO).room, 'volcano');
  assert.equal(door.refused({ code: 'bad_field', fatal: false }), 'again');
  assert.equal(door.joinOf(HELLO).stream, undefined);
  assert.equal(door.joinOf({ ...HELLO, rooms: ['other'] }).room, 'volcano');  // it may be at another server
  assert.equal(door.refused({ code: 'unknown_room', fatal: false }), 'again');
  assert.equal(door.joinOf({ ...HELLO, rooms: ['other'] }).room, 'other');
  assert.equal(new Door({ role: 'spectator', name: 'eve', room: '', token: '' }, 9).joinOf(HELLO).stream, undefined);
  assert.equal(door.refused({ code: 'bad_token', fatal: false }), 'token');
  door.isHidden = true;
  assert.equal(door.joinOf(HELLO).state_hz, 1);
  door.isHidden = false;
  const hz = door.joinOf(HELLO).state_hz;
  assert.ok(door.halve() && door.joinOf(HELLO).state_hz === hz / 2);
});

test('more than a page can show is no message', () => {
  const key = (rows) => JSON.stringify({ type: 'key', tick: 1, hash: '0', louse: Array.from({ length: rows }, (_, k) => [k + 1, 0]) });
  assert.equal(decoded(key(1000)).louse.length, 1000);
  assert.throws(() => decoded(key(20000)), /other fields/);
  const game = (crumbs) => JSON.stringify({ type: 'key', tick: 1, hash: '0', louse: [], game: { crumbs: Array.from({ length: crumbs }, (_, k) => [k, 0, 0, 1]) } });
  assert.equal(decoded(game(64)).game.crumbs.length, 64);
  assert.throws(() => decoded(game(5000)), /other fields/);
  assert.throws(() => decoded(JSON.stringify({ type: 'notice', code: 'x', text: 'x'.repeat(5000) })), /other fields/);
});

test('who watches by inputs is shown a room by its keyframe alone, whatever its tick: the next line is not waited for', (t) => {
  for (const tick of [811, 812, 813]) {
    Wire.all = [];
    const louse = { id: 3, phase: 0, x: 1, y: 2, vx: 0, vy: 0, heading_x: 1, heading_y: 0 }, ground = { domain: [-9, -9, 9, 9], wraps: [false, false], isExact: true, hash: WELCOME.map.hash };
    const follower = { tick: -1, proven: 0, take() { this.tick = tick; return true; }, beginAnew() {}, ground: () => ground, lice: () => [louse], standings: () => [], game: () => null };
    const room = new Room({ url: 'ws://x/ws', core: { behavior: 10, follower: () => follower }, wish: { role: 'spectator', name: 'eve', room: '', token: '' }, parts: null, storage: null,
                            onNotice: () => {}, onTokenWanted: () => assert.fail(), Socket: Wire });
    t.after(() => room.stop());
    room.start();
    Wire.all[0].say(HELLO);
    Wire.all[0].say({ ...WELCOME, id: 0, stream: 'inputs' }, `{"keyframe":${tick},"hash":"x"}`);
    room.update(performance.now() / 1000);
    assert.equal(room.isKnown, true, `tick ${tick}`);
    assert.deepEqual(room.lice.map(({ id, x, y }) => [id, x, y]), [[3, 1, 2]]);
    assert.equal(room.ground, ground);
  }
});
