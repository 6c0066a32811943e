// @ts-check
// What the game wants and says, over the picture: the lines of the goal, the lesson, big figures, the podium.
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
