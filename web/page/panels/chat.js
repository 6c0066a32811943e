// @ts-check
// What was said, and a line to say something.
import { byId, made } from './elements.js';

export class Chat {
  #said = 0; #list = byId('said');

  /** @param {(text: string) => void} say @param {() => void} done the hands are free again */
  constructor(say, done) {
    const input = byId('say');
    byId('chat').querySelector('form').onsubmit = (event) => {
      event.preventDefault();
      if (input.value.trim()) say(input.value);
      input.value = '';
      this.close();
      done();
    };
    input.onkeydown = (event) => {
      if (event.key !== 'Escape') return;
      this.close();
      done();
    };
  }

  /** Another room or recording begins. */
  clear() {
    this.#said = 0;
    this.#list.replaceChildren();
  }

  open() {
    document.body.dataset.talks = '';
    byId('say').focus();
  }
  close() { delete document.body.dataset.talks; }

  /** Adds what is new. @param {{lines: {from: string, id: number, text: string}[], said: number}} roster @param {(id: number) => string} colourOf */
  update({ lines, said }, colourOf) {
    const isNew = Math.min(said - this.#said, lines.length);
    if (isNew <= 0) return;
    this.#said = said;
    for (const { from, id, text } of lines.slice(-isNew)) {
      const item = made('li', from ? '' : text, from ? '' : 'dim');
      if (from) {
        const name = made('b', from);
        const dot = made('span', '', 'dot');
        dot.style.background = id ? colourOf(id) : 'transparent';
        item.append(dot, name, ` ${text}`);
      }
      this.#list.append(item);
    }
    while (this.#list.children.length > lines.length) this.#list.firstElementChild.remove();
    this.#list.scrollTop = this.#list.scrollHeight;
  }
}
