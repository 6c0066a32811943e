// @ts-check
// Everything that people do to what is shown, and the panels that tell them of it: wired to a stage that has its first picture.
import { act } from './deeds.js';
import { Teacher } from './live/own/lesson.js';
import { Drop, ask } from './panels/dialogs.js';
import { byId, toast } from './panels/elements.js';
import { Keys } from './panels/keys.js';
import { Panels } from './panels/panels.js';
import { keep, kept, onName, onPalette, setTheme, shortName, theme } from './panels/settings.js';
import { Touch } from './panels/stick.js';

const calm = matchMedia('(prefers-reduced-motion: reduce)');
const MOST = 1 << 30;  // bytes of a recording

const hash = () => new URLSearchParams(location.hash.slice(1));

export class Hands {
  /** @param {import('./stage.js').Stage} stage @param {URLSearchParams} params of the address */
  constructor(stage, params) {
    this.stage = stage;
    this.params = params;
    this.teacher = new Teacher(!kept('lesson'), () => keep('lesson', 'had'), matchMedia('(pointer: coarse)').matches);
    this.panels = new Panels({ follow: (id) => stage.follow(id), say: (text) => stage.room?.say(text), choose: (room) => this.choose(room), seek: (tick) => stage.player?.seek(tick), figure: async () => new (await import('./later.js')).ErrorFigure() });
    this.drop = new Drop((file) => this.open(file, file.name));
    this.#bind();
  }

  /** Into another room; the address names it, for a reload or a friend. @param {string} room */
  choose(room) {
    this.params.set('room', room);
    history.replaceState(null, '', `${location.pathname}?${this.params}`.replaceAll('%2F', '/'));
    this.stage.enter({ room });
  }

  /** Plays, or watches again. */
  async join() {
    if (this.stage.source !== this.stage.room || this.stage.room?.door.wish.role === 'player') return this.stage.enter({ role: 'spectator' });
    const name = shortName(kept('name') || await ask({ title: 'What is your louse called?', label: 'Name' }) || '');
    if (!name) return;
    keep('name', name);
    this.stage.enter({ role: 'player', name });
    this.stage.view('follow');
    byId('picture').focus();
  }

  setTheme(name) {
    setTheme(name);
    this.stage.picture.setTheme(theme());
  }

  /** A recording's bytes. @param {Blob} blob @param {string} name */
  async open(blob, name) {
    const { stage } = this;
    if (blob.size > MOST) return toast('that file is larger than 1 GiB', 'bad');
    toast(`opening ${name}`);
    const { Recording, Player } = await import('./later.js');
    const recording = await Recording.open(stage.core, blob, stage.workers.reader).catch((error) => toast(`${name}: ${error.message}`, 'bad'));
    if (!recording) return;
    stage.player?.close();
    stage.show('recording');
    const isFirst = !stage.file;
    stage.file = name;
    stage.followed = 0;
    const player = stage.player = new Player(recording, toast);
    player.isPlaying = !calm.matches;
    player.onSeek = () => stage.picture.clearTrails();
    this.panels.recording(player);
    const at = isFirst ? hash().get('t') : null;  // the address means the one it came with
    if (at !== null && at !== '') player.seek(Number(at) || player.info.first);
    if (player.info.is_cut_off) toast('this recording ends before its game did');
  }

  async compare() {
    const { stage, panels } = this, { SideBySide, LabPanel, Curves } = await import('./later.js');
    stage.show('lab');
    const lab = stage.lab = new SideBySide(stage.core), clear = () => stage.picture.clearTrails();
    const begin = (isNext) => { lab.begin(isNext); clear(); };
    panels.lab?.end();
    panels.lab = new LabPanel(Curves, { again: () => begin(false), next: () => begin(true), pause: () => { lab.isPlaying = !lab.isPlaying; }, rub: () => { lab.rubs = !lab.rubs; lab.begin(); clear(); } });
  }

  /** Another kind of thing is shown now. @param {'live'|'recording'|'lab'} kind */
  show(kind) {
    if (kind !== 'recording') this.panels.recording(null);
    if (kind !== 'lab') { this.panels.lab?.end(); this.panels.lab = null; }
    this.panels.chat.clear();
  }

  /** A room's door wants a password. @param {string} why */
  async askToken(why) {
    const token = await ask({ title: 'A password, please', label: why, isSecret: true, most: 256 });
    if (token) this.stage.room?.enter(token); else this.stage.room?.stop();
  }

  /** Follows the next louse by its number, or the one before. @param {number} by */
  step(by) {
    const { stage } = this, ids = (stage.source?.lice ?? []).map(({ id }) => id).sort((a, b) => a - b);
    if (!ids.length) return;
    const k = ids.indexOf(stage.followed);
    stage.follow(ids[(k < 0 ? (by > 0 ? 0 : ids.length - 1) : k + by + ids.length) % ids.length]);
  }

  #bind() {
    const { stage } = this, steering = () => (stage.isPlaying ? stage.room?.own.steering : null), seconds = () => performance.now() / 1000;
    const hold = (control) => steering()?.hold(control, seconds()), release = (control) => steering()?.release(control);
    new Keys({ isRecording: () => !!stage.player, isPlaying: () => stage.isPlaying, hold, release, releaseAll: () => steering()?.releaseAll(), act: (action) => act(this, action) });
    new Touch({ stick: (vector) => steering()?.stick(vector), brake: (isHeld) => (isHeld ? hold('brake') : release('brake')) });
    document.addEventListener('click', (event) => {
      const button = /** @type {HTMLElement} */ (event.target).closest('[data-do]');
      if (!(button instanceof HTMLElement)) return;
      act(this, button.dataset.do);
      if (event.detail > 0 && stage.isPlaying && !document.querySelector('dialog[open]')) byId('picture').focus();  // by a pointer: Space brakes again
    });
    addEventListener('keydown', (event) => { if (event.key === 'Escape' && event.target !== byId('say') && !document.querySelector('dialog[open]')) this.teacher.dismiss(); });
    onName();
    onPalette(this.params.get('palette'), (palette) => stage.picture.setPalette(palette));
    addEventListener('hashchange', () => { const at = hash().get('t'); if (stage.player && at) stage.player.seek(Number(at) || 0); });
  }
}
