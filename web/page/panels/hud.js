// @ts-check
// Over the picture: the bar at the top, which room, what is proven, how the line is, and what is wrong with it; below what the game
// wants and says: the lines of the goal, the lesson, big figures, the podium.
import { byId, fillChildren, fillSpans, made, setClass, setHidden, setText } from './elements.js';

export class Hud {
  #splash = '';

  /** @param {{text: string, tone?: string}[][]} lines */
  goal(lines) {
    setHidden(byId('goal'), !lines.length);
    fillChildren(byId('goal'), lines, () => made('div'), fillSpans);
  }

  /** @param {string[]} lines */
  lesson(lines) {
    setHidden(byId('lesson'), !lines.length);
    fillChildren(byId('lesson'), lines, () => made('li'), setText);
  }

  /** @param {{text: string, tone: string}|null} splash */
  splash(splash) {
    const element = byId('splash');
    setHidden(element, !splash);
    if (!splash) return;
    setText(element, splash.text);
    setClass(element, splash.tone);
  }

  /** @param {{id: number, name: string, measure: string, medal: string}[]} steps @param {number} you */
  podium(steps, you) {
    setHidden(byId('podium'), !steps.length);
    fillChildren(byId('podium'), steps, () => { const item = made('li'); item.append(made('span'), made('span'), made('span'), made('span', '', 'goal')); return item; },
      (item, { id, name, measure, medal }, k) => {
        [`${k + 1}.`, id === you ? `${name} (you)` : name, measure, medal].forEach((text, column) => setText(item.children[column], text));
      });
  }
}

export class TopBar {
  #rooms = '';

  /** @param {(room: string) => void} choose */
  constructor(choose) {
    const select = byId('room');
    select.onchange = () => {
      choose(select.value);
      byId('picture').focus();
    };
  }

  /** @param {string[]} names @param {any[]} counts of the message `rooms` @param {string} chosen */
  rooms(names, counts, chosen) {
    const labels = names.map((name) => {
      const room = counts.find((each) => each.name === name), lice = room ? room.players + room.bots : 0;
      return (lice ? `${name} (${lice})` : name) + (room?.address ? ', at another server' : '');
    });
    const select = byId('room'), said = [...labels, chosen].join('\n');
    if (said === this.#rooms || document.activeElement === select && labels.length === select.options.length) return;
    this.#rooms = said;
    fillChildren(select, names, () => made('option'), (option, name, k) => { option.value = name; setText(option, labels[k]); });
    select.value = chosen;
    const code = counts.find((each) => each.name === chosen)?.code;
    select.title = code ? `the room's code, to join it by: ${code}` : '';
  }

  /** @param {{text: string, tone: string, why?: string}} proof */
  proof({ text, tone, why }) {
    const output = byId('proof');
    setText(output, text);
    setClass(output, `figure ${tone}`);
    output.title = why ?? text;
  }

  line(text) { setText(byId('line'), text); }

  /** @param {string} text what is wrong with the line; '': nothing @param {boolean} mayAsk a person can do something @param {string} [link] where else the room is */
  lost(text, mayAsk, link = '') {
    const [said, away] = byId('lost').children;
    setHidden(byId('lost'), !text);
    setText(said, text);
    setHidden(away, !link);
    if (link && away.href !== link) away.href = link;
    setHidden(byId('lost').lastElementChild, !mayAsk);
  }
}
