// @ts-check
// What is shown: a room that is watched or played, a recording, or two runs side by side; wired to the picture and the panels.
import { act } from './deeds.js';
import { Room } from './live/room.js';
import { sceneOf } from './live/goal.js';
import { Teacher } from './live/own/lesson.js';
import { CanvasInput, Touch } from './panels/pointers.js';
import { ask, Drop } from './panels/dialogs.js';
import { byId, toast } from './panels/elements.js';
import { Keys } from './panels/keys.js';
import { Panels } from './panels/panels.js';
import { keep, kept, onName, onPalette, onSystemTheme, setTheme, shortName, storage, theme } from './panels/settings.js';
import { Picture } from './picture/picture.js';

const HIDDEN_AFTER = 3000, PANELS_EVERY = 100;  // ms
const PANELS_BY = 2500;  // ms from the navigation on; before, they wait for the picture: where a processor draws they take as long

const params = new URLSearchParams(location.search);
const hash = () => new URLSearchParams(location.hash.slice(1));
const calm = matchMedia('(prefers-reduced-motion: reduce)');

export class Stage {
  /** @type {Room|null} */ room = null;
  /** @type {import('./live/player.js').Player|null} */ player = null;
  /** @type {import('./lab/side_by_side.js').SideBySide|null} */ lab = null;
  followed = 0;
  /** @type {any} */ #ground = null;
  /** How the last room was entered; also after a recording. @type {any} */ #wish = {};
  #panelsAt = 0; #hiding = 0; /* whether the panels are there */ #isWhole = false;
  /** The recording's name. */ file = '';

  /** @type {any} */ #core = null;
  /** Not before begin(). @type {Picture} */ picture = /** @type {any} */ (null);

  /** @param {{baker: () => Worker, reader: () => Worker}} workers begin a worker of picture/bake.js, of core/recording_worker.js */
  constructor(workers) {
    this.workers = workers;
    const chosen = params.get('theme') || kept('theme');
    if (chosen) setTheme(chosen);
    this.teacher = new Teacher(!kept('lesson'), () => keep('lesson', 'had'), matchMedia('(pointer: coarse)').matches);
    this.panels = new Panels({ follow: (id) => this.follow(id), say: (text) => this.room?.say(text), choose: (room) => this.choose(room), seek: (tick) => this.player?.seek(tick) });
  }

  /** Makes the picture, and lets people at it. Throws an Error where there is no WebGL 2. */
  begin() {
    this.picture = new Picture(byId('picture'), byId('labels'), { calm: calm.matches, baker: this.workers.baker });
    this.picture.setTheme(theme());
    this.#bindHands();
  }

  /** The physics, which comes after the page; null before. @returns {any} */
  get core() { return this.#core; }
  set core(core) {
    this.#core = core;
    this.room?.setCore(core);
  }

  /** What is shown. @returns {any} */
  get source() { return this.lab ?? this.player ?? this.room; }
  get isPlaying() { return this.source === this.room && !!this.room?.you; }

  /** The core came to its end, and here is another. @param {any} core */
  replaceCore(core) {
    this.#core = core;
    toast('the physics had to begin anew', 'bad');
    if (this.lab) this.compare(); else this.enter();
  }

  /** Into a room, as before but for what `change` says. */
  enter(change = {}) {
    const wish = /** @type {import('./live/link.js').Wish} */ ({ role: 'spectator', name: kept('name') || 'guest', room: params.get('room') ?? '', token: '', ...this.#wish, resume: '', ...change });
    const lines = wish.room === this.#wish.room ? this.room?.roster.lines ?? [] : [];  // what was said stays, in the same room
    this.#wish = wish;
    this.room?.stop();
    this.#show('live');
    this.followed = 0;
    this.room = new Room({ url: new URL('ws', location.href).href.replace(/^http/, 'ws'), core: this.core, wish, storage, onNotice: toast, onTokenWanted: (why) => this.#askToken(why) });
    for (const line of lines) this.room.roster.say(line.from, line.text, line.id);
    document.body.dataset.role = wish.role;
    this.room.start();
  }

  /** What a page that is loaded anew needs to be put back into its louse; null: nobody plays. */
  get back() { return this.isPlaying && this.room?.door.resume ? { name: this.room.door.wish.name, room: this.room.welcome?.room ?? '', resume: this.room.door.resume } : null; }

  /** Into another room; the address names it, for a reload or a friend. @param {string} room */
  choose(room) {
    params.set('room', room);
    history.replaceState(null, '', `${location.pathname}?${params}`.replaceAll('%2F', '/'));
    this.enter({ room });
  }

  /** Plays, or watches again. */
  async join() {
    if (this.source !== this.room || this.room?.door.wish.role === 'player') return this.enter({ role: 'spectator' });
    const name = shortName(kept('name') || await ask({ title: 'What is your louse called?', label: 'Name' }) || '');
    if (!name) return;
    keep('name', name);
    this.enter({ role: 'player', name });
    this.view('follow');
    byId('picture').focus();
  }

  follow(id) {
    this.followed = id;
    if (id && this.picture.camera.view === 'orbit') this.view('follow');
    if (this.source === this.room && id !== this.room?.you) history.replaceState(null, '', id ? `#louse=${encodeURIComponent(this.room?.roster.nameOf(id) ?? id)}` : location.pathname + location.search);
  }

  view(name) {
    this.picture.camera.view = name;
    if (name === 'follow' && !this.followed && this.room?.door.wish.role !== 'player') this.followed = this.source?.rows?.[0]?.id ?? 0;  // the one that the panel names
  }

  setTheme(name) {
    setTheme(name);
    this.picture.setTheme(theme());
  }

  /** A recording's bytes. @param {Blob} blob @param {string} name */
  async open(blob, name) {
    toast(`opening ${name}`);
    const { Recording, Player } = await import('./later.js');
    const recording = await Recording.open(this.core, blob, this.workers.reader).catch((error) => toast(`${name}: ${error.message}`, 'bad'));
    if (!recording) return;
    this.player?.close();
    this.#show('recording');
    const isFirst = !this.file;
    this.file = name;
    this.followed = 0;
    const player = this.player = new Player(recording, toast);
    player.isPlaying = !calm.matches;
    player.onSeek = () => this.picture.clearTrails();
    this.panels.recording(player);
    const at = isFirst ? hash().get('t') : null;  // the address means the one it came with
    if (at !== null && at !== '') player.seek(Number(at) || player.info.first);
    if (player.info.is_cut_off) toast('this recording ends before its game did');
  }

  async compare() {
    const { SideBySide, LabPanel, Curves } = await import('./later.js');
    this.#show('lab');
    this.lab = new SideBySide(this.core);
    const lab = this.lab, rub = () => { lab.rubs = !lab.rubs; lab.begin(); this.picture.clearTrails(); };
    const begin = (isNext) => { lab.begin(isNext); this.picture.clearTrails(); };
    this.panels.lab?.end();
    this.panels.lab = new LabPanel(Curves, { again: () => begin(false), next: () => begin(true), pause: () => { lab.isPlaying = !lab.isPlaying; }, rub });
  }

  #show(kind) {
    if (kind !== 'recording') { this.player?.close(); this.player = null; this.panels.recording(null); }
    if (kind !== 'live') { this.room?.stop(); this.room = null; }
    if (kind !== 'lab') { this.lab = null; this.panels.lab?.end(); this.panels.lab = null; }
    this.panels.chat.clear();
    document.body.dataset.source = kind;
    if (kind !== 'live') document.body.dataset.role = 'none';
  }

  async #askToken(why) {
    const token = await ask({ title: 'A password, please', label: why, isSecret: true, most: 256 });
    if (token) this.room?.enter(token); else this.room?.stop();
  }

  /** Follows the next louse by its number, or the one before. */
  step(by) {
    const ids = (this.source?.lice ?? []).map(({ id }) => id).sort((a, b) => a - b);
    if (!ids.length) return;
    const k = ids.indexOf(this.followed);
    this.follow(ids[(k < 0 ? (by > 0 ? 0 : ids.length - 1) : k + by + ids.length) % ids.length]);
  }

  #bindHands() {
    const steering = () => (this.isPlaying ? this.room?.own.steering : null), seconds = () => performance.now() / 1000;
    const hold = (control) => steering()?.hold(control, seconds()), release = (control) => steering()?.release(control);
    new Keys({ isRecording: () => !!this.player, isPlaying: () => this.isPlaying, hold, release, releaseAll: () => steering()?.releaseAll(), act: (action) => act(this, action) });
    new Touch({ stick: (vector) => steering()?.stick(vector), brake: (isHeld) => (isHeld ? hold('brake') : release('brake')) });
    new CanvasInput({ turn: (dx, dy) => this.picture.camera.turn(dx, dy), zoom: (factor) => this.picture.camera.zoom(factor), click: (x, y) => { const id = this.picture.pick(x, y); if (id) this.follow(id); } });
    this.drop = new Drop((file) => this.open(file, file.name), (text) => toast(text, 'bad'));
    document.addEventListener('click', (event) => {
      const button = /** @type {HTMLElement} */ (event.target).closest('[data-do]');
      if (!(button instanceof HTMLElement)) return;
      act(this, button.dataset.do);
      if (event.detail > 0 && this.isPlaying && !document.querySelector('dialog[open]')) byId('picture').focus();  // by a pointer: Space brakes again
    });
    addEventListener('keydown', (event) => { if (event.key === 'Escape' && event.target !== byId('say') && !document.querySelector('dialog[open]')) this.teacher.dismiss(); });
    onName();
    onPalette(params.get('palette'), (palette) => this.picture.setPalette(palette));
    onSystemTheme(() => this.picture.setTheme(theme()));
    document.addEventListener('visibilitychange', () => {
      clearTimeout(this.#hiding);
      if (document.hidden) this.#hiding = setTimeout(() => this.room?.hide(true), HIDDEN_AFTER); else this.room?.hide(false);
    });
    addEventListener('hashchange', () => { const at = hash().get('t'); if (this.player && at) this.player.seek(Number(at) || 0); });
  }

  frame(now) {
    requestAnimationFrame((next) => this.frame(next));
    const { source, picture } = this, seconds = performance.now() / 1000;  // what is sent bears the time at which it is, not the picture's
    if (this.isPlaying) this.room?.own.steering.lookAlong(this.picture.camera.azimuth);
    source?.update(seconds);
    if (source?.ground && source.ground !== this.#ground) this.#setGround(source.ground);
    if (source?.ground && source.isKnown !== false) {  // a ground without its lice would only hold up the first picture
      this.#chooseFollowed();
      const facts = source.facts?.(this.followed || source.you || 0);
      byId('picture').classList.remove('early');
      picture.draw(sceneOf(source, this.followed || source.you || 0, facts ? source.marks(facts) : null), now);
      if (facts && this.#isWhole) this.panels.every(source, { ...facts, azimuth: picture.camera.azimuth }, seconds);
    }
    if (!this.#isWhole && (picture.peopled > 1 || now > PANELS_BY)) {
      this.#isWhole = true;
      byId('over').classList.remove('early');
    }
    if (this.#isWhole && now - this.#panelsAt >= PANELS_EVERY) {
      this.#panelsAt = now;
      this.panels.update(this);
    }
  }

  /** Who an address names is followed once he is there. */
  #chooseFollowed() {
    const wanted = !this.followed && this.source === this.room ? hash().get('louse') : null;
    if (wanted && !this.room?.you) this.followed = this.room?.roster.find(wanted) ?? 0;
    if (this.followed && this.followed !== this.source.you && this.source.lice.length && !this.source.louse?.(this.followed) && this.isPlaying) this.followed = 0;
  }

  #setGround(ground) {
    const { columns, rows } = this.picture.gridFor(ground.domain);
    this.picture.setGround({ domain: ground.domain, wraps: ground.wraps, centre: ground.centre, edges: this.source.mode === 'hill' && this.source.welcome?.rules?.edge === 'fall' ? 'open' : ground.edges, columns, rows, grid: ground.grid(columns, rows) });
    this.picture.clearTrails();
    this.#ground = ground;
  }
}
