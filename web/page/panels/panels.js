// @ts-check
// All panels together, told what there is: some things with each frame, the rest ten times a second.
import { linkTo } from '../live/elsewhere.js';
import { goalLines, podium, proofOf, scoreRows } from '../live/goal.js';
import { farewell, rulesInWords } from '../live/words.js';
import { Chat } from './chat.js';
import { showHelp } from './dialogs.js';
import { byId, setHidden, setPressed, setText } from './elements.js';
import { Hud, TopBar } from './hud.js';
import { LousePanel } from './louse_panel.js';
import { RecordingBar } from './recording_bar.js';
import { Scores } from './scores.js';

const SCORES_EVERY = 250;  // ms: forty rows of text
/** What covers the picture, or says how large it is. */
const COVERING = ['over', 'top', 'goal', 'lesson', 'scores', 'louse', 'bar', 'lab', 'recording'];

const plural = (count, one, many) => `${count} ${count === 1 ? one : many}`;

export class Panels {
  /** @type {import('./lab_panel.js').LabPanel|null} */ lab = null;
  /** @type {import('./error_figure.js').ErrorFigure|null} while somebody asks */ #error = null;
  /** @type {any} */ #facts = null;
  #scoredAt = -Infinity; #scored = 0; #haveMoved = true;

  /** @param {{follow: (id: number) => void, say: (text: string) => void, choose: (room: string) => void, seek: (tick: number) => void, figure: () => Promise<import('./error_figure.js').ErrorFigure>}} hands */
  constructor({ follow, say, choose, seek, figure }) {
    this.figure = figure;
    this.top = new TopBar(choose);
    this.scores = new Scores(follow);
    this.louse = new LousePanel();
    this.chat = new Chat(say, () => byId('picture').focus());
    this.hud = new Hud();
    this.bar = new RecordingBar({ seek });
    const moves = new ResizeObserver(() => { this.#haveMoved = true; });  // to ask with each frame costs a layout
    for (const id of COVERING) moves.observe(byId(id));
  }

  /** A recording begins, or null: there is none any more. @param {import('../live/player.js').Player|null} player */
  recording(player) { if (player) this.bar.begin(player); else this.bar.end(); }

  help(source) { showHelp(source?.welcome ? rulesInWords(source.mode, source.welcome.rules) : ''); }

  /** Shows how far steps err, or no more. @param {import('../live/player.js').Player|null} player */
  async toggleError(player) {
    if (this.#error) {
      this.#error.end(player);
      this.#error = null;
      return;
    }
    const figure = await this.figure();
    this.#error ??= figure;  // asked twice while it came
  }

  /** With each frame. @param {any} source @param {any} facts @param {number} now [s] */
  every(source, facts, now) {
    this.#facts = facts;
    this.hud.goal(goalLines(facts));
    this.hud.splash(facts.run?.splash(now) ?? null);
    this.hud.podium(podium(facts), source.you ?? 0);
  }

  /** Ten times a second. @param {any} page */
  update(page) {
    const { room, player, source, picture, isPlaying } = page, { camera } = picture, colourOf = (id) => picture.colourOf(id && id === source?.you ? 'you' : id);
    for (const view of ['orbit', 'follow', 'map']) setPressed(view, camera.view === view);
    setPressed('slope', picture.shading === 'slope');
    this.#legend(picture.legend);
    setPressed('cruise', !!room?.own.steering.isCruising);
    setPressed('pad', document.body.hasAttribute('data-pad'));
    const join = document.querySelector('[data-do=join]');
    setText(join, source !== room ? 'Live' : room?.door.wish.role === 'player' ? 'Watch' : 'Play');
    join?.classList.toggle('go', join.textContent !== 'Watch');
    this.#line(room);
    if (this.#haveMoved && byId('over').offsetWidth > 0) {  // not before they are shown
      this.#insets(camera);
      this.#haveMoved = false;
    }
    if (room && source === room) this.#room(room, picture, colourOf, isPlaying ? page.hands.teacher.observe(room, performance.now() / 1000) : []);
    if (player) this.bar.update(player);
    if (page.lab) { setText(byId('proof'), ''); this.top.line('a laboratory'); return this.lab?.update(page.lab); }
    if (player) { this.chat.update(player, colourOf); setText(byId('proof'), ''); this.top.line(`${player.info.name}${player.info.mode === 'roam' ? '' : `/${player.info.mode}`}, a recording`); }
    const facts = this.#facts;
    if (!facts || !source?.ground) return;
    source.rows = scoreRows(facts);
    const marked = page.followed || source.you || 0, followed = marked || source.rows[0]?.id || 0, nameOf = (id) => source.nameOf(id), now = performance.now();
    if (marked !== this.#scored || now - this.#scoredAt >= SCORES_EVERY) {
      this.scores.update({ rows: source.rows, you: source.you ?? 0, followed: marked, nameOf, colourOf, count: this.#count(source) });
      this.#scored = marked;
      this.#scoredAt = now;
    }
    const louse = source.louse(followed);
    this.louse.update(louse && { ...louse, ...source.ground.sample(louse.x, louse.y) }, followed === source.you ? `${nameOf(followed)} (you)` : nameOf(followed));
    this.#error?.update(page, followed, now);
  }

  #room(room, picture, colourOf, lesson) {
    this.hud.lesson(lesson);
    this.chat.update(room.roster, colourOf);
    this.top.rooms(room.rooms.length ? room.rooms.map(({ name }) => name) : room.door.rooms, room.rooms, room.welcome?.room ?? room.door.wish.room);
    this.top.proof(proofOf(room));
    const high = picture.exaggeration === 1 ? '' : `heights \u00d7${picture.exaggeration.toFixed(1)}`;
    this.top.line([room.trip === null ? '' : `${(room.trip * 1000).toFixed(0)} ms`, high].filter(Boolean).join(', '));
    setHidden(document.querySelector('[data-do=skip]'), !room.door.has('rotation') || room.welcome?.room !== 'rotation');
  }

  #legend(legend) {
    const line = byId('legend');
    setHidden(line, !legend);
    if (!legend) return;
    const [colours, steepest] = line.children;
    setText(steepest, `${Math.round(legend.steepest)}\u00b0`);
    if (line.dataset.of === legend.gradient) return;
    line.dataset.of = legend.gradient;
    colours.style.background = legend.gradient;
  }

  #line(room) {
    const lost = room?.lost, again = lost?.again == null ? null : Math.max(0, lost.again - performance.now() / 1000);
    const silence = room?.silence ?? null;
    if (lost) this.top.lost(`${capital(farewell(lost))}. ${again === null ? '' : `Trying again in ${again.toFixed(0)} s.`}`, true, lost.address && linkTo(lost.address, room.door.room || room.door.wish.room, location.href));
    else if (silence !== null) this.top.lost(`The server has not spoken for ${silence.toFixed(1)} s.`, false);
    else this.top.lost(room?.stands && room.lice.length ? 'The room is paused: no tick passes.' : '', false);
  }

  /** What the panels cover of the picture: the map is fitted into what is free. */
  #insets(camera) {
    const over = byId('over').getBoundingClientRect(), isNarrow = over.width <= 760 || over.height <= 480;
    const box = (id) => byId(id).getBoundingClientRect(), tall = (id) => box(id).height;
    const wide = (id) => box(id).width + 12;
    const isLow = isNarrow && over.width > 760;  // a phone on its side: panels stand left and right
    camera.insets = isLow ? { left: Math.max(wide('goal'), wide('lesson')), right: wide('scores'), top: box('top').bottom + 4, bottom: over.height - Math.min(...['bar', 'lab', 'recording'].filter(tall).map((id) => box(id).top)) }
      : isNarrow ? { left: 0, right: 0, top: Math.max(box('top').bottom, box('goal').bottom, box('lesson').bottom) + 4, bottom: over.height - Math.min(...['bar', 'lab', 'recording'].filter(tall).map((id) => box(id).top)) }
      : { left: wide('lab'), right: Math.max(wide('scores'), wide('louse')), top: Math.max(tall('top') + 20, box('goal').bottom + 8), bottom: over.height - Math.min(...['bar', 'recording'].filter(tall).map((id) => box(id).top)) };
  }

  #count(source) {
    const lice = source.lice.length, bots = source.lice.filter(({ id }) => source.isBot(id)).length, spectators = source.roster?.spectators ?? 0;
    return [plural(lice, 'louse', 'lice'), bots ? plural(bots, 'bot', 'bots') : '', spectators ? `${spectators} watching` : ''].filter(Boolean).join(', ');
  }
}

const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);
