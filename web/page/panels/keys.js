// @ts-check
// The keyboard: keys that are held drive, others do what a button does. Tab is never taken, nor anything with Ctrl, Alt or Meta.

/** @type {Record<string, import('../live/own/steering.js').Control>} by place on the keyboard, whatever letters stand there */
const HELD = {
  KeyW: 'up', ArrowUp: 'up', Numpad8: 'up', KeyS: 'down', ArrowDown: 'down', Numpad2: 'down', KeyA: 'left', ArrowLeft: 'left', Numpad4: 'left',
  KeyD: 'right', ArrowRight: 'right', Numpad6: 'right', Space: 'brake', Numpad5: 'brake',
};
/** What a key does; of a recording those of RECORDING come first. */
const DOES = {
  1: 'orbit', 2: 'follow', 3: 'map', v: 'view', x: 'slope', m: 'theme', n: 'next', p: 'previous', t: 'talk', r: 'respawn', g: 'ghosts', c: 'cruise', i: 'error',
  q: 'turn-left', e: 'turn-right', '+': 'nearer', '=': 'nearer', '-': 'farther', '?': 'help', h: 'help',
};
const RECORDING = { ' ': 'pause', k: 'pause', j: 'back', l: 'on', ',': 'tick-back', '.': 'tick-on', '[': 'slower', ']': 'faster', Home: 'begin', End: 'end', ArrowLeft: 'back', ArrowRight: 'on' };

/** For the help: keys and what they do. */
export const KEYS = [
  ['W A S D, arrows', 'push that way in the picture'], ['Space', 'brake'], ['C', 'cruise: the push stays on'], ['R', 'back to a start'], ['G', 'ghosts: the best, the last, none'],
  ['V, 1 2 3', 'view: orbit, follow, map'], ['X', 'colour by slope'], ['Q E + \u2212', 'turn, nearer, farther; or drag, wheel, pinch'], ['N, P, click', 'follow another louse'],
  ['I', 'how far the steps err'], ['T', 'talk'], ['M', 'light or dark'], ['K J L , . [ ]', 'recording: play, 5 s back or on, a tick, slower or faster'], ['?', 'this list'],
];

export class Keys {
  /**
   * @param {{isRecording: () => boolean, isPlaying: () => boolean, hold: (control: any) => void, release: (control: any) => void, releaseAll: () => void,
   *   act: (action: string) => void}} hands
   */
  constructor(hands) {
    addEventListener('keydown', (event) => this.#down(event, hands));
    addEventListener('keyup', (event) => { if (HELD[event.code]) hands.release(HELD[event.code]); });
    addEventListener('blur', hands.releaseAll);
    document.addEventListener('visibilitychange', hands.releaseAll);
  }

  #down(event, hands) {
    const target = /** @type {HTMLElement} */ (event.target);
    if (event.ctrlKey || event.altKey || event.metaKey || event.isComposing || document.querySelector('dialog[open]')) return;
    if (target.matches('input:not([type=range]), select')) return;
    const isButton = target.matches('button, a') && (event.key === ' ' || event.key === 'Enter');
    const isScrolling = target.matches('[type=range], #said, #scores-table') && /^(Arrow|Home|End)/.test(event.key);
    if (isButton || isScrolling) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const action = hands.isRecording() && RECORDING[key] || !(hands.isPlaying() && HELD[event.code]) && DOES[key];
    if (action) {
      hands.act(action);
      event.preventDefault();
    } else if (HELD[event.code]) {
      if (!event.repeat) hands.hold(HELD[event.code]);
      event.preventDefault();
    }
  }
}
