// @ts-check
// The bar at the top: which room, what is proven, how the line is; and in the middle, what is wrong with it.
import { byId, fillChildren, made, setClass, setHidden, setText } from './elements.js';

export class TopBar {
  #rooms = '';

  /** @param {(room: string) => void} choose */
  constructor(choose) {
    const select = byId('room');
    select.onchange = () => choose(select.value);
  }

  /** @param {string[]} names @param {any[]} counts of the message `rooms` @param {string} chosen */
  rooms(names, counts, chosen) {
    const labels = names.map((name) => {
      const room = counts.find((each) => each.name === name), lice = room ? room.players + room.bots : 0;
      return lice ? `${name} (${lice})` : name;
    });
    const select = byId('room'), said = [...labels, chosen].join('\n');
    if (said === this.#rooms || document.activeElement === select && labels.length === select.options.length) return;
    this.#rooms = said;
    fillChildren(select, names, () => made('option'), (option, name, k) => { option.value = name; setText(option, labels[k]); });
    select.value = chosen;
  }

  /** @param {{text: string, tone: string}} proof */
  proof({ text, tone }) {
    const output = byId('proof');
    setText(output, text);
    setClass(output, `figure ${tone}`);
    output.title = text;
  }

  line(text) { setText(byId('line'), text); }

  /** @param {string} text what is wrong with the line; '': nothing @param {boolean} mayAsk a person can do something */
  lost(text, mayAsk) {
    setHidden(byId('lost'), !text);
    setText(byId('lost').firstElementChild, text);
    setHidden(byId('lost').lastElementChild, !mayAsk);
  }
}
