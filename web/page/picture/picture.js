// @ts-check
// What the page looks like: a ground, lice on it, names over them. It is given arrays and draws them; it asks
// neither the network nor the core, and touches nothing of the page but its canvas and the element for names.
import { Camera } from './camera.js';
import { THEMES, css, louseColour } from './colours.js';
import { Drawing } from './drawing.js';
import { Relief, STEEPEST } from './relief.js';
import { buildScenery } from './scenery.js';
import { Staging } from './staging.js';

const EMPTY = 2500;  // ms from the navigation on; a room that has shown nobody by then may be empty
/** Points of a first picture's ground: what a browser runs for the first time it runs slowly. */
const ROUGH = 48;

/** @typedef {Pick<typeof import('./fine_drawing.js') & typeof import('./marks.js') & typeof import('./names.js'), 'FineDrawing' | 'Names' | 'drawMarks'>} Parts */

export class Picture {
  /**
   * Throws an Error that a person understands where there is no WebGL 2.
   * @param {HTMLCanvasElement} canvas @param {HTMLElement} labels an empty element over it, of the same size, that cuts off what overflows
   * @param {{calm?: boolean, baker: () => Worker}} options calm: nothing glides or pulses; baker: begins a worker that runs bake.js
   */
  constructor(canvas, labels, { calm = false, baker }) {
    this.canvas = canvas;
    this.baker = baker;
    this.calm = calm;
    this.camera = new Camera(calm);
    this.labels = labels;
    /** Not before complete(). @type {import('./names.js').Names | null} */
    this.names = null;
    this.staging = new Staging();
    this.fit(SCALES[SCALES.length - 1]);  // a context is made for a canvas of this size, and made anew for another one
    this.drawing = new Drawing(canvas);
    this.resolution = new Resolution(this.drawing.isSoftware ? SCALES.length - 1 : 0);
    /** @type {import('./colours.js').ThemeName} */
    this.theme = 'dark';
    /** @type {import('./colours.js').Palette} */
    this.palette = 'default';
    /** @type {'height' | 'slope'} */
    this.shading = 'height';
    /** @type {Relief | null} */
    this.relief = null;
    /** @type {Worker | undefined} */
    this.worker = undefined;
    this.number = 0;
    this.isBaked = true;
    this.last = 0;
    /** Pictures with lice in them that were drawn. */
    this.peopled = 0;
    /** Whether the first of them is still to come: until then nothing is done that can wait. */
    this.isFirst = true;
    /** Whether the ground has the few points of a first picture, and is to be set again once there are names, too. */
    this.isRough = false;
    /** Milliseconds of own script in the last frame. */
    this.cost = 0;
  }

  /** What a first picture of plain triangles does without has come; until then each one is such. @param {Parts} parts */
  complete({ FineDrawing, Names, drawMarks }) {
    this.staging.drawMarks = drawMarks;
    this.drawing.Fine = FineDrawing;
    this.names = new Names(this.labels);
  }

  /** How many points a grid of this ground should have: more than the machine can draw help nobody, and a first picture has few. @param {number[]} domain */
  gridFor(domain) {
    const { isSoftware } = this.drawing, longest = (this.isRough = isSoftware && this.isFirst) ? ROUGH : isSoftware ? 112 : 224, w = domain[2] - domain[0], h = domain[3] - domain[1];
    const side = v => Math.max(24, Math.round(longest * v / Math.max(w, h)));
    return { columns: side(w), rows: side(h) };
  }

  /** How many times too high heights are drawn; the page says so where it is not 1. */
  get exaggeration() {
    return this.relief ? this.relief.exaggeration : 1;
  }

  /** What the colours of slopes mean: the steepest that has one of its own [degrees], and all as a style sheet's gradient; null: they are of heights. */
  get legend() {
    if (this.shading !== 'slope' || !this.relief) return null;
    const colours = THEMES[this.theme].slope.map(([at, colour]) => `${css(colour)} ${at * 100}%`);
    return { steepest: Math.atan(this.relief.steep * STEEPEST) * 180 / Math.PI, gradient: `linear-gradient(90deg, ${colours})` };
  }

  /** Shows another ground, or the same again with other points. @param {import('./relief.js').GroundData} ground @param {boolean} isSame */
  setGround(ground, isSame = false) {
    const relief = this.relief = new Relief(ground);
    this.number++;
    this.staging.setRelief(relief);
    this.drawing.setRelief(relief);
    this.camera.setStage(relief.stage(this.drawing.bottom), isSame);
    this.build();
    this.isBaked = relief.isFlat;
  }

  /** Has the shadows made, which come when they are done; where a browser runs no such worker there are none. @private @param {Relief} relief */
  bake({ ground: { domain, columns, rows, grid, wraps }, exaggeration }) {
    this.isBaked = true;
    const worker = this.worker ??= this.baker();
    worker.onmessage = ({ data }) => {
      if (data.number === this.number) this.drawing.setLight(data.light);
    };
    worker.onerror = () => this.drawing.setLight(null);
    worker.postMessage({ number: this.number, ground: { domain, columns, rows, grid, wraps }, exaggeration });
  }

  /** @private */
  build() {
    if (this.relief) buildScenery(this.drawing.scenery, this.relief, this.drawing.bottom, this.theme);
    this.drawing.isPainted = false;
  }

  /** @param {import('./colours.js').ThemeName} theme */
  setTheme(theme) {
    this.theme = theme in THEMES ? theme : 'dark';
    this.build();
  }

  /** @param {import('./colours.js').Palette} palette */
  setPalette(palette) {
    this.palette = palette;
  }

  /** By height, or by how steep it is. @param {'height' | 'slope'} shading */
  setShading(shading) {
    this.shading = shading;
    this.drawing.isPainted = false;
  }

  /** A louse's colour for the page. @param {number | 'you'} index */
  colourOf(index) {
    return css(louseColour(this.palette, index));
  }

  /** Forgets where lice were: another moment is shown. */
  clearTrails() {
    this.staging.trails.clear();
  }

  /** The louse at a place, 0: none. @param {number} x CSS pixels @param {number} y */
  pick(x, y) {
    let best = 0, nearest = 24;
    for (const louse of this.staging.shown) {
      const way = Math.hypot(louse.x - x, louse.y - y);
      if (way < nearest) nearest = way, best = louse.id;
    }
    return best;
  }

  /** Makes the canvas as large as the screen shows it, at a part of its pixels. @private @param {number} scale */
  fit(scale) {
    const { canvas } = this, ratio = Math.min(2, globalThis.devicePixelRatio || 1) * scale, w = canvas.clientWidth, h = canvas.clientHeight;
    const width = Math.max(1, Math.round(w * ratio)), height = Math.max(1, Math.round(h * ratio));
    if (canvas.width !== width || canvas.height !== height) canvas.width = width, canvas.height = height;
    return { w, h, width, height };
  }

  /** Draws a scene. @param {import('./staging.js').Scene} scene @param {number} now ms */
  draw(scene, now) {
    const { camera, staging, drawing } = this;
    if (drawing.isLost || !this.relief) return;
    const begun = performance.now();
    this.resolution.frame(now, now - this.last);
    this.last = now;
    const { w, h, width, height } = this.fit(this.resolution.scale);
    camera.update(w, h, now, staging.find(scene, scene.follow || camera.follow), scene.marks?.arrow);
    if (drawing.fine?.stillness.stands(scene, this, now)) return;
    staging.stage(scene, this, now, width, height);
    if (!drawing.draw(this, staging, width, height, now)) return;
    if (!this.isFirst && this.names) {
      this.names.draw(staging.names, camera, this.theme, staging.arrows);
      if (!this.isBaked) this.bake(this.relief);
    }
    if (scene.lice.length) this.peopled++;
    if (this.peopled > 0 || now > EMPTY) this.isFirst = false;
    this.cost = performance.now() - begun;
  }
}

/** Of the screen's own pixels, each way. */
export const SCALES = [1, .8, .6];
const TOO_LONG = 70, ROOM = 55;  // ms a frame
const PATIENCE = 900, AGAIN = 4000;  // ms that a frame must be too long, or short enough

/** How finely the picture is drawn: as fine as the machine keeps up with. */
export class Resolution {
  /** @param {number} at where to begin: 0 the finest */
  constructor(at = 0) {
    this.at = at;
    this.mean = 0;
    this.since = 0;
    this.wait = AGAIN;
  }

  get scale() {
    return SCALES[this.at];
  }

  /** Tells when a frame was drawn. @param {number} now ms @param {number} took ms since the last one; more than a second: the page was away */
  frame(now, took) {
    if (took > 1000 || took <= 0) return;
    this.mean = this.mean ? this.mean + (took - this.mean) * .08 : took;
    const up = SCALES[this.at - 1];
    // what a frame would take one step finer, were all of it pixels
    const slow = this.mean > TOO_LONG, quick = up && this.mean * (up / this.scale) ** 2 < ROOM;
    if (!slow && !quick) this.since = now;
    if (slow && this.at < SCALES.length - 1 && now - this.since > PATIENCE) {
      this.at++;
      this.wait *= 2;  // tried and failed: the next time later
      this.restart(now);
    } else if (quick && !slow && now - this.since > this.wait) {
      this.at--;
      this.restart(now);
    }
  }

  /** @param {number} now */
  restart(now) {
    this.since = now;
    this.mean = 0;
  }
}
