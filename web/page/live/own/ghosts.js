// @ts-check
// A drive of your own louse, kept so that it can be driven again: the exact state where it began and every input with the step
// that took it. A drive driven again, in a world of its own: what a ghost is drawn from. And the ghosts beside you: those that
// hold a race's records, and your own drives before this one, the last and the best; these are kept in the browser's storage.
import { louseOf } from './prediction.js';
import { spanText } from '../words.js';

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

const MOST_KEPT = 20, SHORTEST = 3;  // drives, s
const TICK = 65536;                  // moments

export class Ghosts {
  #records = new Map();
  /** @type {any[]} */ #kept = [];
  /** @type {GhostRun|null} */ #last = null;
  /** @type {GhostRun|null} */ #best = null; #key = '';
  /** @type {any} */ game;

  /** @param {Storage|null} storage */
  constructor(storage) { this.storage = storage; /** @type {'best'|'last'|'off'} */ this.choice = 'best'; }

  /** A game begins. @param {{ground: any, mode: string, hz: number, behavior: number, isExact: boolean}} game */
  begin(game) {
    this.game = game;
    this.#records.clear();
    const key = `ghosts-${game.ground.hash}-${game.behavior}-${game.mode}-${game.hz}`;
    if (key === this.#key) return;  // back on the line: own drives are still known
    this.#key = key;
    this.#kept = [];
    this.#last = this.#best = null;
    if (game.isExact) this.#load();
  }

  /** Whoever holds a record: a `ghost` of the server's. */
  addRecord(line) {
    const { game } = this;
    if (!game?.isExact || game.mode !== 'race' || line.behavior !== game.behavior || line.tick_hz !== game.hz) return;
    const start = game.ground.spawns(game.mode)[line.spawn];
    const drive = { start, inputs: line.inputs, ticks: line.ticks, lap: 0 };
    if (!start || !isDrive(drive, game.hz)) return;
    this.#records.set(line.board, { name: `${line.name} ${spanText(line.time, game.hz)}`, start: line.start / TICK, run: this.#run(drive) });
  }

  /** A drive of your own is over; one that is too short to be raced is passed over. */
  addDrive(drive) {
    const { game } = this;
    if (!game?.isExact || drive.ticks < SHORTEST * game.hz || !['roam', 'race'].includes(game.mode) || !isDrive(drive, game.hz)) return;
    this.#add(drive);
    try { this.storage?.setItem(this.#key, JSON.stringify(this.#kept)); } catch { /* full, or forbidden: then they end with the page */ }
  }

  /** Off, the best, the last; what it is now in words. */
  cycle() {
    this.choice = /** @type {any} */ ({ best: 'last', last: 'off', off: 'best' })[this.choice];
    if (this.choice === 'off') return 'ghosts off';
    const own = this.choice === 'last' ? this.#last : this.#best ?? this.#records.size;
    return (this.choice === 'last' ? 'ghost: your last drive' : 'ghosts: the best') + (own ? '' : ', once you respawn (R)');
  }

  /** Where they are. sinceSpawn: ticks of your own drive, null before it began. runStart: moment at which your race's clock
   * began, 0: it does not run. tick: the server's, now. */
  marks(sinceSpawn, runStart, tick) {
    const marks = [];
    if (this.choice === 'off') return marks;
    if (this.choice === 'best') {
      const running = runStart === 0 ? 0 : Math.max(0, tick - runStart / TICK);  // they wait where their clock began until yours does
      for (const [board, record] of this.#records) {
        const louse = record.run.at(record.start + running);
        if (louse) marks.push({ kind: board === 'handed_in' ? 'author' : 'record', name: record.name, ...louse });
      }
    }
    const own = this.choice === 'best' ? this.#best : this.#last;
    const louse = own && sinceSpawn !== null ? own.at(sinceSpawn) : null;
    if (louse) marks.push({ kind: 'own', name: this.choice === 'best' ? 'your best' : 'your last', ...louse });
    return marks;
  }

  #run(drive) { return new GhostRun(this.game.ground.world(this.game.mode), drive, this.game.hz); }

  #add(drive) {
    this.#kept.push(drive);
    if (this.#kept.length > MOST_KEPT) this.#kept.shift();
    this.#last = this.#run(drive);
    if (!this.#best || this.#isBetter(this.#last, this.#best)) this.#best = this.#run(drive);
  }

  #isBetter(a, b) {
    if (this.game.mode === 'race') return a.drive.lap !== 0 && (b.drive.lap === 0 || a.drive.lap < b.drive.lap);
    const ticks = Math.min(a.drive.ticks, b.drive.ticks);
    return a.distanceAt(ticks) > b.distanceAt(ticks);
  }

  #load() {
    try {
      for (const drive of JSON.parse(this.storage?.getItem(this.#key) ?? '[]').slice(-MOST_KEPT))
        if (isDrive(drive, this.game.hz)) this.#add(drive);
    } catch { this.#kept = []; }
  }
}
