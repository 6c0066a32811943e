// @ts-check
// Your own louse's part in a game: who drives it, the ghosts it races, and what the rules have said of it lately: what is told in
// big figures, the chain of crumbs, when the race's run began. Time is an argument, in seconds.
import { MOMENTS, signedText, spanText } from '../words.js';
import { Ghosts } from './ghosts.js';
import { aim } from '../goal.js';
import { Pilot } from './pilot.js';
import { Steering } from './steering.js';

const SPLASH_FOR = 2, CHAIN = 4;  // s

export class OwnRun {
  /** @type {{text: string, tone: string}|null} */ #splash = null; #splashedAt = 0; #chain = 0; #chainAt = 0;
  /** Moment at which the race's run began; 0: the clock does not run, or nobody knows. */ runStart = 0;

  event(event, hz, now) {
    switch (event.kind) {
      case 'gate':  // against the best lap: the sign says it, the colour only repeats it
        if (event.delta != null) this.show(signedText(event.delta, hz), event.delta <= 0 ? 'good' : 'bad', now);
        else if (event.split > 0) this.show(spanText(event.split, hz), '', now);
        break;
      case 'lap': this.show(spanText(event.time, hz), event.best ? 'good' : '', now); break;
      case 'run': this.show(spanText(event.time, hz), 'goal', now); break;
      case 'crumb':
        this.#chain = event.chain;
        this.#chainAt = event.moment;
        if (event.value > 1 || event.chain > 1) this.show(`+${event.value}${event.chain > 1 ? `\u00d7${event.chain}` : ''}`, 'goal', now);
        break;
      case 'fell': this.show('fell', 'bad', now); break;
    }
  }

  /** What a frame says of it. */
  observe(louse) {
    if (!louse.lap_start) this.runStart = 0;
    else if (!louse.lap) this.runStart = louse.lap_start;
  }

  show(text, tone, now) { this.#splash = { text, tone }; this.#splashedAt = now; }
  /** What stands big over the picture now, or null. */
  splash(now) { return this.#splash && now - this.#splashedAt < SPLASH_FOR ? this.#splash : null; }

  /** How much of the chain's time is left at a tick, 1 to 0. */
  chainLeft(tick, hz) { return this.#chain ? Math.min(1, Math.max(0, 1 - (tick - this.#chainAt / MOMENTS) / hz / CHAIN)) : 0; }
  /** How often the last crumb counted; 0: no chain. */
  chain(tick, hz) { return this.chainLeft(tick, hz) > 0 ? this.#chain : 0; }
}

const BOARDS = ['people', 'bots', 'handed_in'];

export class OwnGame {
  #lastSeq = 0;
  /** @type {Pilot|null} where there is a louse of your own and its ground is known */ pilot = null;
  run = new OwnRun();
  steering = new Steering(60);

  /** @param {Storage|null} storage @param {(message: any) => void} send */
  constructor(storage, send) {
    this.ghosts = new Ghosts(storage);
    this.send = send;
  }

  /** A game ends. isLineCut: its inputs' count begins anew. */
  end(isLineCut) {
    this.#lastSeq = isLineCut ? 0 : this.pilot?.lastSeq ?? this.#lastSeq;
    this.pilot = null;
    this.run = new OwnRun();
  }

  /** A game begins on a ground. @param {any} welcome @param {any} ground of core.js
   * @param {import('../ways.js').Ways} ways @param {{behavior: number, isSame: boolean, hasRecords: boolean}} server isSame: the page computes what it does */
  begin(welcome, ground, ways, server) {
    if (!welcome.id) return;
    const { mode, rules, tick_hz: hz, id } = welcome;
    this.steering.hz = hz;
    this.steering.reset();
    this.pilot = new Pilot({ hz, id, steering: this.steering, ways, world: server.isSame ? ground.world(mode) : null, lastSeq: this.#lastSeq });
    const first = aim({ mode, rules, ways, hz, tick: 0, lice: [], id, isOwn: true, run: null, nameOf: String, rank: 0, game: { phase: 'play', place: 0 }, you: { gate: 0, x: 0, y: 0 } });
    if (first) this.pilot.lookAt(first.at[0], first.at[1]);
    this.ghosts.begin({ ground, mode, hz, behavior: server.behavior, isExact: server.isSame });
    if (mode === 'race' && server.hasRecords) for (const board of BOARDS) this.#askForGhost(board);
  }

  /** An event of the room; you: your louse, or 0. */
  event(event, welcome, now) {
    if (event.kind === 'record' && welcome.mode === 'race' && welcome.id) this.#askForGhost(event.bots ? 'bots' : 'people');
    if (!this.pilot || event.id !== welcome.id) return;
    this.run.event(event, welcome.tick_hz, now);
    if (event.kind === 'lap') this.pilot.log.lap(event.time);
    if (event.kind !== 'respawned' && event.kind !== 'returned') return;  // back at a spawn
    const drive = this.pilot.respawned();
    if (drive) this.ghosts.addDrive(drive);
  }

  /** Where the ghosts are at the server's tick. */
  ghostsAt(tick) { return this.pilot ? this.ghosts.marks(this.pilot.sinceSpawn, this.run.runStart, tick) : []; }

  #askForGhost(board) { this.send({ type: 'get_ghost', board, rank: 1 }); }
}
