// @ts-check
// The bar of a recording: where it stands, its marks, what is proven.
import { byId, fillChildren, made, setClass, setHidden, setText } from './elements.js';

const SIGNS = { join: '+', leave: '\u00d7', respawn: 'o', chat: '!' };
const MOST_MARKS = 150;

/** Minutes and seconds: 1:02.3. */
export function timeText(seconds) {
  const tenths = Math.floor(Math.max(0, seconds) * 10 + 1e-6);
  return `${Math.floor(tenths / 600)}:${String(Math.floor(tenths / 10) % 60).padStart(2, '0')}.${tenths % 10}`;
}

export class RecordingBar {
  /** @param {{seek: (tick: number) => void}} hands */
  constructor(hands) {
    this.hands = hands;
    byId('seek').oninput = () => hands.seek(Number(byId('seek').value));
    byId('marks').onclick = (event) => {
      const mark = event.target.closest('button');
      if (mark) hands.seek(Number(mark.dataset.tick));
    };
  }

  /** Another recording. @param {import('../live/player.js').Player} player */
  begin(player) {
    const { first, last, marks, hz } = player.info, seek = byId('seek');
    setHidden(byId('recording'), false);
    seek.min = first;
    seek.max = last;
    const step = Math.max(1, Math.ceil(marks.length / MOST_MARKS));  // of more each so many-th is shown
    fillChildren(byId('marks'), marks.filter((_, k) => k % step === 0), () => made('button'), (button, { tick, kind, id }) => {
      button.dataset.tick = tick;
      button.style.left = `${(tick - first) / Math.max(1, last - first) * 100}%`;
      setText(button, SIGNS[kind] ?? '\u00b7');
      button.title = `${kind} ${id ? player.nameOf(id) : ''} ${timeText((tick - first) / hz)}`;
      button.setAttribute('aria-label', button.title);
      button.tabIndex = -1;  // they are many: the slider has the keyboard
    });
  }
  end() { setHidden(byId('recording'), true); }

  /** @param {import('../live/player.js').Player} player */
  update(player) {
    const { first, last, hz } = player.info, seek = byId('seek'), tick = Math.floor(player.tick);
    if (Number(seek.value) !== tick) seek.value = tick;
    seek.setAttribute('aria-valuetext', `tick ${tick}, ${timeText((tick - first) / hz)}`);
    setText(byId('speed'), `${player.speed < 1 ? `1/${1 / player.speed}` : player.speed}\u00d7`);
    setText(byId('time'), `${timeText((tick - first) / hz)} / ${timeText((last - first) / hz)} \u00b7 tick ${tick}`);
    const pause = byId('recording').querySelector('[data-do=pause]');
    setText(pause, player.isPlaying ? '\u275a\u275a' : '\u25b6');
    const { text, tone } = player.proof, wrong = byId('wrong');
    setHidden(wrong, !player.difference);
    if (player.difference) wrong.style.left = `${(player.difference.tick - first) / Math.max(1, last - first) * 100}%`;
    setText(byId('verdict'), text);
    setClass(byId('verdict'), `figure ${tone}`);
  }
}
