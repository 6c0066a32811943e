// @ts-check
// From keys that are held, a stick and a brake to the thrust that the wire carries, by the compass: each key pushes that
// way in the picture, two of them between. Held pushes go out as pulses, renewed before they end, so that a page that
// dies or loses its line does not push for ever. Pure: time is an argument, in seconds.

/** How long what is sent acts, and what is left of it when it is renewed. [s] Where the page is slow, longer. */
export const PULSE = 0.4, RENEW_BEFORE = 0.2, LONGEST_PULSE = 1.5;
/** The least that a tap pushes; a push that turns with the camera is told anew so often; a lesser turn is none. */
const TAP = 0.05, TURN_EVERY = 0.1, LEAST_TURN = 0.02;

/** A unit vector as the wire can carry it: multiples of 1/128, towards zero so that its length stays at most 1. */
export function wireVector(x, y) {
  return [Math.trunc(x * 128) / 128 + 0, Math.trunc(y * 128) / 128 + 0];
}

/** @typedef {'up'|'down'|'left'|'right'|'brake'} Control */
const SIDES = { up: [0, 1], down: [0, -1], left: [-1, 0], right: [1, 0] };

export class Steering {
  #held = new Set(); #taps = new Map();
  /** @type {any} */ #stick = null; #cruises = false; #azimuth = Math.PI / 2;
  #polled = 0; #gap = 0;
  #last = [1, 0];  // the heading, a map vector
  /** @type {any} */ #sent = null; #sentAt = -Infinity; #sentUntil = -Infinity;

  /** @param {number} hz ticks a second */
  constructor(hz) { this.hz = hz; }

  /** @param {Control} control */
  hold(control, now) {
    this.#held.add(control);
    this.#taps.set(control, now + TAP);
    if (control === 'brake') this.#cruises = false;
  }
  /** @param {Control} control */
  release(control) { this.#held.delete(control); }
  /** Nobody sees any more what is let go: the page lost the keyboard. */
  releaseAll() { this.#held.clear(); this./** @type {any} */ #stick = null; }
  /** Where the stick is pushed, right and up, of length at most 1; null: it is let go. */
  stick(vector) { this.#stick = vector; }
  /** The push stays on. */
  toggleCruise() { this.#cruises = !this.#cruises; }
  get isCruising() { return this.#cruises; }
  /** The direction over the map that goes up in the picture [rad]: pushes under way turn with it. */
  lookAlong(azimuth) { this.#azimuth = azimuth; }
  /** Points along a unit vector, as after a spawn. */
  point(x, y) { this.#last = [x, y]; }
  /** Ends every push, the cruise too; the server has forgotten them as well. */
  reset() {
    this.releaseAll();
    this.#taps.clear();
    this.#cruises = false;
    this.#sent = null;
    this.#sentUntil = -Infinity;
  }

  isBraking(now) { return this.#acts('brake', now); }
  /** Where it pushes, or pushed last. */
  get heading() { return this.#last; }
  isPushing(now) { return !this.isBraking(now) && this.#wanted(now) !== null; }

  /** What is to be sent now, or null while what was sent still says it.
   * @returns {{kind: number, x: number, y: number, ticks: number} | null} */
  poll(now) {
    this.#gap = this.#polled ? Math.max(Math.min(0.5, now - this.#polled), 0.9 * this.#gap) : 0;  // between two polls, of late
    this.#polled = now;
    const want = this.#wanted(now);
    if (!want) {
      if (this.#sentUntil <= now) return null;  // it has ended by itself
      this.#sent = null;
      this.#sentUntil = -Infinity;
      return { kind: 2, x: 0, y: 0, ticks: 1 };
    }
    if (this.#says(want, now)) return null;
    this.#sent = want;
    this.#sentAt = now;
    const pulse = Math.min(LONGEST_PULSE, Math.max(PULSE, 3 * this.#gap));
    this.#sentUntil = now + pulse;
    return { kind: want.kind, x: want.x, y: want.y, ticks: Math.ceil(pulse * this.hz - 1e-6) };
  }

  /** Whether what was sent says `want`, near enough. */
  #says(want, now) {
    const sent = this.#sent;
    if (!sent || sent.kind !== want.kind || this.#sentUntil - now < Math.max(RENEW_BEFORE, 1.5 * this.#gap)) return false;
    if (sent.x === want.x && sent.y === want.y) return true;
    const turn = Math.hypot(sent.x - want.x, sent.y - want.y);
    return sent.keys === want.keys && (turn < LEAST_TURN || now - this.#sentAt < TURN_EVERY);
  }

  #acts(control, now) { return this.#held.has(control) || (this.#taps.get(control) ?? -Infinity) > now; }

  #wanted(now) {
    if (this.isBraking(now)) return { kind: 1, x: -1, y: 0, keys: 'brake' };
    let right = 0, up = 0, keys = '';
    for (const side in SIDES) {
      if (!this.#acts(side, now)) continue;
      right += SIDES[side][0];
      up += SIDES[side][1];
      keys += side;
    }
    if (this.#stick) { [right, up] = this.#stick; keys = 'stick'; }
    const length = Math.hypot(right, up);
    if (length < 0.05) return this.#cruises ? this.#vector(...this.#last, 1, 'cruise') : null;
    const cos = Math.cos(this.#azimuth), sin = Math.sin(this.#azimuth);
    const x = (cos * up + sin * right) / length, y = (sin * up - cos * right) / length;
    this.#last = [x, y];
    return this.#vector(x, y, keys === 'stick' ? Math.min(1, length) : 1, keys);
  }

  #vector(x, y, size, keys) {
    const [wireX, wireY] = wireVector(x * size, y * size);
    return { kind: 2, x: wireX, y: wireY, keys };
  }
}
