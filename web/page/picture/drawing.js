// @ts-check
// Everything of the WebGL context: what was lost with it is made again. It draws a first picture, and what lies on a ground ever
// after; the ground itself, lice as they stay and surfaces are fine_drawing.js's, which comes later.
import { Batch } from './batch.js';
import { FirstDrawing, NO_CHANGE, PLAIN, makeOvals } from './first_drawing.js';
import { layOut, makeBuffer, makePrograms, use } from './gl.js';
import { bottomOf } from './relief.js';

const NEARER = 3e-4;  // of the depth from -1 to 1
/** @typedef {{camera: import('./camera.js').Camera, theme: import('./colours.js').ThemeName, shading: 'height' | 'slope', resolution: {at: number}, isFirst: boolean}} Look */
/** The unit of the texture that has the ground's depths. */
export const DEPTHS = { unit: 4 };

export class Drawing {
  /** Throws an Error where there is no WebGL 2. @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    const gl = canvas.getContext('webgl2', { alpha: false, antialias: false, powerPreference: 'low-power' });
    if (!gl) throw new Error('this browser has no WebGL 2');
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
    /** What draws behind the first picture; null: it is still to come. @type {typeof import('./fine_drawing.js').FineDrawing | null} */
    this.Fine = null;
    /** @type {import('./fine_drawing.js').FineDrawing | null} */
    this.fine = null;
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
    const { gl } = this, { plain } = makePrograms(gl, PLAIN);
    this.plain = this.flat = plain;
    this.first = new FirstDrawing(gl, plain);
    this.fine = null;
    this.strips = [0, 1, 2, 3, 4].map(() => {
      const array = gl.createVertexArray();
      gl.bindVertexArray(array);
      const buffer = makeBuffer(gl, gl.ARRAY_BUFFER, 4096, true);
      layOut(gl, [[0, 4], [1, 4]]);
      return { array, buffer, room: 4096 };
    });
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
    if (!this.isLost && light) this.fine?.ground.setLight(light);
    this.isPainted = false;
  }

  /** How low the block's underside is, as drawn [m]. */
  get bottom() {
    return this.relief ? bottomOf(this.relief) * this.relief.exaggeration : 0;
  }

  /** Whether a first picture can be drawn: of plain triangles, where a processor draws. */
  get isPlain() {
    return this.isSoftware && !this.relief?.ground.wraps?.some(is => is);
  }

  /** Draws; false: not before the rest of it has come. @param {Look} look @param {import('./staging.js').Staging} staging @param {number} width pixels @param {number} height @param {number} now ms */
  draw(look, staging, width, height, now) {
    const { relief, Fine } = this;
    if (!relief) return false;
    if (this.isPlain && (look.isFirst || !Fine)) return this.drawFirst(look, staging, relief, width, height);
    if (!Fine) return false;
    const fine = this.fine ??= new Fine(this);
    if (!this.isUploaded) {
      this.first?.free();
      fine.ground.upload(relief, this.light);
      this.isUploaded = true;
    }
    if (!this.isPainted) {
      fine.ground.paint(look.theme, look.shading === 'slope', this.isFine);
      this.isPainted = true;
      this.version++;
    }
    this.flat = fine.flat;
    fine.draw(look, staging, width, height, now);
    return true;
  }

  /** @private @param {Look} look @param {import('./staging.js').Staging} staging @param {import('./relief.js').Relief} relief @param {number} width @param {number} height */
  drawFirst(look, staging, relief, width, height) {
    this.flat = this.plain;
    this.first?.draw(look, relief, this.bottom, width, height);
    this.flush(this.scenery.floor, 3, look.camera.matrix, 0, false);
    makeOvals(staging);
    this.drawScene(look, staging, null, width, height, false, true);
    return true;
  }

  /** All but the ground: what is solid, what lies on the ground, lice, what one looks through.
   * @param {Look} look @param {import('./staging.js').Staging} staging @param {WebGLFramebuffer | null} frame @param {number} width @param {number} height
   * @param {boolean} hides whether the ground was copied @param {boolean} coarse whether it was drawn with fewer points */
  drawScene({ camera }, staging, frame, width, height, hides, coarse) {
    const { gl, fine, scenery } = this, { matrix } = camera;
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
    fine?.setLice(staging);
    fine?.lice.draw(camera, hides);
    solid(false);
    fine?.ghosts.draw(camera, hides);
    this.flush(staging.air, 2, matrix, 0, hides);
    this.flush(scenery.walls, 3, matrix, 0, hides);
    gl.disable(gl.DEPTH_TEST);
    this.flush(staging.through, 2, matrix, 0, false);
    gl.bindVertexArray(null);
    if (hides) fine?.still?.show(false);
  }

  /** Sends vertices through one of the buffers. @param {{data: Float32Array, count: number}} batch @param {number} which @param {number[]} matrix
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
