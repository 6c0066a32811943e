// @ts-check
// Whether the server still speaks, whether its game goes on, and whether the page keeps up with it; and the page's own signs of
// life, whose answers tell round trips. Pure: time is an argument, in seconds.

/** Without a word for so long, what is shown is no longer known. [s] */
export const SILENCE = 1.5;
const LATE = 0.3;

export class ServerWord {
  /** @type {number|null} */ #heard = null;
  /** @type {number|null} */ #moved = null;
  #late = LATE; #tick = 0; #stands = false;

  /** So many frames a second come. */
  expect(framesHz) { this.#late = Math.max(LATE, 3 / Math.max(0.1, framesHz)); }
  heard(now) { this.#heard = now; }

  /** A frame of `tick` came. True: the game goes on after it stood, or nothing was known of it. */
  shown(tick, now) {
    const stood = !this.goesOn(now);
    if (this.#moved !== null && tick === this.#tick) {
      this.#stands = now - this.#moved > this.#late;
      return false;
    }
    this.#tick = tick;
    this.#moved = now;
    this.#stands = false;
    return stood;
  }

  /** The answer came to what was asked at `asked`: frames from before it, which it can't overtake, would be here. */
  answered(asked) { this.#stands ||= this.#moved !== null && asked - this.#moved > this.#late; }
  /** The server says so. */
  paused() { this.#stands = this.#moved !== null; }

  /** The next tick should have been shown by now: time to ask. */
  isLate(now) { return this.#moved !== null && now - this.#moved > this.#late; }
  /** Seconds without a word, when they are too many; else null. */
  silence(now) { return this.#heard === null || now - this.#heard < SILENCE ? null : now - this.#heard; }
  /** No tick passes. */
  get stands() { return this.#stands; }
  /** For how long none has [s]; 0: they do. */
  stoodFor(now) { return this.#stands && this.#moved !== null ? now - this.#moved : 0; }
  /** Whether what was last shown can be thought on to now. */
  goesOn(now) { return this.#moved !== null && !this.#stands && now - this.#moved < SILENCE + this.#late; }
}

const TOO_OLD = 1, FOR = 3;

/** A browser reads for its page without being asked, so a stalled page never looks slow to the server: the page itself
 * sees how old the newest frame is, and asks for fewer. */
export class Pace {
  #earliest = -Infinity;
  /** @type {number|null} */ #since = null;

  /** @param {number} hz ticks a second */
  constructor(hz) { this.hz = hz; }

  /** A frame was read at `now`. True: for 3 s they have been more than 1 s old; half of them would do. trip: of the last answer [s], which
   * waited behind the frames: where it did not wait, it is the server that stood, and its clock has moved. */
  observe(tick, now, trip = Infinity) {
    const seen = tick / this.hz - now;
    this.#earliest = Math.max(this.#earliest, seen);
    if (this.#earliest - seen <= TOO_OLD) { this.#since = null; return false; }
    const since = this.#since ??= now;
    if (now - since < FOR) return false;
    if (trip > TOO_OLD) return true;
    [this.#earliest, this.#since] = [seen, null];
    return false;
  }
}

const EVERY = 1, WHEN_LATE = 0.3, FIRST = 6, FIRST_EVERY = 0.06, KEPT = 8;

export class Pings {
  #sent = 0; #at = -Infinity; #trips = [];

  /** The ping to send now, or null. isLate: what should have come has not. */
  due(now, isLate) {
    const every = this.#sent < FIRST ? FIRST_EVERY : isLate ? WHEN_LATE : EVERY;
    if (now - this.#at < every) return null;
    this.#at = now;
    this.#sent++;
    return { type: 'ping', t: Math.round(now * 1e6) };
  }

  /** A pong came. @returns {number|null} the trip [s]; null: no answer to a ping of this page */
  answered(pong, now) {
    const trip = now - pong.t / 1e6;
    if (!(trip >= 0 && trip < 60)) return null;
    this.#trips.push(trip);
    if (this.#trips.length > KEPT) this.#trips.shift();
    return trip;
  }

  /** The last one [s]. */
  get last() { return this.#trips.at(-1); }
  /** The shortest of the last ones [s]: the others waited for something besides the network. Null: there are none. */
  get trip() { return this.#trips.length ? Math.min(...this.#trips) : null; }
}
