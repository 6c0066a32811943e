// @ts-check
// Your own louse before the server has answered: the server's World, compiled for the page, with one louse in it, from
// the exact state of an ack, re-run with every input that has no answer yet. The step is the same code, so an input
// that lands on the tick it asked for needs no correction, to the bit.

/** Inputs without an answer, ticks run beyond the last ack, ticks remembered. */
const MOST_PENDING = 256, MOST_AHEAD = 600, HISTORY = 600;

/** The fields of a louse in which the page and the server are held against each other. */
const FIELDS = ['id', 'phase', 'x', 'y', 'vx', 'vy', 'heading_x', 'heading_y', 'tx', 'ty', 'flight_z', 'flight_vz',
                'distance', 'thrust_kind', 'ticks_left'];
const same = (a, b) => FIELDS.every((name) => Object.is(a[name], b[name]));

/** The louse that an ack states. */
export function louseOf(you) {
  return {
    id: you.id, phase: you.phase, x: you.x, y: you.y, vx: you.vx, vy: you.vy, heading_x: you.heading[0], heading_y: you.heading[1],
    tx: you.thrust[0], ty: you.thrust[1], flight_z: you.flight_z, flight_vz: you.flight_vz, distance: you.distance,
    thrust_kind: you.thrust_kind, ticks_left: you.thrust_ticks,
  };
}

export class Prediction {
  #world; #ways;
  /** @type {any} */ #louse = null;
  /** @type {any[]} */ #pending = []; #history = new Map(); #correction = [0, 0];

  /**
   * @param {any} world an empty one of the map (core.js), for this alone
   * @param {import('../ways.js').Ways} ways
   */
  constructor(world, ways) {
    this.#world = world;
    this.#ways = ways;
    /** The state shown is that before this step. */
    this.tick = 0;
    /** Acks whose state was what the page already had, to the bit, and those where it was not. */
    this.exact = 0;
    this.corrected = 0;
    /** Is shown the louse before each step, also of those that are run again. @type {import('../../core/louse_error.js').LouseError|null} */
    this.error = null;
  }

  /** The louse before step `tick`; null before the first ack. */
  get louse() { return this.#louse; }
  get pending() { return this.#pending.length; }
  /** Where it was, or was last believed to be, before step `tick`. */
  at(tick) { return this.#history.get(tick) ?? null; }

  /** An input was sent, asking for step `tick`, above those before. */
  sent(seq, tick, order) {
    console.assert(!this.#pending.length || this.#pending.at(-1).seq < seq);
    if (this.#pending.length === MOST_PENDING) this.#pending.shift();
    this.#pending.push({ seq, tick, order });
  }

  /** The server's answer: where its state is another than ours, it is the new base. */
  acknowledge(ack) {
    if (ack.you && ack.you.tick > this.tick) this.advance(ack.you.tick);  // pictures are rarer than acks: what would it have been?
    this.#pending = this.#pending.filter((input) => input.seq > ack.seq);
    if (!ack.you) return;
    const stated = louseOf(ack.you), believed = this.#history.get(ack.you.tick);
    if (this.#louse && believed && same(believed, stated)) { this.exact++; return; }
    if (believed) this.corrected++;
    const before = this.#louse, target = Math.max(this.tick, ack.you.tick);
    this.#begin(stated, ack.you.tick);
    if (target - this.tick <= MOST_AHEAD) this.advance(target);
    if (!before || this.tick !== target || !this.#louse) return;
    const [x, y] = this.#ways.way(this.#louse.x, this.#louse.y, before.x, before.y);
    this.#correction = [this.#correction[0] + x, this.#correction[1] + y];
  }

  /** Runs on to the state before step `tick`; never back. */
  advance(tick) {
    if (!this.#louse) return;
    if (tick - this.tick > MOST_AHEAD) return this.forget();  // the page slept: what it believed is worth nothing
    while (this.#louse && this.tick < tick) this.#step();
  }

  /** A respawn, a pause: the next ack begins anew. What was sent is still on its way, and will act. */
  forget() {
    this.#world.clear();
    this.#louse = null;
    this.tick = 0;
    this.#history.clear();
    this.#correction = [0, 0];
  }

  /** How far acks have moved what was shown, once: old minus new [m]. The drawing fades it out. */
  takeCorrection() {
    const correction = this.#correction;
    this.#correction = [0, 0];
    return correction;
  }

  #begin(louse, tick) {
    this.#world.clear();
    try { this.#world.put(louse); } catch (error) {
      if (!/no louse/.test(String(error))) throw error;
      return this.forget();  // the server's word, but none that can be reckoned with
    }
    for (const past of this.#history.keys()) if (past > tick) this.#history.delete(past);
    this.tick = tick;
    this.#remember(louse);
    // One that asked for a step already past came too late; the next step is the best guess.
    for (const input of this.#pending) if (input.tick < tick) this.#push(input.order);
  }

  #push({ kind, x, y, ticks }) { this.#world.thrust(this.#louse.id, kind, x, y, ticks); }

  #step() {
    for (const input of this.#pending) if (input.tick === this.tick) this.#push(input.order);
    this.error?.find(this.#world, this.#louse.id, this.tick);
    this.#world.step(1);
    this.tick++;
    this.#remember(this.#world.lice()[0] ?? null);
  }

  #remember(louse) {
    this.#louse = louse;
    if (!louse) return;  // it fell off an open edge
    this.#history.set(this.tick, louse);
    if (this.#history.size > HISTORY) this.#history.delete(this.#history.keys().next().value);
  }
}
