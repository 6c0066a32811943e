// @ts-check
// Everything of the WebGL context: what was lost with it is made again.
import { Batch } from './batch.js';
import { FirstDrawing, NO_CHANGE, makeOvals } from './first_drawing.js';
import { COLOURS, DEPTHS, Surface, layOut, makeBuffer, makePrograms, use } from './gl.js';
import { GroundDrawing, bottomOf } from './ground_drawing.js';
import { INSTANCE, LiceDrawing } from './lice_drawing.js';

const STANDING = 350;  // ms that the camera must have stood before the ground's outline is smoothed
const NEARER = 3e-4;  // of the depth from -1 to 1
/** The programs of a first picture where a processor draws: it compiles one after the other. */
const FIRST = ['plain'];

/** @typedef {{camera: import('./camera.js').Camera, theme: import('./colours.js').ThemeName, shading: 'height' | 'slope', resolution: {at: number}, isFirst: boolean}} Look */

export class Drawing {
  /** Throws an Error where there is no WebGL 2. @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    const gl = canvas.getContext('webgl2', { alpha: false, antialias: false, powerPreference: 'low-power' });
    if (!gl) throw new Error('this browser shows no WebGL 2, which the picture is drawn with');
    this.gl = gl;
    const info = gl.getExtension('WEBGL_debug_renderer_info');
    const renderer = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
    /** Whether a processor draws, not a graphics card. */
    this.isSoftware = /swiftshader|llvmpipe|softpipe|software|basic render/i.test(renderer);
    this.isLost = false;
    /** @type {import('./relief.js').Relief | null} */
    this.relief = null;
    /** @type {Uint8Array | null} */
    this.light = null;
    /** Whether the ground is painted as it stays: no more light is to come. */
    this.isFine = false;
    /** What never moves: the block's shadow, what lies on the ground, walls. */
    this.scenery = { floor: new Batch(), border: new Batch(), walls: new Batch() };
    this.version = 0;
    /** When the camera came to stand [ms]. */
    this.stood = 0;
    canvas.addEventListener('webglcontextlost', event => {
      event.preventDefault();
      this.isLost = true;
    });
    canvas.addEventListener('webglcontextrestored', () => {
      this.isLost = false;
      this.begin();
    });
    this.begin();
  }

  /** @private */
  begin() {
    const { gl } = this, programs = this.programs = makePrograms(gl, this.isSoftware ? FIRST : null);
    this.first = new FirstDrawing(gl, programs.plain);
    this.flat = programs.flat, this.copy = programs.copy;
    this.ground = new GroundDrawing(gl, programs, this.isSoftware);
    this.lice = new LiceDrawing(gl, programs);
    this.ghosts = new LiceDrawing(gl, programs);
    this.strips = [0, 1, 2, 3, 4].map(() => {
      const array = gl.createVertexArray();
      gl.bindVertexArray(array);
      const buffer = makeBuffer(gl, gl.ARRAY_BUFFER, 4096, true);
      layOut(gl, [[0, 4], [1, 4]]);
      return { array, buffer, room: 4096 };
    });
    /** Where a graphics card draws: the picture, with several samples a pixel. @type {Surface | null} */
    this.surface = null;
    /** Where a processor draws: the ground before a camera that stands; else the whole picture. @type {Surface | null} */
    this.still = null;
    this.key = '';
    this.kept = 0;
    this.isPainted = this.isUploaded = false;
  }

  /** @param {import('./relief.js').Relief} relief */
  setRelief(relief) {
    this.relief = relief;
    this.isFine = relief.isFlat;
    this.light = null;
    this.isPainted = this.isUploaded = false;
  }

  /** @param {Uint8Array | null} light as bake() gives it; null: none will come */
  setLight(light) {
    this.light = light;
    this.isFine = true;
    if (!this.isLost && light) this.ground?.setLight(light);
    this.isPainted = false;
  }

  /** How low the block's underside is, as drawn [m]. */
  get bottom() {
    return this.relief ? bottomOf(this.relief) * this.relief.exaggeration : 0;
  }

  /** Draws. @param {Look} look @param {import('./staging.js').Staging} staging @param {number} width pixels @param {number} height @param {number} now ms */
  draw(look, staging, width, height, now) {
    const { relief, programs } = this;
    if (!relief || !programs) return;
    if (this.isSoftware && look.isFirst && !relief.ground.wraps?.some(is => is)) return this.drawFirst(look, staging, relief, width, height);
    if (!this.isUploaded) {
      this.first?.free();
      for (const name in programs) programs[name].begin();
      this.ground?.upload(relief, this.light);
      this.isUploaded = true;
    }
    if (!this.isPainted) {
      this.ground?.paint(look.theme, look.shading === 'slope', this.isFine);
      this.isPainted = true;
      this.version++;
    }
    if (!this.isSoftware) {
      this.surface = this.fitted(this.surface ?? null, width, height, 4);
      this.drawGround(look, this.surface.frame, width, height, false);
      this.drawScene(look, staging, this.surface.frame, width, height, false, false);
      // Not onto the canvas: several samples go into the same format alone, and which one a canvas has, each browser chooses.
      this.still = this.fitted(this.still ?? null, width, height, 0);
      this.surface.copyTo(this.still, false);
      this.showStill(this.still, width, height);
      this.still.show(false);
    } else {
      const hides = this.copyGround(look, width, height, now);
      this.drawScene(look, staging, null, width, height, hides, !hides && look.resolution.at > 1);
    }
  }

  /** @private @param {Look} look @param {import('./staging.js').Staging} staging @param {import('./relief.js').Relief} relief @param {number} width @param {number} height */
  drawFirst(look, staging, relief, width, height) {
    const { flat } = this;
    this.flat = this.programs?.plain;
    this.first?.draw(look, relief, this.bottom, width, height);
    this.flush(this.scenery.floor, 3, look.camera.matrix, 0, false);
    makeOvals(staging);
    this.drawScene(look, staging, null, width, height, false, true);
    this.flat = flat;
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
    this.ground?.draw(look.camera, look.theme, width, height, look.shading === 'slope', coarse, () => {
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      this.flush(this.scenery.floor, 3, look.camera.matrix, 0, false);
    });
  }

  /** The ground onto the canvas, where a processor draws: anew while the camera moves, else copied. Gives whether it was: then its depths are in a texture.
   * @private @param {Look} look @param {number} width @param {number} height @param {number} now */
  copyGround(look, width, height, now) {
    const { gl } = this, key = `${look.camera.matrix.map(v => v.toFixed(4))} ${width} ${height} ${this.version}`;
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
      this.kept = 2;
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
    if (this.copy) use(gl, this.copy, { picture: COLOURS });
    gl.bindVertexArray(null);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  /** All but the ground: what is solid, what lies on the ground, lice, what one looks through.
   * @private @param {Look} look @param {import('./staging.js').Staging} staging @param {WebGLFramebuffer | null} frame @param {number} width @param {number} height
   * @param {boolean} hides whether the ground was copied @param {boolean} coarse whether it was drawn with fewer points */
  drawScene({ camera }, staging, frame, width, height, hides, coarse) {
    const { gl, lice, ghosts, scenery } = this, { matrix } = camera;
    if (!lice || !ghosts) return;
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.viewport(0, 0, width, height);
    gl.enable(gl.DEPTH_TEST);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    const solid = is => {
      gl.depthMask(is);
      if (is) gl.disable(gl.BLEND); else gl.enable(gl.BLEND);
    };
    solid(true);
    this.flush(staging.solid, 0, matrix, 0, hides);
    solid(false);
    const nearer = NEARER * (coarse ? 5 : 1);
    this.flush(scenery.border, 3, matrix, nearer, hides);
    this.flush(staging.decals, 1, matrix, nearer, hides);
    this.flush(staging.ribbons, 4, NO_CHANGE, nearer, hides, gl.TRIANGLE_STRIP);
    solid(true);
    lice.begin();
    ghosts.begin();
    for (let k = 0; k < staging.instances; k++) {
      (staging.data[INSTANCE * k + 11] ? ghosts : lice).add(staging.data, k, staging.pixels[k], staging.instances);
    }
    lice.draw(camera, hides);
    solid(false);
    ghosts.draw(camera, hides);
    this.flush(staging.air, 2, matrix, 0, hides);
    this.flush(scenery.walls, 3, matrix, 0, hides);
    gl.disable(gl.DEPTH_TEST);
    this.flush(staging.through, 2, matrix, 0, false);
    gl.bindVertexArray(null);
    if (hides) this.still?.show(false);
  }

  /** Sends vertices through one of the buffers. @private @param {{data: Float32Array, count: number}} batch @param {number} which @param {number[]} matrix
   * @param {number} nearer as which they are taken, so that they are seen on the ground @param {boolean} hides @param {number} kind */
  flush({ data, count }, which, matrix, nearer, hides, kind = this.gl.TRIANGLES) {
    if (count < 3 || !this.flat || !this.strips) return;
    const { gl } = this, strip = this.strips[which], bytes = count * 32;
    use(gl, this.flat, { M: matrix, nearer, hides: +hides, depths: DEPTHS });
    gl.bindVertexArray(strip.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, strip.buffer);
    if (strip.room < bytes) gl.bufferData(gl.ARRAY_BUFFER, strip.room = bytes * 2, gl.DYNAMIC_DRAW);
    gl.bufferSubData(gl.ARRAY_BUFFER, 0, data, 0, count * 8);
    gl.drawArrays(kind, 0, count);
  }
}
