// @ts-check
// The line to the server over its breaks: one WebSocket after another. Joins once the server has said hello, watches for
// silence, comes back with backoff and jitter, and with the token of the louse that it had. And the door: how the page asks to
// come in, and what is to be done where it is refused.
import { decoded, isRecorded } from './messages.js';
import { COLUMNS, RULES_COLUMNS } from './frames.js';
import { movedTo } from './elsewhere.js';

const PROTOCOL = 1;
const GREET = 5, SILENCE = 5;                  // s until hello and welcome; without a word on a line that is open
const FIRST_WAIT = 0.25, LONGEST_WAIT = 8;     // s, between attempts
const MOST_UNSENT = 1 << 18, MOST_READ = 1 << 26;  // bytes; of one message

/** Ends that pass by themselves: trying again is worth it. */
const PASSING = ['', 'rate_limited', 'too_many_connections', 'handshake_timeout', 'idle', 'slow', 'left', 'shutdown', 'draining', 'paused', 'room_full', 'moved'];

/** How long to wait before the n-th attempt (from 0) [s]; chance: 0 to 1. */
export function waitBefore(n, chance) { return Math.min(LONGEST_WAIT, FIRST_WAIT * 2 ** n) * (0.5 + chance); }

/** @typedef {{code: string, reason: string, address?: string}} Closing code: of a `bye` or a fatal error; empty: the line broke. address: of another server that has the room now */

export class Link {
  #timer = 0; #watch = 0; #attempt = 0;
  /** @type {any} */ #socket = null;
  /** @type {Closing|null} */ #farewell = null; #hello = null; #joined = false;

  /**
   * @param {{url: string, joinOf: (hello: any) => any, on: (message: any, line: string) => void, onRecorded: (line: string) => void,
   *   onBatch?: () => void, onLost: (closing: Closing, again: number|null) => void, Socket?: any}} options
   *   joinOf: the join for a server that said this hello; null: not before joinAgain(). onBatch: after all lines of a message. onLost: the line
   *   is cut; again: seconds until it is tried again, null: it is over.
   */
  constructor(options) {
    this.options = options;
    /** @type {'connecting'|'joined'|'waiting'|'stopped'} */
    this.phase = 'stopped';
  }

  start() {
    this.stop();
    this.phase = 'connecting';
    this.#farewell = this.#hello = null;
    this.#joined = false;
    const { Socket = WebSocket, url } = this.options;
    const socket = this.#socket = new Socket(url);
    const isMine = (then) => (event) => { if (this.#socket === socket) then(event); };
    this.#expect(GREET, 'no server answers there');
    socket.onmessage = isMine((event) => this.#read(event.data));
    socket.onclose = isMine(() => this.#end(this.#farewell ?? { code: '', reason: this.#joined ? 'the connection broke' : 'the server can\'t be reached' }));
  }

  /** Says good-bye, if it can, and ends the line without a report. */
  stop() {
    clearTimeout(this.#timer);
    clearTimeout(this.#watch);
    const socket = this.#socket;
    this.#socket = null;
    this.phase = 'stopped';
    if (!socket) return;
    if (this.#joined && socket.readyState === 1) socket.send('{"type":"leave"}');
    socket.close();
  }

  /** Ends it without a good-bye, so that the louse waits, and joins anew at once. */
  rejoin() {
    this.#joined = false;
    this.start();
  }

  send(message) {
    if (!this.#joined || this.#socket?.readyState !== 1) return;
    if (this.#socket.bufferedAmount > MOST_UNSENT) return this.#end({ code: '', reason: 'the server takes nothing any more' });
    this.#socket.send(JSON.stringify(message));
  }

  /** Says join again on the same line, as another token or room wants it. */
  joinAgain() { if (this.#hello && !this.#joined) this.#join(); }

  #join() {
    const join = this.options.joinOf(this.#hello);
    if (!join) return this.hold();
    if (this.#socket?.readyState !== 1) return;
    this.#socket.send(JSON.stringify({ type: 'join', protocol: PROTOCOL, ...join }));
    this.#expect(GREET, 'no welcome comes');
  }

  #read(data) {
    if (typeof data !== 'string') return this.#end({ code: 'no_server', reason: 'no woodlouse server answers there' });
    if (data.length > MOST_READ) return this.#end({ code: 'no_server', reason: 'the server says too much at once' });
    const socket = this.#socket;
    for (const line of data.split('\n')) {
      if (line === '') continue;
      if (this.#joined && isRecorded(line)) this.options.onRecorded(line); else this.#take(line);
      if (this.#socket !== socket) return;
    }
    if (this.#joined) this.#expect(SILENCE, 'the server has fallen silent');
    this.options.onBatch?.();
  }

  #take(line) {
    let message;
    try { message = decoded(line); } catch (error) {
      return this.#end({ code: 'no_server', reason: `no woodlouse server answers there: ${/** @type {Error} */ (error).message}` });
    }
    if (!message) return;
    if (message.type === 'hello') {
      if (message.protocol !== PROTOCOL) return this.#end({ code: 'bad_protocol', reason: `the server speaks protocol ${message.protocol}, this page ${PROTOCOL}` });
      this.#hello = message;
    }
    if (message.type === 'welcome') {
      this.#joined = true;
      this.#attempt = 0;
      this.phase = 'joined';
    }
    if (message.code === 'moved' && (message.type === 'error' || message.type === 'bye')) return this.#end(movedTo(message, this.options.url));
    if ((message.type === 'error' && message.fatal) || message.type === 'bye') this.#farewell ??= { code: message.code, reason: message.text };
    this.options.on(message, line);
    if (message.type === 'hello') this.#join();
    // Without a fatal word, before the welcome: it passes, or the room's door (joinOf) finds another way on this line.
    if (message.type === 'error' && !this.#joined && PASSING.includes(message.code)) this.#end({ code: message.code, reason: message.text }, (message.retry_after_ms ?? 3000) / 1000);
  }

  #expect(seconds, reason) {
    clearTimeout(this.#watch);
    this.#watch = setTimeout(() => this.#end({ code: '', reason }), seconds * 1000);
  }
  /** Ends it for this reason, and tries no more. */
  giveUp(closing) { this.#end(closing); }
  /** Nothing is due: a person is asked something, or the core is still to come. */
  hold() { clearTimeout(this.#watch); }

  #end(closing, least = 0) {
    const socket = this.#socket;
    this.#socket = null;
    this.#joined = false;
    clearTimeout(this.#watch);
    socket?.close();
    let again = null;
    if (PASSING.includes(closing.code) && !closing.address) {
      again = Math.max(least, waitBefore(this.#attempt++, Math.random()));
      this.phase = 'waiting';
      this.#timer = setTimeout(() => this.start(), again * 1000);
    } else this.phase = 'stopped';
    this.options.onLost(closing, again);
  }
}

const PLAYER_HZ = 20, WATCHER_HZ = 10, STREAM_HZ = 20, HIDDEN_HZ = 1;

/** @typedef {{role: 'player'|'spectator', name: string, room: string, token: string, resume?: string}} Wish token: a password; resume: of a louse that waits */

export class Door {
  #byFrames = false; #halves = 0;
  /** The token of the louse that waits; '' none. */ resume = '';
  /** The one that was joined last. */ room = '';
  /** Nobody looks at the page. */ isHidden = false;
  /** The map is too big for the page to know its heights. */ wantsHeights = false;
  /** The server's behavior; null before its hello. @type {number|null} */ behavior = null;
  features = [];
  /** @type {string[]} */ rooms = [];

  /** @param {Wish} wish @param {number|null} ownBehavior of the page's core; null: it is still to come */
  constructor(wish, ownBehavior) {
    this.wish = wish;
    this.resume = wish.resume ?? '';
    this.ownBehavior = ownBehavior;
  }

  /** Whether what the page computes is what the server does. */
  get isSame() { return this.behavior === this.ownBehavior; }
  has(feature) { return this.features.includes(feature); }
  get isByInputs() { return this.wish.role === 'spectator' && !this.#byFrames && this.isSame && this.has('inputs'); }
  /** From now on: the stream differs from what is re-run here, or the room can't be watched so. */
  watchByFrames() { this.#byFrames = true; }
  /** Half as many frames would do; false: there are few already. */
  halve() {
    if (this.#halves === 4) return false;
    this.#halves++;
    return true;
  }

  /** The join for a server that said this hello; null while it is not known what the page itself computes by. */
  joinOf(hello) {
    if (this.ownBehavior === null) return null;
    ({ behavior: this.behavior, features: this.features, rooms: this.rooms } = hello);
    const { role, name, token } = this.wish, isPlayer = role === 'player';
    const room = this.room || this.wish.room || (hello.rooms[0] ?? '');  // one that is not among them may be elsewhere
    const hz = isPlayer ? PLAYER_HZ : this.isByInputs ? STREAM_HZ : WATCHER_HZ;
    const fields = [...COLUMNS, ...(this.wantsHeights ? ['z'] : []), ...(this.has('rules') ? RULES_COLUMNS : [])];
    return {
      role, name, room, fields, state_hz: this.isHidden ? HIDDEN_HZ : Math.max(1, hz >> this.#halves),
      ...(isPlayer ? { resume: this.resume || true } : {}), ...(token ? { token } : {}), ...(this.isByInputs ? { stream: 'inputs' } : {}),
    };
  }

  /** A refusal before the welcome. @returns {'again'|'token'|'wait'|'over'} say join again at once, ask for a password, wait, give up */
  refused(error) {
    if (error.code === 'bad_field' && this.isByInputs) { this.watchByFrames(); return 'again'; }
    if (error.code === 'bad_token') return 'token';
    if (error.code === 'unknown_room') { this.room = this.wish.room = ''; return 'again'; }
    return error.fatal || ['bad_field', 'bad_json', 'missing_field'].includes(error.code) ? 'over' : 'wait';
  }
}
