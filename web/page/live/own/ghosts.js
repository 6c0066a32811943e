// @ts-check
// The ghosts beside you: those that hold a race's records, and your own drives before this one, the last and the best.
// Each drives in a world of its own. Own drives are kept in the browser's storage.
import { GhostRun, isDrive } from './drive.js';
import { spanText } from '../words.js';

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
