// @ts-check
// Your own louse's part in a game: who drives it, what the rules said of it, the ghosts it races, a gate of its own. Time is
// an argument, in seconds.
import { Ghosts } from './ghosts.js';
import { aim } from '../goal.js';
import { OwnRun } from './own_run.js';
import { Pilot } from './pilot.js';
import { Steering } from './steering.js';

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
    if (event.kind !== 'respawned') return;
    const drive = this.pilot.respawned();
    if (drive) this.ghosts.addDrive(drive);
  }

  /** Where the ghosts are at the server's tick. */
  ghostsAt(tick) { return this.pilot ? this.ghosts.marks(this.pilot.sinceSpawn, this.run.runStart, tick) : []; }

  #askForGhost(board) { this.send({ type: 'get_ghost', board, rank: 1 }); }
}
