// @ts-check
// A room watched by inputs: its recording as it is written, re-run by the core's Follower, each tick proven; and the
// snapshots that are drawn of it.

const SNAPSHOTS_HZ = 30;

export class Stream {
  #follower; #every = 2; #aPart = 3; #shown = -1; #snapshots = [];
  /** What differs, and where; '' nothing. Stays. */ difference = '';
  /** Of the game that is on; null before its keyframe. @type {import('../core/ground.js').Ground|null} */ ground = null;

  /** @param {import('../core/core.js').Core} core */
  constructor(core) { this.#follower = core.follower(); }

  /** Another game or session begins. */
  begin(hz, stateHz) {
    this.#follower.beginAnew();
    this.#every = Math.max(1, Math.floor(hz / SNAPSHOTS_HZ));
    this.#aPart = Math.max(1, Math.floor(hz / stateHz));
    this.#shown = -1;
    this.#snapshots = [];
    this.ground = null;
  }

  /** Steps re-run so far, over all sessions, whose hash was that of the line. */
  get proven() { return this.#follower.proven; }
  get tick() { return this.#follower.tick; }
  get isRunning() { return this.ground !== null && !this.difference; }
  /** Whether the tick where it stands is one that goes out on time: those between come with it. */
  get isOnTime() { return this.tick % this.#aPart === 0; }

  /** The next line. False: it differs, and nothing more is taken. */
  take(line) {
    const follower = this.#follower;
    if (!follower.take(line)) {
      const { tick, what } = follower.difference ?? { tick: 0, what: 'a line that is none' };
      this.difference = `differs at tick ${tick}: ${what}`;
      return false;
    }
    const { tick } = this;
    if (tick < 0) return true;
    this.ground ??= follower.ground();
    if (tick >= this.#shown && tick - this.#shown < this.#every) return true;
    this.#shown = tick;  // behind a new keyframe it may stand further back than it was
    const standings = new Map(follower.standings().map((standing) => [standing.id, standing]));
    this.#snapshots.push({ tick, lice: new Map(follower.lice().map((louse) => [louse.id, { ...louse, ...standings.get(louse.id) }])), game: follower.game() });
    return true;
  }

  /** Made since the last call, to be drawn. */
  takeSnapshots() {
    const snapshots = this.#snapshots;
    this.#snapshots = [];
    return snapshots;
  }
}
