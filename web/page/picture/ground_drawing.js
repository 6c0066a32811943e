// @ts-check
// The ground with its sides and the sky behind it.
import { THEMES, rgb } from './colours.js';
import { firstCoat, rampsOf } from './first_coat.js';
import { layOut, makeBuffer, use } from './gl.js';
import { bottomOf } from './relief.js';
import { fillTexture } from './surface.js';
import { SUN } from './vectors.js';

/** Of the map's width: so much of a map that wraps is shown again beyond each edge, fading. */
const MARGIN = .22;
/** Units of the textures. */
const SHAPE = { unit: 0 }, LIGHT = { unit: 1 }, RAMPS = { unit: 2 }, PAINTED = { unit: 3 };

export class GroundDrawing {
  /** @param {WebGL2RenderingContext} gl @param {Record<string, import('./gl.js').Program>} programs @param {boolean} isSoftware */
  constructor(gl, programs, isSoftware) {
    this.gl = gl;
    this.programs = programs;
    this.isSoftware = isSoftware;
    this.frame = gl.createFramebuffer();
    /** @type {Record<string, WebGLTexture | null>} */
    this.textures = { shape: null, light: null, ramps: null, painted: null };
    /** @type {any[]} what the last ground's meshes are made of */
    this.meshes = [];
  }

  /** @param {import('./relief.js').Relief} relief @param {Uint8Array | null} light as bake() gives it */
  upload(relief, light) {
    const { gl } = this, { domain, columns, rows, grid, wraps = [] } = relief.ground;
    this.relief = relief;
    this.margin = [0, 1].map(axis => wraps[axis] ? MARGIN : 0);
    const range = relief.highest - relief.lowest, shape = new Float32Array(4 * columns * rows);
    for (let k = 0; k < columns * rows; k++) {
      shape[4 * k] = relief.isFlat ? .4 : (grid[3 * k] - relief.lowest) / range;
      shape[4 * k + 1] = grid[3 * k + 1];
      shape[4 * k + 2] = grid[3 * k + 2];
    }
    this.textures.shape = fillTexture(gl, this.textures.shape, SHAPE.unit, columns, rows, [gl.RGBA16F, gl.RGBA, gl.FLOAT], shape);
    this.setLight(light);
    for (const free of this.meshes) free();
    this.meshes = [];
    const mc = Math.round(this.margin[0] * (columns - 1)), mr = Math.round(this.margin[1] * (rows - 1));
    const wide = columns + 2 * mc, high = rows + 2 * mr, places = new Float32Array(3 * wide * high);
    const X = i => domain[0] + relief.width * i / (columns - 1), Y = j => domain[1] + relief.depth * j / (rows - 1);
    const loop = (i, n) => (i % (n - 1) + n - 1) % (n - 1);
    const Z = (i, j) => grid[3 * ((mr ? loop(j, rows) : j) * columns + (mc ? loop(i, columns) : i))];
    for (let j = 0, k = 0; j < high; j++)
      for (let i = 0; i < wide; i++) places[k++] = X(i - mc), places[k++] = Y(j - mr), places[k++] = Z(i - mc, j - mr);
    const triangles = trianglesOf(wide, 0, 0, wide, high, 1);
    this.top = this.mesh(places, [[0, 3]], triangles);
    // while a camera moves, where a processor draws and is slow at it
    this.coarse = this.isSoftware ? this.mesh(places, [[0, 3]], trianglesOf(wide, 0, 0, wide, high, 2)) : this.top;
    // about a louse that is followed such a map is shown in whole copies, where a processor draws coarser ones
    this.copy = mc || mr ? this.mesh(places, [[0, 3]], trianglesOf(wide, mc, mr, columns, rows, this.isSoftware ? 2 : 1)) : null;
    // the soil under the edges; none where the map goes on
    this.thick = .12 * relief.radius / relief.exaggeration;
    const b = bottomOf(relief);
    const soil = [];
    const face = (count, at, nx, ny) => {
      const shade = .84 + .36 * Math.max(0, (nx * SUN[0] + ny * SUN[1]) / Math.hypot(SUN[0], SUN[1]));
      for (let k = 0; k + 1 < count; k++) {
        // so that each face turns its front outwards
        const isTurned = ny < 0 || nx > 0, [x, y, z] = at(k + +isTurned), [u, v, w] = at(k + +!isTurned);
        for (const [px, py, pz, deep] of [[x, y, z, 0], [u, v, w, 0], [x, y, b, z - b], [u, v, w, 0], [u, v, b, w - b], [x, y, b, z - b]])
          soil.push(px, py, pz, deep, shade);
      }
    };
    if (!mr) for (const j of [0, rows - 1]) face(columns, k => [X(k), Y(j), Z(k, j)], 0, j ? 1 : -1);
    if (!mc) for (const i of [0, columns - 1]) face(rows, k => [X(i), Y(k), Z(i, k)], i ? 1 : -1, 0);
    this.soil = this.mesh(new Float32Array(soil), [[0, 4], [1, 1]], null);
  }

  /** @param {Float32Array} data @param {[number, number][]} layout @param {Uint32Array | null} triangles */
  mesh(data, layout, triangles) {
    const { gl } = this, array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const buffers = [makeBuffer(gl, gl.ARRAY_BUFFER, data)];
    layOut(gl, layout);
    if (triangles) buffers.push(makeBuffer(gl, gl.ELEMENT_ARRAY_BUFFER, triangles));
    gl.bindVertexArray(null);
    this.meshes.push(() => {
      gl.deleteVertexArray(array);
      for (const buffer of buffers) gl.deleteBuffer(buffer);
    });
    return { array, count: triangles ? triangles.length : data.length / layout.reduce((n, [, k]) => n + k, 0) };
  }

  /** @param {Uint8Array | null} light null: all of it */
  setLight(light) {
    const { gl } = this, { columns, rows } = /** @type {any} */ (this.relief).ground, kind = [gl.RG8, gl.RG, gl.UNSIGNED_BYTE];
    this.textures.light = light ? fillTexture(gl, this.textures.light, LIGHT.unit, columns, rows, kind, light)
      : fillTexture(gl, this.textures.light, LIGHT.unit, 1, 1, kind, new Uint8Array([255, 255]));
  }

  /** Paints light and colours. @param {import('./colours.js').ThemeName} theme @param {boolean} slope @param {boolean} fine else at once, and coarse: for a first picture */
  paint(theme, slope, fine) {
    const { gl } = this, relief = /** @type {import('./relief.js').Relief} */ (this.relief), { columns, rows, edges, wraps = [] } = relief.ground;
    const look = THEMES[theme], ramps = rampsOf(relief, look);
    this.textures.ramps = fillTexture(gl, this.textures.ramps, RAMPS.unit, 256, 2, [gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE], ramps);
    const kind = [gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE];
    if (!fine && this.isSoftware) {
      this.textures.painted = fillTexture(gl, this.textures.painted, PAINTED.unit, columns, rows, kind, firstCoat(relief, ramps, slope, look.sun));
      return this.wrapPainted(wraps);
    }
    const longest = !fine ? 384 : this.isSoftware ? 1024 : 2048, most = Math.max(relief.width, relief.depth);
    const w = Math.max(64, Math.round(longest * relief.width / most)), h = Math.max(64, Math.round(longest * relief.depth / most));
    this.textures.painted = fillTexture(gl, this.textures.painted, PAINTED.unit, w, h, kind, null);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.textures.painted, 0);
    gl.viewport(0, 0, w, h);
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    use(gl, this.programs.paint, {
      shape: SHAPE, light: LIGHT, ramps: RAMPS, toSun: SUN, points: [columns, rows], metres: [relief.width, relief.depth],
      exaggeration: relief.exaggeration, steep: relief.steep, slope: +slope, tile: relief.isFlat ? relief.tile : 0,
      open: +(edges === 'open'), seam: +(wraps[0] || wraps[1] || false), sun: look.sun,
    });
    gl.bindVertexArray(null);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.activeTexture(gl.TEXTURE0 + PAINTED.unit);
    if (!this.isSoftware) gl.generateMipmap(gl.TEXTURE_2D), gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    this.wrapPainted(wraps);
    const sharper = !this.isSoftware && gl.getExtension('EXT_texture_filter_anisotropic');
    if (sharper) gl.texParameterf(gl.TEXTURE_2D, sharper.TEXTURE_MAX_ANISOTROPY_EXT, 8);
  }

  /** Repeats what is painted, the bound texture, along what wraps. @private @param {boolean[]} wraps */
  wrapPainted(wraps) {
    const { gl } = this;
    if (wraps[0]) gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.REPEAT);
    if (wraps[1]) gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.REPEAT);
  }

  /** Draws sky, sides and ground over all of what is bound. @param {import('./camera.js').Camera} camera @param {import('./colours.js').ThemeName} theme
   * @param {number} width pixels @param {number} height @param {boolean} slope @param {boolean} coarse
   * @param {() => void} floor draws what lies under the block */
  draw(camera, theme, width, height, slope, coarse, floor) {
    const { gl, programs } = this, relief = /** @type {import('./relief.js').Relief} */ (this.relief), look = THEMES[theme], { top, soil } = this;
    if (!top || !soil) return;
    const [skyAbove, skyBelow, skyGlow] = look.sky.map(rgb);
    const common = {
      M: camera.matrix, size: [width, height], skyAbove, skyBelow, skyGlow, exaggeration: relief.exaggeration,
      far: camera.now && camera.view !== 'map' ? camera.now.distance + relief.radius * .6 : 1e9,
    };
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
    gl.depthMask(true);
    const { domain, wraps = [] } = relief.ground, { middle } = camera, copies = this.copy && camera.view === 'follow' ? [-1, 0, 1] : [0];
    const { array, count } = copies.length > 1 && this.copy || coarse && this.coarse || top;
    gl.bindVertexArray(array);
    for (const i of wraps[0] ? copies : [0])
      for (const j of wraps[1] ? copies : [0]) {
        const offset = [i * relief.width, j * relief.depth];
        // half a map each way, no more: nothing is shown twice
        if (copies.length > 1 && [0, 1].some(k => Math.abs((domain[k] + domain[k + 2]) / 2 + offset[k] - middle[k]) >= domain[k + 2] - domain[k])) continue;
        use(gl, programs.ground, {
          ...common, domain, offset, middle, painted: PAINTED, ink: look.ink, interval: slope ? 0 : relief.interval,
          fade: !this.copy ? [0, 0] : copies.length > 1 ? [.36, .5] : [.5, .5 + MARGIN],
        });
        gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 0);
      }
    this.drawSides(look, common);
    use(gl, programs.sky, common);
    gl.bindVertexArray(null);
    gl.depthMask(false);
    gl.drawArrays(gl.TRIANGLES, 0, 960);
    if (soil.count) floor();
  }

  /** @private @param {typeof THEMES['dark']} look @param {any} common */
  drawSides(look, common) {
    const { gl, programs, soil } = this;
    if (!soil?.count) return;
    const [a, b, c] = look.soil.map(rgb);
    use(gl, programs.soil, { ...common, top: a, middle: b, bottom: c, thick: this.thick });
    gl.bindVertexArray(soil.array);
    gl.enable(gl.CULL_FACE);
    gl.drawArrays(gl.TRIANGLES, 0, soil.count);
    gl.disable(gl.CULL_FACE);
  }
}

/** Triangles of a part of a grid that is `wide` points wide: columns x rows points from (i0, j0) on, every `step`-th.
 * @param {number} wide @param {number} i0 @param {number} j0 @param {number} columns @param {number} rows @param {number} step */
function trianglesOf(wide, i0, j0, columns, rows, step) {
  const last = [i0 + columns - 1, j0 + rows - 1], list = new Uint32Array(6 * Math.ceil((columns - 1) / step) * Math.ceil((rows - 1) / step));
  let count = 0;
  // in stripes of a few columns: corners are found again before they are forgotten
  for (let stripe = i0; stripe < last[0]; stripe += 6 * step)
    for (let j = j0; j < last[1]; j += step)
      for (let i = stripe; i < Math.min(stripe + 6 * step, last[0]); i += step) {
        const a = j * wide + i, right = Math.min(i + step, last[0]), up = Math.min(j + step, last[1]) * wide;
        list[count] = a;
        list[count + 1] = list[count + 3] = j * wide + right;
        list[count + 2] = list[count + 5] = up + i;
        list[count + 4] = up + right;
        count += 6;
      }
  return list;
}
