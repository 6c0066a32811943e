// @ts-check
// How the page asks to come in: the join for a server that has said hello, and what is to be done where it is refused.
import { COLUMNS, RULES_COLUMNS } from './frames.js';

const PLAYER_HZ = 20, WATCHER_HZ = 10, STREAM_HZ = 20, HIDDEN_HZ = 1;

/** @typedef {{role: 'player'|'spectator', name: string, room: string, token: string}} Wish */

export class Door {
  #byFrames = false; #halves = 0;
  /** The token of the louse that waits; '' none. */ resume = '';
  /** Nobody looks at the page. */ isHidden = false;
  /** The map is too big for the page to know its heights. */ wantsHeights = false;
  /** The server's behavior; null before its hello. @type {number|null} */ behavior = null;
  features = [];
  /** @type {string[]} */ rooms = [];

  /** @param {Wish} wish @param {number} ownBehavior of the page's core */
  constructor(wish, ownBehavior) {
    this.wish = wish;
    this.ownBehavior = ownBehavior;
  }

  /** Whether what the page computes is what the server does. */
  get isSame() { return this.behavior === this.ownBehavior; }
  has(feature) { return this.features.includes(feature); }
  get isByInputs() { return this.wish.role === 'spectator' && !this.#byFrames && this.isSame && this.has('inputs'); }
  /** From now on: the stream differs from what is re-run here, or the room can't be watched so. */
  watchByFrames() { this.#byFrames = true; }
  /** Half as many frames would do; false: there are few already. */
  halve() {
    if (this.#halves === 4) return false;
    this.#halves++;
    return true;
  }

  /** The join for a server that said this hello. */
  joinOf(hello) {
    ({ behavior: this.behavior, features: this.features, rooms: this.rooms } = hello);
    const { role, name, token } = this.wish, isPlayer = role === 'player';
    const room = hello.rooms.includes(this.wish.room) ? this.wish.room : hello.rooms[0] ?? '';
    const hz = isPlayer ? PLAYER_HZ : this.isByInputs ? STREAM_HZ : WATCHER_HZ;
    const fields = [...COLUMNS, ...(this.wantsHeights ? ['z'] : []), ...(this.has('rules') ? RULES_COLUMNS : [])];
    return {
      role, name, room, fields, state_hz: this.isHidden ? HIDDEN_HZ : Math.max(1, hz >> this.#halves),
      ...(isPlayer ? { resume: this.resume || true } : {}), ...(token ? { token } : {}), ...(this.isByInputs ? { stream: 'inputs' } : {}),
    };
  }

  /** A refusal before the welcome. @returns {'again'|'token'|'wait'|'over'} say join again at once, ask for a password, wait, give up */
  refused(error) {
    if (error.code === 'bad_field' && this.isByInputs) { this.watchByFrames(); return 'again'; }
    if (error.code === 'bad_token') return 'token';
    if (error.code === 'unknown_room') { this.wish.room = ''; return 'again'; }
    return error.fatal || ['bad_field', 'bad_json', 'missing_field'].includes(error.code) ? 'over' : 'wait';
  }
}
