// @ts-check
// What is shown: a room that is watched or played, a recording, or two runs side by side; wired to the picture. What the first
// picture does without comes behind it, or when it is asked for: hands.js, by whole.js.
import { Room } from './live/room.js';
import { sceneOf } from './live/scene.js';
import { CanvasInput } from './panels/pointers.js';
import { Early } from './panels/early.js';
import { byId, toast } from './panels/elements.js';
import { kept, onSystemTheme, setTheme, storage, theme } from './panels/settings.js';
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
  /** Panels, keys, what they do; null: they are still to come. @type {import('./hands.js').Hands|null} */ hands = null;
  /** @type {typeof import('./whole.js')|null} */ #parts = null;
  /** @type {Promise<import('./hands.js').Hands>|null} */ #coming = null;
  /** The picture has begun. @type {() => void} */ #onBegun = () => {};
  /** @type {Promise<void>} */ #begun = new Promise((resolve) => { this.#onBegun = resolve; });
  #isAsked = false; #early = new Early(() => this.whole().catch(() => {}), (file) => this.open(file, file.name).catch(() => {}));

  /** @type {any} */ #core = null;
  /** Not before begin(). @type {Picture} */ picture = /** @type {any} */ (null);

  /** @param {{baker: () => Worker, reader: () => Worker}} workers begin a worker of picture/bake.js, of core/recording_worker.js */
  constructor(workers) {
    this.workers = workers;
    const chosen = params.get('theme') || kept('theme');
    if (chosen) setTheme(chosen);
  }

  /** Makes the picture, and lets people at it. Throws an Error where there is no WebGL 2. */
  begin() {
    this.picture = new Picture(byId('picture'), byId('labels'), { calm: calm.matches, baker: this.workers.baker });
    this.picture.setTheme(theme());
    new CanvasInput({ turn: (dx, dy) => this.picture.camera.turn(dx, dy), zoom: (factor) => this.picture.camera.zoom(factor), click: (x, y) => { const id = this.picture.pick(x, y); if (id) this.follow(id); } });
    onSystemTheme(() => this.picture.setTheme(theme()));
    document.addEventListener('visibilitychange', () => {
      clearTimeout(this.#hiding);
      if (document.hidden) this.#hiding = setTimeout(() => this.room?.hide(true), HIDDEN_AFTER); else this.room?.hide(false);
    });
    this.#onBegun();
    if (!this.picture.drawing.isSoftware) this.whole().catch(() => {});  // what a graphics card draws is as it stays from the first picture on
  }

  /** Has the rest of the page come. @returns {Promise<import('./hands.js').Hands>} */
  whole() {
    this.#coming ??= this.#complete();
    return this.#coming;
  }

  async #complete() {
    try {
      this.#parts = await import('./whole.js');
    } catch (error) {
      this.#coming = null;  // who asks next tries again
      toast('This page did not load whole: reload it.', 'bad');
      throw error;
    }
    this.room?.setParts(this.#parts);
    await this.#begun;
    this.picture.complete(this.#parts);
    this.hands = new this.#parts.Hands(this, params);
    this.#early.pass();
    return this.hands;
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
    this.show('live');
    this.followed = 0;
    this.room = new Room({ url: new URL('ws', location.href).href.replace(/^http/, 'ws'), core: this.core, wish, parts: this.#parts, storage, onNotice: toast, onTokenWanted: (why) => void this.whole().then((hands) => hands.askToken(why), () => {}) });
    for (const line of lines) this.room.roster.say(line.from, line.text, line.id);
    document.body.dataset.role = wish.role;
    this.room.start();
    if (wish.role === 'player') this.whole().catch(() => {});  // there is no playing without
  }

  /** What a page that is loaded anew needs to be put back into its louse; null: nobody plays. */
  get back() { return this.isPlaying && this.room?.door.resume ? { name: this.room.door.wish.name, room: this.room.welcome?.room ?? '', resume: this.room.door.resume } : null; }

  /** Plays, or watches again. */
  async join() { return (await this.whole()).join(); }
  /** A recording's bytes. @param {Blob} blob @param {string} name */
  async open(blob, name) { return (await this.whole()).open(blob, name); }
  /** The laboratory. */
  async compare() { return (await this.whole()).compare(); }

  follow(id) {
    this.followed = id;
    if (id && this.picture.camera.view === 'orbit') this.view('follow');
    if (this.source === this.room && id !== this.room?.you) history.replaceState(null, '', id ? `#louse=${encodeURIComponent(this.room?.roster.nameOf(id) ?? id)}` : location.pathname + location.search);
  }

  view(name) {
    this.picture.camera.view = name;
    if (name === 'follow' && !this.followed && this.room?.door.wish.role !== 'player') this.followed = this.source?.rows?.[0]?.id ?? 0;  // the one that the panel names
  }

  /** @param {'live'|'recording'|'lab'} kind */
  show(kind) {
    if (kind !== 'recording') { this.player?.close(); this.player = null; }
    if (kind !== 'live') { this.room?.stop(); this.room = null; }
    if (kind !== 'lab') this.lab = null;
    this.hands?.show(kind);
    document.body.dataset.source = kind;
    if (kind !== 'live') document.body.dataset.role = 'none';
  }

  frame(now) {
    requestAnimationFrame((next) => this.frame(next));
    const { source, picture } = this, seconds = performance.now() / 1000;  // what is sent bears the time at which it is, not the picture's
    const isLate = now > PANELS_BY;
    if (!this.#isAsked && (picture.peopled > 0 || isLate)) {  // the frame behind the first picture
      this.#isAsked = true;
      this.whole().catch(() => {});
    }
    if (this.isPlaying) this.room?.own?.steering.lookAlong(this.picture.camera.azimuth);
    source?.update(seconds);
    if (source?.ground && (source.ground !== this.#ground || picture.isRough && picture.names && !picture.isFirst)) this.#setGround(source.ground);
    if (source?.ground && source.isKnown !== false) {  // a ground without its lice would only hold up the first picture
      this.#chooseFollowed();
      const facts = source.facts?.(this.followed || source.you || 0);
      byId('picture').classList.remove('early');
      picture.draw(sceneOf(source, this.followed || source.you || 0, facts ? source.marks(facts) : null), now);
      if (facts && this.#isWhole) this.hands?.panels.every(source, { ...facts, azimuth: picture.camera.azimuth }, seconds);
    }
    if (!this.#isWhole && this.hands && (picture.peopled > 1 || isLate)) {
      this.#isWhole = true;
      byId('over').classList.remove('early');
    }
    if (this.#isWhole && now - this.#panelsAt >= PANELS_EVERY) {
      this.#panelsAt = now;
      this.hands?.panels.update(this);
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
    this.picture.setGround({ domain: ground.domain, wraps: ground.wraps, centre: ground.centre, edges: this.source.mode === 'hill' && this.source.welcome?.rules?.edge === 'fall' ? 'open' : ground.edges, columns, rows, grid: ground.grid(columns, rows) }, ground === this.#ground);
    this.picture.clearTrails();
    this.#ground = ground;
  }
}
