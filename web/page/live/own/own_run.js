// @ts-check
// What the rules have said of your own louse lately: what is told in big figures, the chain of crumbs, when the race's run
// began. Time is an argument, in seconds.
import { MOMENTS, signedText, spanText } from '../words.js';

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
