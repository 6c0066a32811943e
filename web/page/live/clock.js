// @ts-check
// The server's tick as a smooth function of the page's time: frames come early or late by the network's whims, and what
// is drawn must not.
//
// Each frame's arrival says tick - seconds * hz: the earliest arrivals (the largest values) are the true line, all below
// is delay. The line follows a new maximum at once, sinks slowly otherwise (clocks drift, routes change), and falls when
// LATE_FRAMES running agree that it must: a server that fell behind and moved its clock. What is shown slews towards
// the line, by 5 % of real time at most, and jumps beyond JUMP.

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
