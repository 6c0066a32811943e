// @ts-check
// What the server has shown of the room: keys and deltas merged to snapshots, and every louse between two of them.
//
// A delta is cumulative against its key: any may be lost, and one whose key is not here can't be used: then the server
// is to be asked for another key.
import { between } from './ways.js';

/** The columns that the page asks for; the terminal client's, so that both share what the room encodes. */
export const COLUMNS = ['id', 'x', 'y', 'vx', 'vy', 'heading_x', 'heading_y', 'distance', 'flight_z'];
/** What else there is where the server has rules of play. */
export const RULES_COLUMNS = ['score', 'gate', 'lap', 'lap_start', 'best_lap'];

/** Snapshots kept, the newest; seconds for which a louse is thought on beyond the last one. */
const SNAPSHOTS = 64, THOUGHT_ON = 0.25;

/** A whole `game` with a delta's members put into it. */
export function applied(game, change) {
  if (!change) return game;
  const result = { ...game, ...change };
  if (game?.crumbs && change.crumbs) {
    const slots = new Map(game.crumbs.map((crumb) => [crumb[0], crumb]));
    for (const crumb of change.crumbs) slots.set(crumb[0], crumb);
    result.crumbs = [...slots.values()];
  }
  return result;
}

export class Frames {
  /** @type {any} */ #key = null;
  /** @type {any[]} */ #snapshots = [];

  /**
   * @param {number} hz ticks a second
   * @param {string[]} fields of a row
   * @param {number[]} quantum of each
   */
  constructor(hz, fields = [], quantum = []) {
    this.hz = hz;
    this.fields = fields;
    this.quantum = quantum;
    this.isReadable = COLUMNS.every((name) => fields.includes(name));
  }

  /** The newest snapshot {tick, lice: Map, game}, or null. */
  get newest() { return this.#snapshots.at(-1) ?? null; }

  /** A key or delta that was checked (messages.js). @returns {'taken'|'stale'|'missing'|'unreadable'} */
  merge(frame) {
    if (!this.isReadable || frame.louse.some((row) => row.length !== this.fields.length)) return 'unreadable';
    if (this.newest && frame.tick <= this.newest.tick) return 'stale';
    const snapshot = { tick: frame.tick, lice: new Map(), game: frame.game ?? null };
    if (frame.type === 'delta') {
      if (this.#key?.tick !== frame.base) return 'missing';
      for (const [id, louse] of this.#key.lice) snapshot.lice.set(id, louse);
      for (const id of frame.gone ?? []) snapshot.lice.delete(id);
      snapshot.game = applied(this.#key.game, frame.game);
    }
    for (const row of frame.louse) snapshot.lice.set(row[0], this.#louse(row));
    if (frame.type === 'key') this.#key = snapshot;
    this.show(snapshot);
    return 'taken';
  }

  /** One that was made here; passed over where it is not newer than what is here. */
  show(snapshot) {
    if (this.newest && snapshot.tick <= this.newest.tick) return;
    this.#snapshots.push(snapshot);
    if (this.#snapshots.length > SNAPSHOTS) this.#snapshots.shift();
  }

  /** Every louse at a (fractional) tick. @returns {any[]} */
  at(tick, ways) {
    const all = this.#snapshots;
    if (!all.length) return [];
    let after = all.length;
    while (after > 0 && all[after - 1].tick > tick) after--;
    if (after === 0) return [...all[0].lice.values()];
    const from = all[after - 1], to = all[after];
    const passed = (tick - from.tick) / this.hz;
    if (!to) return [...from.lice.values()].map((louse) => thoughtOn(louse, Math.min(passed, THOUGHT_ON), ways));
    const seconds = (to.tick - from.tick) / this.hz, lice = [];
    for (const [id, louse] of from.lice) {
      const next = to.lice.get(id);
      lice.push(next ? between(louse, next, seconds, Math.min(1, passed / seconds), ways) : louse);
    }
    return lice;
  }

  #louse(row) {
    const louse = { phase: 0, vx: 0, vy: 0 };
    for (let k = 0; k < row.length; k++) louse[this.fields[k]] = row[k] * this.quantum[k];
    const length = Math.hypot(louse.heading_x, louse.heading_y);
    if (length > 1e-6) { louse.heading_x /= length; louse.heading_y /= length; } else { louse.heading_x = 1; louse.heading_y = 0; }
    if (louse.flight_z !== 0) louse.phase = 2;
    return louse;
  }
}

function thoughtOn(louse, seconds, ways) {
  const [x, y] = ways.place(louse.x + seconds * louse.vx, louse.y + seconds * louse.vy);
  return { ...louse, x, y };
}
