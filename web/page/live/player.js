// @ts-check
// A recording that plays: where it stands, how fast, what is shown and what is proven. The worker behind `recording`
// re-runs it; here is its clock.
import { Frames } from './frames.js';
import { marksOf } from './goal.js';
import { Ways } from './ways.js';

export const SPEEDS = [0.125, 0.25, 0.5, 1, 2, 4, 8, 16];
const SNAPSHOTS_HZ = 30, AHEAD = 0.25;  // of the reader's time, s

/** Its lice by id, with what the rules say of them. */
function withStandings({ lice, standings }) {
  const said = new Map(standings.map((/** @type {any} */ standing) => [standing.id, standing]));
  return new Map(lice.map((louse) => [louse.id, { ...louse, ...said.get(louse.id) }]));
}

export class Player {
  #frames; #isBusy = false; #isClosed = false;
  /** @type {number|null} */ #before = null;
  /** @type {number|null} a tick that is sought */ #wanted = null;
  /** @type {number[][]} */ #proven = [];
  /** Told when it stands somewhere else. */ onSeek = () => {};
  /** Where it stands, in ticks and parts of one. */ tick; isPlaying = true; speed = 1;
  /** @type {any[]} */ lice = [];
  /** The table of scores, as it was made last. @type {ReturnType<import('./goal.js').scoreRows>} */ rows = [];
  /** The first tick that differs, and how; null. @type {{tick: number, what: string}|null} */ difference = null;
  /** Of a whole verification: {ok, text}. @type {any} */ verdict = null;
  /** How many steps of one that is under way were re-run; null: none is. @type {number|null} */ verified = null;
  /** How far the steps err of who is measured. @type {import('../core/louse_error.js').ErrorReading|null} */ error = null; #measured = 0;
  /** What was said, the newest last. @type {any[]} */ lines = []; said = 0;

  /** @param {import('../core/recording.js').Recording} recording @param {(text: string, tone?: string) => void} onNotice */
  constructor(recording, onNotice) {
    this.recording = recording;
    this.info = recording.info;
    this.ground = recording.ground();
    this.ways = new Ways(this.ground.domain, this.ground.wraps);
    this.onNotice = onNotice;
    this.tick = this.info.first;
    this.names = new Map(this.info.players.map(({ id, name, role }) => [id, { name, role }]));
    this.#frames = new Frames(this.info.hz);
    this.seek(this.info.first);
  }

  get hz() { return this.info.hz; }
  get game() { return this.#frames.newest?.game ?? null; }
  nameOf(id) { return this.names.get(id)?.name ?? `#${id}`; }
  isBot(id) { return this.names.get(id)?.role === 'bot'; }
  get bots() { return this.lice.filter(({ id }) => this.isBot(id)).length; }
  /** Ticks that were re-run here with the hash that was recorded. */
  get proven() { return this.#proven.reduce((sum, [from, to]) => sum + to - from, 0); }
  get steps() { return this.info.last - this.info.first; }

  get proof() {
    if (this.verified !== null) return { text: `verifying: ${Math.floor(100 * this.verified / Math.max(1, this.steps))} %`, tone: '' };
    if (this.verdict) return { text: this.verdict.text, tone: this.verdict.ok === 1 ? 'ok' : 'bad' };
    if (this.difference) return { text: `differs at tick ${this.difference.tick}`, tone: 'bad' };
    return { text: `state ok ${this.proven}/${this.steps}`, tone: 'ok' };
  }

  /** To a tick; what is under way there is dropped. */
  seek(tick) {
    this.tick = Math.min(this.info.last, Math.max(this.info.first, Math.floor(tick)));
    this.#wanted = this.tick;
    this.#go();
  }
  /** By so many ticks, standing there. */
  tickBy(ticks) {
    this.isPlaying = false;
    this.seek(Math.round(this.tick) + ticks);
  }
  skip(seconds) { this.seek(this.tick + seconds * this.hz); }
  faster(by) {
    const k = SPEEDS.indexOf(this.speed) + by;
    this.speed = SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, k))];
  }
  toggle() {
    if (!this.isPlaying && this.tick >= this.info.last) this.seek(this.info.first);
    this.isPlaying = !this.isPlaying;
  }

  /** Whose steps' error is told, from here on; 0: nobody's. @param {number} id */
  measure(id) {
    if (id === this.#measured) return;
    this.#measured = id;
    this.error = null;
    this.recording.measure(id).catch(() => {});  // why there is no worker any more, who shows it has been told
  }

  /** All of it, re-run at once; asked for again meanwhile, it goes on. */
  async verify() {
    if (this.verified !== null) return;
    this.verified = 0;
    const begun = performance.now(), { ok, text } = await this.recording.verify((ticks) => { this.verified = ticks; }).finally(() => { this.verified = null; });
    const tick = /differs at tick (\d+)/.exec(text)?.[1];
    if (tick) this.difference ??= { tick: Number(tick), what: text };  // marked on the track, too
    this.verdict = { ok, text: `${text.trim()} (${(performance.now() - begun).toFixed(0)} ms)` };
  }

  /** Runs on to now [s]. */
  update(now) {
    const passed = this.#before === null ? 0 : Math.min(0.25, now - this.#before);
    this.#before = now;
    const newest = this.#frames.newest;
    if (!newest) return;
    if (this.isPlaying && this.#wanted === null) {
      this.tick = Math.min(this.tick + passed * this.hz * this.speed, newest.tick, this.info.last);
      if (this.tick >= this.info.last) this.isPlaying = false;
      this.#go();
    }
    this.lice = this.#frames.at(this.tick, this.ways);
  }

  louse(id) { return this.lice.find((louse) => louse.id === id) ?? null; }

  facts(id) {
    const { mode } = this.info;
    return { mode, rules: mode === 'roam' ? null : this.ground.definition[mode], game: mode === 'roam' ? null : this.game, tick: this.tick, hz: this.hz, lice: this.lice, ways: this.ways,
                    you: this.louse(id), id, isOwn: false, run: null, nameOf: (of) => this.nameOf(of), rank: this.rows.find((row) => row.id === id)?.rank ?? 0 };
  }
  marks(facts) { return marksOf(facts); }
  close() {
    this.#isClosed = true;
    this.recording.close();
    this.ground.close();
  }

  /** Has the worker do what is due: one thing at a time. */
  async #go() {
    if (this.#isBusy || this.#isClosed) return;
    this.#isBusy = true;
    try {
      if (this.#wanted !== null) {
        const tick = this.#wanted;
        const state = await this.recording.seek(tick);
        if (this.#wanted === tick) {
          this.#wanted = null;
          this.#frames = new Frames(this.hz);
          this.onSeek();
        }
        this.#show(state);
      } else {
        const newest = this.#frames.newest?.tick ?? this.info.first, ahead = this.tick + this.hz * this.speed * AHEAD;
        if (newest < Math.min(ahead, this.info.last)) this.#show(await this.recording.advance(Math.max(1, Math.round(this.hz * this.speed / SNAPSHOTS_HZ))));
      }
    } catch (error) {
      this.isPlaying = false;
      this.#wanted = null;
      if (!this.#isClosed) this.onNotice(/** @type {Error} */ (error).message, 'bad');
    } finally {
      this.#isBusy = false;
    }
    if (this.#wanted !== null) this.#go();
    else if (this.isPlaying && (this.#frames.newest?.tick ?? 0) < Math.min(this.info.last, this.tick + this.hz * this.speed * AHEAD)) this.#go();
  }

  /** @param {import('../core/recording_desk.js').Moment} state */
  #show(state) {
    this.#frames.show({ tick: state.tick, lice: withStandings(state), game: state.game });
    for (const { id, name, role } of state.players) this.names.set(id, { name, role });
    for (const chat of state.chats) { this.lines.push({ from: chat.name, id: chat.id, text: chat.text }); this.said++; }
    if (this.lines.length > 60) this.lines.splice(0, this.lines.length - 60);
    this.error = state.measured === this.#measured ? state.error : null;
    this.difference ??= state.difference;
    if (!state.difference) this.#prove(state.since, state.tick);
  }

  /** Counts the steps from one tick to another as proven, each once. */
  #prove(from, to) {
    const apart = this.#proven.filter(([a, b]) => b < from || a > to), meet = this.#proven.filter(([a, b]) => b >= from && a <= to);
    this.#proven = [...apart, [Math.min(from, ...meet.map(([a]) => a)), Math.max(to, ...meet.map(([, b]) => b))]];
  }
}
