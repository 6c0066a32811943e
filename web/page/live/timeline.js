// @ts-check
// The server's tick as a smooth function of the page's time: frames come early or late by the network's whims, and what
// is drawn must not.
//
// Each frame's arrival says tick - seconds * hz: the earliest arrivals (the largest values) are the true line, all below
// is delay. The line follows a new maximum at once, sinks slowly otherwise (clocks drift, routes change), and falls when
// LATE_FRAMES running agree that it must: a server that fell behind and moved its clock. What is shown slews towards
// the line, by 5 % of real time at most, and jumps beyond JUMP.
//
// A timeline is one game of the room over time: its frames, that clock, whether the server still speaks. Time is an argument,
// in seconds.
import { Frames } from './frames.js';
import { Pace, ServerWord } from './word.js';

const LATE_FRAMES = 10, LATE = 0.08, SINK = 0.002, SLEW = 0.05, JUMP = 0.5;  // s, s, s a second, s a second, s

export class ServerClock {
  #line = 0; #shown = 0; #latest = 0; #lateFrames = 0; #bestLate = 0; #observedAt = 0; #shownAt = 0;

  /** @param {number} hz ticks a second */
  constructor(hz) {
    this.hz = hz;
    /** Whether a frame has arrived, so that tick() means something. */
    this.isRunning = false;
  }

  /** A frame of `tick` arrived at `now` [s]. */
  observe(tick, now) {
    const seen = tick - now * this.hz;
    if (!this.isRunning) {
      this.isRunning = true;
      this.#observedAt = this.#shownAt = now;
      this.#line = this.#shown = seen;
      this.#latest = tick;
      return;
    }
    const pause = Math.max(0, now - this.#observedAt);
    this.#observedAt = now;
    this.#line = Math.max(seen, this.#line - SINK * pause * this.hz);
    if (this.#line - seen < LATE * this.hz) { this.#lateFrames = 0; return; }
    this.#bestLate = this.#lateFrames === 0 ? seen : Math.max(this.#bestLate, seen);
    if (++this.#lateFrames < LATE_FRAMES) return;
    this.#line = this.#bestLate;
    this.#lateFrames = 0;
  }

  /** The tick whose frame, on time, arrives at `now` [s]. Never falls between calls but by a jump. */
  tick(now) {
    console.assert(this.isRunning);
    const pause = Math.max(0, now - this.#shownAt);
    this.#shownAt = Math.max(this.#shownAt, now);
    const gap = this.#line - this.#shown, most = SLEW * pause * this.hz;
    if (Math.abs(gap) > JUMP * this.hz) {
      this.#shown = this.#line;
      return this.#latest = this.#shown + now * this.hz;
    }
    this.#shown += Math.min(most, Math.max(-most, gap));
    return this.#latest = Math.max(this.#latest, this.#shown + now * this.hz);
  }
}

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
   * meanwhile never happened; isTooOld: the page does not keep up
   * @param {number} tick @param {number} now @param {number} [trip] of the last answer to a ping [s] */
  observe(tick, now, trip) {
    const isAnew = this.word.shown(tick, now);
    if (isAnew) [this.clock, this.#pace] = [new ServerClock(this.hz), new Pace(this.hz)];  // no frame is too old for the time that stood
    this.clock.observe(tick, now);
    return { isAnew, isTooOld: this.#pace.observe(tick, now, trip) };
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
