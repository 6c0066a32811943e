// @ts-check
// Everything the page knows of the room it is in: what the server said, merged and timed; your louse, and what is to be
// drawn now. No DOM.
import { Door, Link } from './link.js';
import { Pings, SILENCE } from './word.js';
import { Roster } from './roster.js';
import { Stream } from './stream.js';
import { Timeline } from './timeline.js';
import { Ways } from './ways.js';

const COUNT_EVERY = 10, ACT_EVERY = 40;  // s, ms
/* before the first welcome */ const NOTHING = { tick_hz: 60, state_hz: 10, fields: [], quantum: [] };

const seconds = () => performance.now() / 1000;

/** What whoever only looks does without at first. @typedef {Pick<typeof import('./own/own_game.js') & typeof import('./goal.js') & typeof import('./words.js'), 'OwnGame' | 'factsOf' | 'marksIn' | 'told'>} Parts */

export class Room {
  /** What comes after the first picture; null before. @type {Parts|null} */ #parts = null; /** null: it is still to come. @type {any} */ #core; #link; /* maps that were sent, by hash and rate */ #grounds = new Map(); #time = new Timeline(NOTHING, 0); #pings = new Pings(); #countedAt = -Infinity; #was = false; #acting = setInterval(() => this.#act(seconds()), ACT_EVERY);  // a page with few pictures a second steers as well

  /** @param {{url: string, core: any, wish: import('./link.js').Wish, parts: Parts|null, storage: Storage|null, onNotice: (text: string, tone?: string) => void,
   *   onTokenWanted: (why: string) => void, Socket?: any}} options core: null: nobody joins before setCore(). parts: null: nobody plays before setParts(). onTokenWanted: ask a person, then enter(token) */
  constructor({ url, core, wish, parts, storage, onNotice, onTokenWanted, Socket }) {
    this.#core = core;
    this.door = new Door(wish, core?.behavior ?? null);
    this.onNotice = onNotice, this.onTokenWanted = onTokenWanted;
    /** null before setParts(). @type {import('./own/own_game.js').OwnGame} */ this.own = /** @type {any} */ (null), this.storage = storage;
    this.roster = new Roster();
    if (parts) this.#take(parts);
    this.ways = new Ways();
    /** What is re-run here, of who watches by inputs. @type {Stream|null} */ this.stream = null;
    /** The `welcome` of the game that is on; null while there is none. @type {any} */ this.welcome = null;
    /** The last one: what it said is shown on while the line is cut. @type {any} */ this.shown = null;
    /** The map's ground (core.js), or null. @type {any} */ this.ground = null;
    /** As of the last update. @type {any[]} */ this.lice = []; /** Whether it was told yet who there is. */ this.isKnown = false;
    /** The table of scores, as it was made last. @type {ReturnType<import('./goal.js').scoreRows>} */ this.rows = [];
    /** The rooms with their counts. @type {any[]} */ this.rooms = [];
    /** Why the line is down, when it is tried again [s, of performance.now()], and at which other server the room is; null while it is up. @type {{reason: string, code: string, again: number|null, address: string}|null} */ this.lost = null;
    this.#link = new Link({
      url, Socket, joinOf: (hello) => (this.#isWhole ? this.door.joinOf(hello) : null), on: (message, line) => this.#on(message, line, seconds()),
      onRecorded: (line) => this.#follow(line, seconds()), onBatch: () => this.#afterBatch(seconds()), onLost: (closing, again) => this.#onLost(closing, again),
    });
  }

  start() { this.#link.start(); }
  /** The core that joining waited for. */
  setCore(core) { [this.#core, this.door.ownBehavior] = [core, core.behavior]; this.#link.joinAgain(); }
  /** What playing waited for. @param {Parts} parts */
  setParts(parts) { this.#take(parts); this.#link.joinAgain(); }
  #take(parts) { [this.#parts, this.own] = [parts, new parts.OwnGame(this.storage, (message) => this.send(message))]; this.roster.setWords(parts.told); }
  get #isWhole() { return !!this.#core && (!!this.own || this.door.wish.role !== 'player'); }
  stop() { clearInterval(this.#acting); this.#link.stop(); }
  send(message) { this.#link.send(message); }
  get phase() { return this.#link.phase; }
  get hz() { return this.#time.hz; }
  /* the server's, as of the last update */ get tick() { return this.#time.tick; }
  /** No tick passes, and not because a machine is busy: the room is paused. */
  get stands() { return this.#time.word.stoodFor(seconds()) > SILENCE; }
  get you() { return this.shown?.id ?? 0; }
  get mode() { return this.shown?.mode ?? 'roam'; }
  get game() { return this.#time.game; }
  /** The shortest of the last round trips [s]; null: none yet. */
  get trip() { return this.#pings.trip; }
  get behavior() { return this.#core.behavior; }
  /** Seconds without a word of the server's, when they are too many; else null. */
  get silence() { return this.welcome ? this.#time.word.silence(seconds()) : null; }

  /** With a password, after onTokenWanted(). */
  enter(token) { this.door.wish.token = token; this.#link.joinAgain(); }

  /** Chat; `/skip` is a vote for the room's next game. */
  say(text) { this.send(text.trim() === '/skip' ? { type: 'skip' } : { type: 'chat', text }); }

  /** Nobody looks at the page, or somebody does again: another rate, on a new line. */
  hide(isHidden) {
    if (this.door.isHidden === isHidden) return;
    this.door.isHidden = isHidden;
    this.own?.steering.releaseAll();
    if (this.phase === 'joined') this.#rejoin();
  }

  /** Runs on to now [s]: what is said and done, what is drawn. */
  update(now) {
    this.#act(now);
    if (!this.welcome || !this.#time.isKnown(now)) return;  // what was seen last stays until there is something newer
    [this.isKnown, this.lice] = [true, this.#time.lice(now, this.ways)];
    this.#placeOwn();
  }

  #act(now) {
    if (!this.welcome) return;
    const time = this.#time, ping = this.#pings.due(now, time.word.isLate(now) && !time.word.stands);
    if (ping) this.send(ping);
    if (now - this.#countedAt >= COUNT_EVERY) {
      this.#countedAt = now;
      this.send({ type: 'list', watch: true });
    }
    const input = time.isKnown(now) && !this.door.isHidden ? this.own?.pilot?.update(now, time.clock) : null;
    if (input) this.send(input);
  }

  nameOf(id) { return this.roster.nameOf(id); }
  isBot(id) { return this.roster.isBot(id); }
  /** For goal.js: of the louse `id`; 0: nobody's. null: that is still to come. */
  facts(id) { return this.#parts?.factsOf(this, id) ?? null; }
  marks(facts) { return this.#parts?.marksIn(this, facts) ?? null; }
  louse(id) { return this.lice.find((louse) => louse.id === id) ?? null; }

  #placeOwn() {
    const own = this.own?.pilot?.louse, newest = own && this.#time.newest?.lice.get(own.id);
    if (newest) {  // what the rules say of it only the server knows
      const louse = { ...newest, ...own, z: undefined }, k = this.lice.findIndex(({ id }) => id === own.id);
      if (k >= 0) this.lice[k] = louse; else this.lice.push(louse);
    }
    const you = this.louse(this.you);
    if (you) this.own?.run.observe(you);
  }

  #on(message, line, now) {
    this.#time.word.heard(now);
    switch (message.type) {
      case 'welcome': return this.#welcome(message, now);
      case 'key': case 'delta': return this.#frame(message, now);
      case 'map': return this.#map(line);
      case 'event':
        this.roster.event(message, this.you, this.hz, this.game?.phase === 'play');
        if (this.welcome) this.own?.event(message, this.welcome, now);
        return;
      case 'ack': return this.own?.pilot?.acknowledge(message);
      case 'ping': return this.send({ type: 'pong', t: message.t });
      case 'pong': return this.#pong(message, now);
      case 'rooms':
        this.rooms = message.rooms;
        this.roster.spectators = message.rooms.find(({ name }) => name === this.welcome?.room)?.spectators ?? this.roster.spectators;
        return;
      case 'ghost': return this.own?.ghosts.addRecord(message);
      case 'notice':
        if (message.code === 'paused') this.#time.word.paused();
        this.roster.note(message.text);
        return this.onNotice(message.text);
      case 'error': return this.#error(message);
    }
  }

  #error(error) {
    if (error.code === 'no_records') return;  // nobody else has asked for them
    if (this.phase === 'joined' || error.fatal) return this.onNotice(error.text, 'bad');
    const next = this.door.refused(error);
    if (next === 'again') return this.#link.joinAgain();
    if (next === 'token') {
      this.#link.hold();
      return this.onTokenWanted(this.door.wish.token ? 'That is no password of this server.' : 'Who comes in here has a password.');
    }
    this.onNotice(error.text, 'bad');
    if (next === 'over') this.#link.giveUp({ code: error.code, reason: error.text });
  }

  #welcome(welcome, now) {
    if (this.welcome) this.onNotice(`now: ${welcome.mode} on ${welcome.map.name}`);  // another game, on the same connection
    else if (this.#was && !this.door.isHidden) this.onNotice(welcome.id === 0 ? 'watching again' : welcome.resumed ? 'back in your louse' : 'your louse is gone: this is a new one');
    this.own?.end(!this.welcome);
    if (this.welcome) this.lice = [];
    this.#was = true;
    this.lost = null;
    [this.door.room, this.door.resume] = [welcome.room, welcome.resume_token || this.door.resume];
    this.welcome = this.shown = welcome;
    this.roster.welcome(welcome);
    this.#time = new Timeline(welcome, now);
    this.#pings = new Pings();
    this.#countedAt = -Infinity;
    if (welcome.stream === 'inputs') {
      this.stream ??= new Stream(this.#core);
      return this.stream.begin(welcome.tick_hz, welcome.state_hz);
    }
    const known = this.#grounds.get(this.#mapKey);
    if (known) this.#begin(known); else this.send({ type: 'get_map' });
  }

  get #mapKey() { return `${this.welcome.map.hash} ${this.hz}`; }

  #map(line) {
    if (!this.welcome) return;
    let ground; try { ground = this.#core.openMapLine(line, this.hz); } catch (error) { return this.onNotice(`the server's map can't be read: ${/** @type {Error} */ (error).message}`, 'bad'); }
    this.#grounds.set(this.#mapKey, ground);
    if (ground.isExact && ground.hash !== this.welcome.map.hash) this.onNotice('the server has another map: nothing is predicted', 'bad');
    if (ground.isExact || this.door.wantsHeights) return this.#begin(ground);
    this.door.wantsHeights = true;  // the server knows how high the lice are
    this.#rejoin();
  }

  #begin(ground) {
    this.ground = ground;
    this.ways = new Ways(ground.domain, ground.wraps);
    const isSame = this.door.isSame && ground.isExact && ground.hash === this.welcome.map.hash;
    this.own?.begin(this.welcome, ground, this.ways, { behavior: this.#core.behavior, isSame, hasRecords: this.door.has('records') });
  }

  #frame(frame, now) {
    if (!this.welcome) return;
    const time = this.#time;
    this.#observe(frame.tick, now);
    if (time !== this.#time || !this.welcome) return;
    const merged = time.merge(frame, now);
    if (merged === 'unreadable') return this.onNotice('the server sends other columns than asked for', 'bad');
    if (merged === 'resync') this.send({ type: 'resync' });
    const row = merged === 'taken' ? time.newest.lice.get(this.you) : null;
    if (row) this.own?.pilot?.compare(frame.tick, row);
  }

  #observe(tick, now) {
    const { isAnew, isTooOld } = this.#time.observe(tick, now, this.#pings.last);
    if (isAnew) this.own?.pilot?.beginAnew();
    if (!isTooOld || this.door.isHidden || !this.door.halve()) return;
    this.onNotice('this page can\'t keep up: half as many frames from now on');
    this.#rejoin();
  }

  #follow(line, now) {
    this.#time.word.heard(now);
    if (!this.welcome || !this.stream || this.stream.take(line)) return;
    this.onNotice(`${this.stream.difference}. Watching by frames now.`, 'bad');
    this.door.watchByFrames();
    this.#rejoin();
  }

  #afterBatch(now) {
    const stream = this.welcome?.stream === 'inputs' ? this.stream : null;
    if (!stream?.isRunning) return;
    if (stream.ground !== this.ground) this.#begin(stream.ground);
    for (const snapshot of stream.takeSnapshots()) this.#time.frames.show(snapshot);
    // Between two that go out on time only the keyframe is by itself: what is shown need not wait for the next one.
    if (stream.isOnTime || !this.#time.clock.isRunning) this.#observe(stream.tick, now);
  }

  #pong(pong, now) {
    const trip = this.#pings.answered(pong, now);
    if (trip === null) return;
    this.#time.word.answered(now - trip);
    this.own?.pilot?.lead.trip(trip);
  }

  #cut() { this.welcome = null; this.own?.end(true); }
  #rejoin() { this.#cut(); this.#link.rejoin(); }

  #onLost(closing, again) {
    if (!this.#isWhole && again !== null) return;  // the server waits for no join that long: it is asked again, and nothing was shown yet
    this.#cut();
    this.lost = { reason: closing.reason, code: closing.code, again: again === null ? null : seconds() + again, address: closing.address ?? '' };
  }
}
