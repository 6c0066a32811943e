// @ts-check
// The table of scores: who is there, best first, each row a button that follows its louse.
import { byId, fillChildren, made, setClass, setHidden, setText } from './elements.js';

const MOST = 40;

export class Scores {
  #body = byId('scores').querySelector('tbody');

  /** @param {(id: number) => void} follow */
  constructor(follow) {
    this.#body.addEventListener('click', (event) => {
      const button = event.target.closest('button');
      if (button) follow(Number(button.dataset.id));
    });
    const fold = byId('scores-fold'), table = byId('scores-table');
    fold.onclick = () => {
      table.hidden = !table.hidden;
      fold.setAttribute('aria-expanded', String(!table.hidden));
    };
  }

  /** @param {{rows: any[], you: number, followed: number, nameOf: (id: number) => string, colourOf: (id: number) => string, count: string}} shown */
  update({ rows, you, followed, nameOf, colourOf, count }) {
    setText(byId('count'), count);
    if (byId('scores-table').hidden) return;
    const own = rows.findIndex(({ id }) => id === you);
    const shown = own < MOST ? rows.slice(0, MOST) : [...rows.slice(0, MOST - 1), rows[own]];
    fillChildren(this.#body, shown, makeRow, (row, { id, rank, measure, share }) => {
      setClass(row, id === followed ? 'followed' : '');
      const [place, who, what] = row.cells, button = who.firstChild, [dot, name] = button.children;
      setText(place, rank ? String(rank) : '');
      button.dataset.id = id;
      dot.style.background = colourOf(id);
      setText(name, id === you ? 'you' : nameOf(id));
      setText(what.firstChild, measure);
      setHidden(what.lastChild, share < 0.02);
      what.lastChild.style.width = `${share * 100}%`;
    });
  }
}

function makeRow() {
  const row = /** @type {HTMLTableRowElement} */ (made('tr'));
  row.insertCell();
  const button = made('button');
  button.append(made('span', '', 'dot'), made('span'));
  row.insertCell().append(button);
  row.insertCell().append(made('span'), made('span', '', 'share'));
  return row;
}
