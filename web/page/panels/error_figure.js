// @ts-check
// How far the steps of a louse err, below its other figures while somebody asks: of your own by the page's World, of a recording's
// followed one by the worker that re-runs it. It is fetched when it is asked for first.
import { LouseError } from '../core/louse_error.js';
import { byId, made, setText } from './elements.js';

const EVERY = 500, MOST_TICKS = 128;  // ms; counted at once, ten times a second

/** As C's %.1e: two digits of the exponent at least. @param {number} value */
const tenths = (value) => value.toExponential(1).replace(/(?<=[+-])\d$/, (digit) => `0${digit}`);

/** In the terminal's words (client/play/spoken_words). @param {import('../core/louse_error.js').ErrorReading | null} reading */
export function errorInWords(reading) {
  if (!reading) return 'error -- m/s of play';  // nothing has counted yet
  return `error ${tenths(reading.of_play)} m/s of play, worst ${tenths(reading.worst)} m at tick ${reading.worst_tick}; twin at half the step ${tenths(reading.apart)} m away after ${reading.apart_seconds.toFixed(0)} s`;
}

export class ErrorFigure {
  #element = made('p', '', 'dim figure'); #saidAt = -Infinity; #saidOf = 0;
  /** @type {LouseError|null} */ #own = null;
  /** Whose steps #own is shown. @type {import('../live/own/prediction.js').Prediction|null} */ #prediction = null;

  constructor() {
    Object.assign(this.#element.style, { maxWidth: '17em', margin: '6px 0 0', fontSize: '12px' });
    byId('louse').append(this.#element);
  }

  /** Ten times a second. @param {any} page @param {number} followed whom the panel shows @param {number} now [ms] */
  update({ room, player }, followed, now) {
    if (player) {
      this.#drop();
      player.measure(followed);
    }
    const text = player ? errorInWords(player.error) : this.#ofRoom(room);
    if (now - this.#saidAt < EVERY && followed === this.#saidOf) return;
    setText(this.#element, text);
    this.#saidAt = now;
    this.#saidOf = followed;
  }

  /** Nobody asks any more, and nothing is computed. @param {any} player */
  end(player) {
    this.#drop();
    player?.measure(0);
    this.#element.remove();
  }

  #ofRoom(room) {
    const pilot = room?.own.pilot, prediction = pilot?.prediction;
    if (!prediction) {
      this.#drop();
      return !pilot ? 'only of your own louse the error is known' : room.ground?.isExact ? 'of steps that are not this page\u2019s no error is known' : 'on an overview of a map no error is known';
    }
    if (prediction !== this.#prediction) {  // another session, map or mode
      this.#drop();
      prediction.error = this.#own = new LouseError(room.ground, room.mode, room.ground.hz);
      this.#prediction = prediction;
    }
    if (!room.louse(room.you)) this.#own?.forget();  // one that is out (of a hill) is predicted on, but plays nothing
    return errorInWords(this.#own?.count(MOST_TICKS) ?? null);
  }

  #drop() {
    if (this.#prediction) this.#prediction.error = null;
    this.#own?.close();
    this.#own = this.#prediction = null;
  }
}
