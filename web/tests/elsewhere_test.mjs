import assert from 'node:assert/strict';
import test, { afterEach } from 'node:test';
import { linkTo, movedTo, toldAddress } from '../page/live/elsewhere.js';
import { Door, Link } from '../page/live/link.js';
import { decoded } from '../page/live/messages.js';
import { factsOf, marksIn } from '../page/live/goal.js';
import { OwnGame } from '../page/live/own/own_game.js';
import { Room } from '../page/live/room.js';
import { told } from '../page/live/words.js';

const HELLO = { type: 'hello', protocol: 1, behavior: 10, server: 's', session: '1', rooms: ['hills', 'volcano'], features: [], limits: {}, hosts: ['10.0.0.6:7778'] };
const WELCOME = {
  type: 'welcome', id: 7, name: 'ann', resume_token: 'abc', resumed: false, room: 'hills', mode: 'roam', tick: 5, tick_hz: 60, state_hz: 20, fields: ['id'], quantum: [1],
  format: 'quantized', map: { name: 'hills', hash: '0123456789abcdef', extent: [-20, -20, 20, 20], bytes: 9 }, physics: { gravity: 9.81, thrust_max: 4, edges: 'walls' }, players: [],
};
const moved = (type, address) => ({ type, code: 'moved', text: 'there', address, ...(type === 'bye' ? { resumable: true } : { fatal: true }) });

/** As a WebSocket of the browser, without a network. */
class Wire {
  static all = [];
  constructor(url) { Object.assign(this, { url, readyState: 1, bufferedAmount: 0, sent: [] }); Wire.all.push(this); }
  send(text) { this.sent.push(JSON.parse(text)); }
  close() { this.readyState = 3; }
  say(...messages) { this.onmessage({ data: messages.map((message) => JSON.stringify(message) + '\n').join('') }); }
}

const links = [];
afterEach(() => links.splice(0).forEach((link) => link.stop()));  // a line that is waited for would keep the test alive

function linked() {
  const heard = [], lost = [];
  Wire.all = [];
  const link = new Link({ url: 'ws://farm.example:7778/ws', Socket: Wire, joinOf: () => ({ role: 'player', name: 'ann' }), on: (message) => heard.push(message), onRecorded: () => {},
                          onLost: (closing, again) => lost.push({ ...closing, again }) });
  links.push(link);
  link.start();
  return { link, heard, lost, wire: () => Wire.all.at(-1) };
}

test('an address is a host and a port, and nothing else', () => {
  for (const text of ['farm.example:7778', '10.0.0.6:7778', '[2001:db8::7]:7778', '[2001:DB8:0::7]:1', 'localhost:65535', 'Farm.example:80']) assert.equal(toldAddress(text), text);
  for (const text of ['', ':', 'host', 'host:', ':7778', 'host:0', 'host:65536', 'host:07778', 'host:7778 ', 'host:7778/x', 'http://host:1', 'javascript:alert(1)', 'user@host:1', '-h:1', 'a b:1',
                      'host:1?room=x', 'host:1#x', 'h\u00f6st:1', '::1:7778', '[::1]', '[host]:1', '[1::2::3]:1', '10.0.0.256:1', '10.0.0.06:1', '7:7778', '0x7f.1:1', `${'a'.repeat(300)}:1`, null, 7, ['host:1'], undefined])
    assert.equal(toldAddress(text), '', String(text));
});

test('a room that moves to another server ends the line, at once, with where it is', () => {
  for (const type of ['bye', 'error']) {
    const { link, heard, lost, wire } = linked();
    wire().say(HELLO, ...(type === 'bye' ? [WELCOME] : []), moved(type, '10.0.0.6:7778'));
    assert.deepEqual(lost, [{ code: 'moved', reason: 'the room is at 10.0.0.6:7778 now', address: '10.0.0.6:7778', again: null }]);
    assert.deepEqual([link.phase, wire().readyState, heard.at(-1).type], ['stopped', 3, type === 'bye' ? 'welcome' : 'hello']);
  }
});

test('a room that moves behind the same address is joined there again', (t) => {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  for (const address of ['farm.example:7778', 'FARM.example:7778', '', undefined]) {
    const { lost, wire } = linked();
    wire().say(HELLO, WELCOME, moved('bye', address));
    assert.deepEqual([lost.length, lost[0].reason, lost[0].address], [1, 'the room is moving', undefined]);
    assert.ok(lost[0].again > 0 && lost[0].again <= 0.375);
    t.mock.timers.tick(400);
    assert.equal(Wire.all.length, 2);
    assert.equal(wire().url, 'ws://farm.example:7778/ws');
  }
});

test('what is no address is said to be none, and this server is asked again, later and later', (t) => {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  const { lost, wire } = linked();
  for (let k = 0; k < 6; k++) {
    wire().say(HELLO, moved('error', 'javascript:alert(1)//:1'));
    assert.equal(lost.at(-1).reason, 'the room has moved to "javascript:alert(1)//:1", which is no address');
    assert.ok(lost.at(-1).again > 0);
    t.mock.timers.tick(lost.at(-1).again * 1000 + 1);
  }
  assert.ok(lost.at(-1).again >= 4);
  assert.equal(Wire.all.length, 7);
});

test('a link leads to the page of the same room, by the scheme of this page', () => {
  assert.equal(linkTo('10.0.0.6:7779', 'crater_loop/race', 'https://farm.example:7778/?room=x&play&name=ann#louse=eve'), 'https://10.0.0.6:7779/?room=crater_loop%2Frace');
  assert.equal(linkTo('[2001:db8::7]:7778', '', 'http://user:word@farm.example/deep/page'), 'http://[2001:db8::7]:7778/');
  assert.equal(linkTo('other.example:80', 'a&b', 'http://farm.example:7778/'), 'http://other.example/?room=a%26b');
  assert.equal(movedTo({ code: 'moved', text: '', address: '10.0.0.6:1' }, 'ws://x/ws').address, '10.0.0.6:1');
});

test('a door asks for the room it was in, also where the server does not name it, and for another where there is none', () => {
  const door = new Door({ role: 'spectator', name: 'eve', room: '', token: '' }, 10);
  assert.equal(door.joinOf(HELLO).room, 'hills');
  door.room = 'volcano';
  assert.equal(door.joinOf({ ...HELLO, rooms: ['hills'] }).room, 'volcano');
  assert.equal(door.refused({ code: 'unknown_room', fatal: false }), 'again');
  assert.equal(door.joinOf({ ...HELLO, rooms: ['hills'] }).room, 'hills');
});

test('a room says where it is, keeps its token and its name, and asks this server again only when a person wants it', () => {
  Wire.all = [];
  const notices = [], wish = { role: 'player', name: 'ann', room: '', token: '' };
  const room = new Room({ url: 'wss://farm.example/ws', core: { behavior: 10 }, wish, parts: { factsOf, marksIn, OwnGame, told }, storage: null, onNotice: (text) => notices.push(text), onTokenWanted: () => assert.fail(), Socket: Wire });
  try {
    room.start();
    Wire.all[0].say(HELLO, WELCOME, moved('bye', '10.0.0.6:7778'));
    assert.deepEqual(room.lost, { reason: 'the room is at 10.0.0.6:7778 now', code: 'moved', again: null, address: '10.0.0.6:7778' });
    assert.deepEqual([room.phase, room.welcome, room.shown.room, notices, Wire.all.length], ['stopped', null, 'hills', [], 1]);
    room.start();
    Wire.all[1].say({ ...HELLO, rooms: ['volcano'] });
    const { room: asked, resume, role, name } = Wire.all[1].sent[0];
    assert.deepEqual({ asked, resume, role, name }, { asked: 'hills', resume: 'abc', role: 'player', name: 'ann' });
    Wire.all[1].say({ ...WELCOME, resumed: true });
    assert.equal(room.lost, null);
  } finally { room.stop(); }
});

test('hosts and addresses of another kind are no message', () => {
  assert.deepEqual(decoded(JSON.stringify(HELLO)).hosts, ['10.0.0.6:7778']);
  for (const wrong of [{ ...HELLO, hosts: 'x' }, { ...HELLO, hosts: [7] }, { ...moved('bye', 7) }, { ...moved('error', []) }]) assert.throws(() => decoded(JSON.stringify(wrong)), /other fields/);
});

test('a room is told with its code and, where it is at another server, its address', () => {
  const rooms = (room) => decoded(JSON.stringify({ type: 'rooms', rooms: [{ name: 'hills', map: 'hills', players: 1, bots: 0, spectators: 0, ...room }] }));
  assert.equal(rooms({ code: 'BXDRM', address: '10.0.0.6:7777' }).rooms[0].address, '10.0.0.6:7777');
  assert.equal(rooms({}).rooms[0].code, undefined);  // a former server tells none
  assert.throws(() => rooms({ address: 7777 }));
  assert.throws(() => rooms({ code: null }));
});
