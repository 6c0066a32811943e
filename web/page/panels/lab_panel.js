// @ts-check
// What a stranger is told of the two runs side by side, and their curves.
import { byId, made, setText } from './elements.js';

export class LabPanel {
  #apart; #energies; #curves;

  /** @param {any} Curves picture/curves.js @param {{again: () => void, next: () => void, pause: () => void, rub: () => void}} hands */
  constructor(Curves, hands) {
    const panel = byId('lab');
    const paragraph = (...parts) => { const element = made('p'); element.append(...parts); return element; };
    const canvas = (label) => { const element = made('canvas'); element.setAttribute('role', 'img'); element.setAttribute('aria-label', label); return element; };
    const button = (text, act) => { const element = made('button', text); element.onclick = act; return element; };
    this.#apart = made('h2');
    this.#energies = made('h2');
    const distance = canvas('How far the two runs are apart, over time'), energy = canvas('The energy of both runs, over time');
    this.rub = button('Drag and friction', hands.rub);
    this.law = made('p');
    this.pause = button('Pause', hands.pause);
    const buttons = made('div', '', 'buttons');
    buttons.append(this.rub, button('Again', hands.again), button('Another start', hands.next), this.pause);
    panel.append(made('h2', 'Side by side'),
      paragraph('Two lice set off from one place, equally fast, and nobody pushes. ', made('span', '2002', 'document'), ' rolls as a paper of 2002 computed it, ', made('span', 'exact', 'exact'),
        ' as this server does: the same hill, the paper\u2019s errors put right.'),
      this.#apart, distance, this.#energies, energy, this.law, buttons, paragraph('The page runs the server\u2019s own C++ for both.'));
    panel.hidden = false;
    this.#curves = [new Curves(distance), new Curves(energy)];
  }

  /** The laboratory is left. */
  end() {
    byId('lab').replaceChildren();
    byId('lab').hidden = true;
  }

  /** @param {import('../lab/side_by_side.js').SideBySide} lab */
  update(lab) {
    const percent = (part) => `${part < -5e-7 ? '\u2212' : part > 5e-7 ? '+' : '\u00b1'}${(Math.abs(part) * 100).toFixed(Math.abs(part) < 0.001 ? 4 : 1)} %`;
    setText(this.#apart, `Apart: ${lab.apart.toFixed(lab.apart < 1 ? 3 : 1)} m after ${lab.seconds.toFixed(0)} s`);
    setText(this.#energies, `Energy: 2002 ${percent(lab.change('paper'))}, exact ${percent(lab.change('exact'))}`);
    this.rub.setAttribute('aria-pressed', String(lab.rubs));
    setText(this.pause, lab.isPlaying ? 'Pause' : 'Go on');
    setText(this.law, lab.rubs ? 'Drag and friction act: energy may only fall.' : 'Nothing rubs and nobody pushes, so energy must stay as it was.');
    const { t, distance, paper, exact } = lab.series;
    this.#curves[0].draw([{ name: 'apart [m]', x: t, y: distance, tone: 'usual' }]);
    this.#curves[1].draw([{ name: '2002 [J/kg]', x: t, y: paper, tone: 'document' }, { name: 'exact', x: t, y: exact, tone: 'exact' }]);
  }
}
