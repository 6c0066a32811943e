// @ts-check
// The picture as it stays: the ground with its contours, lice with all their legs, smooth outlines; and whether it is drawn again.
import { INSTANCE } from './batch.js';
import { makePrograms, use } from './gl.js';
import { GroundDrawing } from './ground_drawing.js';
import { LiceDrawing } from './lice_drawing.js';
import { SHADERS } from './shaders.js';
import { COLOURS, Surface } from './surface.js';

const SMOOTH = 2;  // of what is kept of a ground that stands
const STANDING = 350;  // ms that the camera must have stood before the ground's outline is smoothed
const STANDS = 1000, FEW = 5;  // ms for which the same is drawn on, and pictures: names come to rest meanwhile
const SEEN_AS_SAME = 1e-9;  // of a number
/** What a louse is drawn by. */
const SEEN = /** @type {const} */ (['id', 'phase', 'x', 'y', 'z', 'zx', 'zy', 'vx', 'vy', 'heading_x', 'heading_y', 'flight_z', 'flight_vz', 'distance', 'name', 'colour', 'outline']);

/** @typedef {import('./drawing.js').Look} Look */

export class FineDrawing {
  /** @param {import('./drawing.js').Drawing} drawing */
  constructor(drawing) {
    const gl = this.gl = drawing.gl, programs = makePrograms(gl, SHADERS);
    this.drawing = drawing;
    this.flat = programs.flat, this.copy = programs.copy;
    this.ground = new GroundDrawing(gl, programs, drawing.isSoftware);
    this.lice = new LiceDrawing(gl, programs);
    this.ghosts = new LiceDrawing(gl, programs);
    this.stillness = new Stillness();
    /** Where a graphics card draws: the picture, with several samples a pixel. @type {Surface | null} */
    this.surface = null;
    /** Where a processor draws: the ground before a camera that stands; else the whole picture. @type {Surface | null} */
    this.still = null;
    this.key = '';
    this.kept = 0;
    /** When the camera came to stand [ms]. */
    this.stood = 0;
  }

  /** @param {Look} look @param {import('./staging.js').Staging} staging @param {number} width pixels @param {number} height @param {number} now ms */
  draw(look, staging, width, height, now) {
    const { drawing } = this;
    if (drawing.isSoftware) {
      const hides = this.copyGround(look, width, height, now);
      return drawing.drawScene(look, staging, null, width, height, hides, !hides && look.resolution.at > 1);
    }
    this.surface = this.fitted(this.surface, width, height, 4);
    this.drawGround(look, this.surface.frame, width, height, false);
    drawing.drawScene(look, staging, this.surface.frame, width, height, false, false);
    // Not onto the canvas: several samples go into the same format alone, and which one a canvas has, each browser chooses.
    this.still = this.fitted(this.still, width, height, 0);
    this.surface.copyTo(this.still, false);
    this.showStill(this.still, width, height);
    this.still.show(false);
  }

  /** Lice that are to be drawn, and ghosts. @param {import('./staging.js').Staging} staging */
  setLice({ instances, data, pixels }) {
    const { lice, ghosts } = this;
    lice.begin();
    ghosts.begin();
    for (let k = 0; k < instances; k++) (data[INSTANCE * k + 11] ? ghosts : lice).add(data, k, pixels[k], instances);
  }

  /** A surface of this size: the given one, or another in its place. @private
   * @param {Surface | null} surface @param {number} width @param {number} height @param {number} samples */
  fitted(surface, width, height, samples) {
    if (surface && surface.width === width && surface.height === height) return surface;
    surface?.free();
    return new Surface(this.gl, width, height, samples);
  }

  /** @private @param {Look} look @param {WebGLFramebuffer | null} frame @param {number} width @param {number} height @param {boolean} coarse */
  drawGround(look, frame, width, height, coarse) {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.viewport(0, 0, width, height);
    gl.depthMask(true);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    this.ground.draw(look.camera, look.theme, width, height, look.shading === 'slope', coarse, () => {
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      this.drawing.flush(this.drawing.scenery.floor, 3, look.camera.matrix, 0, false);
    });
  }

  /** The ground onto the canvas, where a processor draws: anew while the camera moves, else copied. Gives whether it was: then its depths are in a texture.
   * @private @param {Look} look @param {number} width @param {number} height @param {number} now */
  copyGround(look, width, height, now) {
    const { gl } = this, key = `${look.camera.matrix.map(v => v.toFixed(4))} ${width} ${height} ${this.drawing.version}`;
    if (key !== this.key) {
      this.key = key;
      this.stood = now;
      this.kept = 0;
      this.drawGround(look, null, width, height, look.resolution.at > 1);
      return false;
    }
    const still = this.still = this.fitted(this.still ?? null, width, height, 0);
    if (this.kept === 0) {
      this.drawGround(look, still.frame, width, height, false);
      this.kept = 1;
    } else if (this.kept === 1 && now - this.stood > STANDING) { // time for smooth outlines
      const smooth = new Surface(gl, width, height, 4);
      this.drawGround(look, smooth.frame, width, height, false);
      smooth.copyTo(still, true);
      smooth.free();
      this.kept = SMOOTH;
    }
    this.showStill(still, width, height);
    return true;
  }

  /** A surface's colours onto the canvas; its depths are to be had, too, until it is shown no more. @private
   * @param {Surface} still @param {number} width @param {number} height */
  showStill(still, width, height) {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.depthMask(true);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    still.show(true);
    use(gl, this.copy, { picture: COLOURS });
    gl.bindVertexArray(null);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}

/** Own rings pulse, and what the rules put on the ground glows and turns. @param {import('./staging.js').Scene} scene */
const isMoving = ({ you, marks }) => !!you || Object.values(marks ?? {}).some((mark) => (Array.isArray(mark) ? mark.length > 0 : !!mark));

/** @param {any} a @param {any} b */
const isLike = (a, b) => Object.is(a, b) || Math.abs(a - b) <= SEEN_AS_SAME * Math.max(1, Math.abs(a));

/** @param {readonly any[]} some @param {readonly any[]} others */
const areLike = (some, others) => some.length === others.length && some.every((one, k) => isLike(one, others[k]));

/** All but the lice that a picture depends on, and its resolution. @param {import('./staging.js').Scene} scene @param {import('./picture.js').Picture} picture */
function lookOf({ follow }, { camera, drawing, palette, theme, relief, isBaked, staging }) {
  const { width, height, view, insets: { left, top, right, bottom } } = camera;
  return [follow, globalThis.devicePixelRatio, width, height, view, left, top, right, bottom, palette, theme, relief, isBaked, drawing.isFine, drawing.isPainted, drawing.version,
    staging.trails.trails.size, ...camera.matrix];
}

/** Whether a picture would be the one that was drawn last: a recording that is held, lice that sleep. It is not drawn again then; where a
 * processor draws, that leaves it to who re-runs. Before, it is drawn as finely as it gets, however slow that is. */
export class Stillness {
  /** As of the last change. @type {import('./staging.js').Louse[]} */ #lice = [];
  /** @type {readonly any[]} */ #look = [];
  #since = 0; #drawn = 0;
  /** Of the resolution, from before it was made the finest; null: it was not. @type {number | null} */ #coarse = null;

  /** @param {import('./staging.js').Scene} scene @param {import('./picture.js').Picture} picture @param {number} now ms */
  stands(scene, picture, now) {
    const { resolution, drawing, staging: { trails } } = picture, { lice } = scene, look = lookOf(scene, picture);
    const are = lice.length === this.#lice.length && lice.every((louse, k) => SEEN.every((name) => isLike(louse[name], this.#lice[k][name])));
    if (isMoving(scene) || !drawing.isPainted || !are || !areLike(look, this.#look)) {
      this.#lice = lice;
      this.#look = look;
      this.#rest(now);
      if (this.#coarse === null) return false;
      resolution.at = this.#coarse;
      resolution.restart(now);
      this.#coarse = null;
      return false;
    }
    if (this.#coarse !== null) picture.last = -Infinity;  // what is drawn so finely, or not at all, says nothing of how long a frame takes
    if (now - this.#since < STANDS || ++this.#drawn < FEW) return false;
    if (this.#coarse === null) {
      this.#coarse = resolution.at;
      resolution.at = 0;
      picture.last = -Infinity;
      if (this.#coarse > 0) this.#rest(now);
      return false;
    }
    if (drawing.isSoftware && drawing.fine?.kept !== SMOOTH) return false;
    if (trails.last > -Infinity) trails.last = now;  // nobody has moved until now: they stay, however long that is
    return true;
  }

  /** @param {number} now ms */
  #rest(now) {
    this.#since = now;
    this.#drawn = 0;
  }
}
