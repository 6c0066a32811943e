// @ts-check
// One game of the room over time: its frames, the server's clock, whether the server still speaks and the page keeps up.
// Time is an argument, in seconds.
import { ServerClock } from './clock.js';
import { Frames } from './frames.js';
import { Pace, ServerWord } from './word.js';

const DELAY = 0.1, RESYNC_EVERY = 1;  // s

export class Timeline {
  #resyncAt = -Infinity; #pace;

  /** Of a welcome, that came at `now`. */
  constructor({ tick_hz: hz, state_hz: stateHz, fields, quantum }, now) {
    this.hz = hz;
    this.frames = new Frames(hz, fields, quantum);
    this.clock = new ServerClock(hz);
    this.word = new ServerWord();
    this.word.expect(stateHz);
    this.word.heard(now);
    /** Others are drawn so far behind. [s] */ this.delay = Math.max(DELAY, 2 / stateHz);
    /** The server's tick, as of the last lice(). */ this.tick = 0;
    this.#pace = new Pace(hz);
  }

  get game() { return this.frames.newest?.game ?? null; }
  get newest() { return this.frames.newest; }
  /** Whether what was last shown can be thought on to now. */
  isKnown(now) { return this.clock.isRunning && this.word.goesOn(now); }

  /** A state of `tick` came. @returns {{isAnew: boolean, isTooOld: boolean}} isAnew: it goes on after a pause, and what was counted on
   * meanwhile never happened; isTooOld: the page does not keep up */
  observe(tick, now) {
    const isAnew = this.word.shown(tick, now);
    if (isAnew) this.clock = new ServerClock(this.hz);
    this.clock.observe(tick, now);
    return { isAnew, isTooOld: this.#pace.observe(tick, now) };
  }

  /** A frame that was checked. @returns {'taken'|'stale'|'unreadable'|'resync'} resync: the server is to be asked for it */
  merge(frame, now) {
    const merged = this.frames.merge(frame);
    if (merged !== 'missing') return merged;
    if (now - this.#resyncAt < RESYNC_EVERY) return 'stale';
    this.#resyncAt = now;
    return 'resync';
  }

  /** Every louse as it is to be drawn now. REQUIRES isKnown(now). */
  lice(now, ways) {
    this.tick = this.clock.tick(now);
    return this.frames.at(this.tick - this.delay * this.hz, ways);
  }
}
