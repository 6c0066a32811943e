// @ts-check
// A drive of your own louse, kept so that it can be driven again: the exact state where it began and every input with
// the step that took it. And a drive driven again, in a world of its own: what a ghost is drawn from.
import { louseOf } from './prediction.js';

const MOST_SECONDS = 180, MOST_INPUTS = 5000, MOST_PENDING = 256;

/** @typedef {{start: any, inputs: number[][], ticks: number, lap: number}} Drive inputs: [at, kind, x, y, ticks] each, `at`
 * counted from the step that begins at `start`; lap: the best of a race in it, in moments, 0 for none */

export class DriveLog {
  /** @type {any[]} */ #pending = [];
  /** @type {any} */ #drive = null;

  /** @param {number} hz ticks a second */
  constructor(hz) { this.most = MOST_SECONDS * hz; /** @type {number|null} */ this.begun = null; }

  sent(seq, order) {
    this.#pending.push([seq, order]);
    if (this.#pending.length > MOST_PENDING) this.#pending.shift();
  }

  acknowledged(ack) {
    const order = this.#pending.find(([seq]) => seq === ack.seq)?.[1];
    this.#pending = this.#pending.filter(([seq]) => seq > ack.seq);
    if (ack.dropped) return;
    if (this.begun === null) {
      if (!ack.you) return;
      this.#drive = { start: louseOf(ack.you), inputs: [], ticks: 0, lap: 0 };
      this.begun = ack.you.tick;
      return;  // its state has taken the input already
    }
    const at = ack.tick - this.begun;
    if (order && at >= 0 && at < this.most && this.#drive.inputs.length < MOST_INPUTS)
      this.#drive.inputs.push([at, order.kind, order.x, order.y, order.ticks]);
  }

  /** A lap of a race was driven. */
  lap(moments) { if (this.#drive && (this.#drive.lap === 0 || moments < this.#drive.lap)) this.#drive.lap = moments; }

  /** Ends it before step `tick`; the next state begins another. @returns {Drive|null} */
  finish(tick) {
    const begun = this.begun;
    this.begun = null;
    if (begun === null || tick <= begun) return null;
    return { ...this.#drive, ticks: Math.min(tick - begun, this.most) };
  }
}

const isThrust = (kind, x, y) => [0, 1, 2].includes(kind) && Number.isFinite(x) && Number.isFinite(y) && x * x + y * y <= 1;

/** Whether a drive that came from outside can be one. */
export function isDrive(drive, hz) {
  if (!drive || !drive.start || !Array.isArray(drive.inputs) || drive.inputs.length > 100000) return false;
  if (!Number.isInteger(drive.ticks) || drive.ticks < 1 || drive.ticks > 3600 * hz) return false;
  let last = 0;
  return drive.inputs.every((input) => {
    if (!Array.isArray(input) || input.length !== 5) return false;
    const [at, kind, x, y, ticks] = input;
    if (!Number.isInteger(at) || at < last || !Number.isInteger(ticks) || ticks < 1 || ticks > 4294967295) return false;
    last = at;
    return isThrust(kind, x, y);
  });
}

const MOST_STEPS = 1200;

export class GhostRun {
  #tick = 0; #next = 0;

  /**
   * @param {any} world an empty one, for this alone
   * @param {Drive} drive one that isDrive()
   * @param {number} hz ticks a second
   */
  constructor(world, drive, hz) {
    this.world = world;
    this.hz = hz;
    this.drive = { ...drive, start: { ...drive.start, id: 1 } };
    this.#rewind();
  }

  /** Where it was `ticks` after its start; before that at its start, null once it is over. Of a leap forward MOST_STEPS are
   * taken at once, the rest with the next calls. */
  at(ticks) {
    const since = Math.max(0, ticks);
    if (since > this.drive.ticks) return null;
    const whole = Math.floor(since);
    this.#runTo(whole, MOST_STEPS);
    const louse = this.world.lice()[0];
    if (!louse) return null;  // it fell off an open edge
    const part = this.#tick === whole ? (since - whole) / this.hz : 0;
    return { ...louse, x: louse.x + part * louse.vx, y: louse.y + part * louse.vy };
  }

  /** How far it had come after so many ticks [m]. */
  distanceAt(ticks) {
    this.#runTo(Math.min(ticks, this.drive.ticks), Infinity);
    return (this.world.lice()[0]?.distance ?? this.drive.start.distance) - this.drive.start.distance;
  }

  #rewind() {
    this.world.clear();
    this.world.put(this.drive.start);
    this.#tick = this.#next = 0;
  }

  #runTo(tick, most) {
    if (tick < this.#tick) this.#rewind();
    const inputs = this.drive.inputs;
    for (let steps = 0; this.#tick < tick && steps < most; steps++) {
      for (; this.#next < inputs.length && inputs[this.#next][0] <= this.#tick; this.#next++) {
        const [at, kind, x, y, ticks] = inputs[this.#next];
        if (at === this.#tick) this.world.thrust(1, kind, x, y, ticks);
      }
      this.world.step(1);
      this.#tick++;
    }
  }
}
