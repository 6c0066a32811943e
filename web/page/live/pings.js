// @ts-check
// The page's signs of life and what their answers tell: round trips. Pure; time is an argument, in seconds.

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

  /** The shortest of the last ones [s]: the others waited for something besides the network. Null: there are none. */
  get trip() { return this.#trips.length ? Math.min(...this.#trips) : null; }
}
