// @ts-check
// What comes over the socket, checked at the edge: a message whose fields are not what docs/protocol.md says is none.

const whole = (v) => Number.isSafeInteger(v);
const number = (v) => typeof v === 'number' && Number.isFinite(v);
const text = (v) => typeof v === 'string' && v.length <= LONGEST_TEXT;
const flag = (v) => typeof v === 'boolean';
/** More of anything than this no server has, and no page could show. */
const MOST = 16384, MOST_OF_RULES = 2048, LONGEST_TEXT = 4096;
const listOf = (is, most = MOST) => (v) => Array.isArray(v) && v.length <= most && v.every(is);
const objectOf = (shape) => (v) => v !== null && typeof v === 'object' && !Array.isArray(v) &&
  Object.keys(shape).every((name) => name.endsWith('?') ? v[name.slice(0, -1)] === undefined || shape[name](v[name.slice(0, -1)]) : shape[name](v[name]));
const pair = (v) => Array.isArray(v) && v.length === 2 && v.every(number);
const any = (v) => v !== undefined;

const rows = listOf(listOf(number));
const game = objectOf({
  'phase?': text, 'round?': whole, 'until?': whole, 'table?': listOf((v) => Array.isArray(v) && v.length === 2 && v.every(whole)),
  'crumbs?': listOf((v) => Array.isArray(v) && v.length === 4 && v.every(number), MOST_OF_RULES),
  'place?': whole, 'holder?': whole, 'contested?': flag, 'moves_at?': whole,
});
const rules = objectOf({
  'gates?': listOf(objectOf({ a: pair, b: pair }), MOST_OF_RULES), 'places?': listOf(objectOf({ at: pair, 'radius?': number }), MOST_OF_RULES), 'laps?': whole, 'hold_s?': number, 'author_ms?': whole,
});
const rate = (v) => whole(v) && v >= 1 && v <= 1000;
const run = { board: text, name: text, time: whole, splits: listOf(whole) };
const said = { code: text, text };

const SHAPES = {
  hello: { protocol: whole, behavior: whole, rooms: listOf(text, MOST_OF_RULES), features: listOf(text), limits: objectOf({}), 'hosts?': listOf(text) },
  welcome: {
    id: whole, 'name?': text, 'resume_token?': text, 'resumed?': flag, room: text, mode: text, tick: whole, tick_hz: rate, state_hz: rate,
    fields: listOf(text), quantum: listOf(number), format: text, 'stream?': text,
    map: objectOf({ name: text, hash: text, extent: (v) => Array.isArray(v) && v.length === 4 && v.every(number) }),
    physics: objectOf({ gravity: number, thrust_max: number, edges: text }),
    players: listOf(objectOf({ id: whole, name: text, role: text })), 'spectators?': whole, 'rules?': rules,
  },
  key: { tick: whole, louse: rows, hash: text, 'game?': game },
  delta: { tick: whole, base: whole, louse: rows, 'gone?': listOf(whole), 'game?': game },
  ack: {
    seq: whole, tick: whole, margin_us: number, late: flag, dropped: flag,
    'you?': objectOf({
      tick: whole, id: whole, x: number, y: number, vx: number, vy: number, heading: pair, thrust: pair, thrust_kind: whole,
      thrust_ticks: whole, phase: whole, flight_z: number, flight_vz: number, distance: number,
    }),
  },
  event: { n: whole, tick: whole, kind: text, id: whole, name: text, 'text?': text, 'role?': text, 'moment?': whole },
  map: { name: text, hash: text, definition: objectOf({}), 'overview?': flag, 'knots?': objectOf({ origin: pair, spacing: pair, heights: any }) },
  records: { board: text, count: whole, rows: listOf(objectOf({ ...run, rank: whole })) },
  ghost: { ...run, start: whole, behavior: whole, tick_hz: whole, spawn: whole, ticks: whole, inputs: listOf(listOf(number), 100000) },
  rooms: { rooms: listOf(objectOf({ name: text, map: text, players: whole, bots: whole, spectators: whole, 'code?': text, 'address?': text }), MOST_OF_RULES) },
  notice: said,
  error: { ...said, fatal: flag, 'retry_after_ms?': number, 'address?': text },
  bye: { ...said, resumable: flag, 'address?': text },
  ping: { t: whole },
  pong: { t: whole },
};
const CHECKS = Object.fromEntries(Object.entries(SHAPES).map(([type, shape]) => [type, objectOf(shape)]));

/** Of a line. Null: of a type that a newer server may say, to be passed over. Throws an Error where it is no message.
 * @returns {any} */
export function decoded(line) {
  let message;
  try { message = JSON.parse(line); } catch { throw new Error('a line that is no JSON'); }
  if (message === null || typeof message !== 'object' || !text(message.type)) throw new Error('a line without a type');
  if (!Object.hasOwn(CHECKS, message.type)) return null;
  if (!CHECKS[message.type](message)) throw new Error(`a "${message.type}" with other fields`);
  return message;
}

/** Whether a line is one of a recording, of who watches by inputs: it has no `type`. */
export const isRecorded = (line) => !line.startsWith('{"type":');
