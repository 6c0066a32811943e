// @ts-check
// The first picture where a processor draws: it makes machine code of each program when it draws with it first, and that of the
// ground, the soil, the sky and a louse takes it longer than all else until then. So the first picture is of plain coloured triangles
// alone, a single small program: the ground in its colours, without contours, and lice as ovals. The next one is as it stays.
import { THEMES, rgb } from './colours.js';
import { firstCoat, rampsOf } from './first_coat.js';
import { layOut, makeBuffer, use } from './gl.js';
import { INSTANCE } from './batch.js';
import { clamp } from './vectors.js';

/** Of every shader. */
export const HEAD = '#version 300 es\nprecision highp float;\n';

export const FLAT = HEAD + 'layout(location=0) in vec4 p; layout(location=1) in vec4 k; uniform mat4 M; uniform float nearer; out vec4 c; void main(){ c=k; gl_Position=M*p; gl_Position.z-=nearer*gl_Position.w; }';

/** Triangles with a colour at each corner. @type {Record<string, [string, string]>} */
export const PLAIN = { plain: [FLAT, HEAD + 'in vec4 c; out vec4 o; void main(){ o=c; }'] };

export const NO_CHANGE = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
/** Of the sky, each way. */
const TILES = [16, 10];
/** Points of a side at most. */
const MOST = 64;
/** Of the soil's light. */
const SHADE = .6;

export class FirstDrawing {
  /** @param {WebGL2RenderingContext} gl @param {import('./gl.js').Program} program plain */
  constructor(gl, program) {
    this.gl = gl;
    this.program = program;
    /** Of what the mesh is. @type {any[]} */
    this.key = [];
    /** @type {{array: WebGLVertexArrayObject | null, buffers: (WebGLBuffer | null)[], count: number, skyAt: number} | null} */
    this.mesh = null;
  }

  /** Ground, sides and sky. @param {import('./drawing.js').Look} look @param {import('./relief.js').Relief} relief @param {number} bottom of the block, as drawn [m]
   * @param {number} width pixels @param {number} height */
  draw({ camera, theme, shading }, relief, bottom, width, height) {
    const { gl } = this, key = [relief, theme, shading];
    if (!this.mesh || key.some((part, k) => part !== this.key[k])) {
      this.free();
      this.key = key;
      this.mesh = this.make(relief, theme, shading === 'slope', bottom);
    }
    const { array, count, skyAt } = this.mesh;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.enable(gl.DEPTH_TEST);
    gl.depthMask(true);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.bindVertexArray(array);
    use(gl, this.program, { M: camera.matrix, nearer: 0 });
    gl.drawElements(gl.TRIANGLES, skyAt, gl.UNSIGNED_SHORT, 0);
    use(gl, this.program, { M: NO_CHANGE });
    gl.drawElements(gl.TRIANGLES, count - skyAt, gl.UNSIGNED_SHORT, 2 * skyAt);
    gl.bindVertexArray(null);
  }

  /** @private @param {import('./relief.js').Relief} relief @param {import('./colours.js').ThemeName} theme @param {boolean} slope @param {number} bottom */
  make(relief, theme, slope, bottom) {
    const { gl } = this, { domain, columns, rows, grid } = relief.ground, look = THEMES[theme], E = relief.exaggeration;
    const painted = firstCoat(relief, rampsOf(relief, look), slope, look.sun);
    /** @type {number[]} */
    const places = [], /** @type {number[]} */ triangles = [];
    /** So many of them, the first and the last among them. @param {number} count */
    const chosen = (count, most = Math.min(MOST, count)) => Array.from({ length: most }, (_, k) => Math.round(k * (count - 1) / (most - 1)));
    const across = chosen(columns), up = chosen(rows);
    const vertex = (x, y, z, r, g, b) => places.push(x, y, z, 1, r, g, b, 1) / 8 - 1;
    const sheet = (first, wide, high) => {
      for (let j = 0; j + 1 < high; j++)
        for (let i = 0; i + 1 < wide; i++) {
          const k = first + j * wide + i;
          triangles.push(k, k + 1, k + wide, k + 1, k + wide + 1, k + wide);
        }
    };
    const X = i => domain[0] + relief.width * i / (columns - 1), Y = j => domain[1] + relief.depth * j / (rows - 1), Z = (i, j) => grid[3 * (j * columns + i)] * E;
    for (const j of up)
      for (const i of across) {
        const k = 4 * (j * columns + i);
        vertex(X(i), Y(j), Z(i, j), painted[k] / 255, painted[k + 1] / 255, painted[k + 2] / 255);
      }
    sheet(0, across.length, up.length);
    // the sides: from the soil's upper colour to its lower one, about as dark as it will be
    const [above, , below] = look.soil.map(colour => /** @type {[number, number, number]} */ (rgb(colour).map(part => part * SHADE)));
    const side = points => {
      const first = places.length / 8;
      for (const [i, j] of points) vertex(X(i), Y(j), Z(i, j), ...above);
      for (const [i, j] of points) vertex(X(i), Y(j), bottom, ...below);
      sheet(first, points.length, 2);
    };
    for (const j of [0, rows - 1]) side(across.map(i => [i, j]));
    for (const i of [0, columns - 1]) side(up.map(j => [i, j]));
    const skyAt = triangles.length, first = places.length / 8, [skyAbove, skyBelow, skyGlow] = look.sky.map(rgb);
    for (let j = 0; j <= TILES[1]; j++)
      for (let i = 0; i <= TILES[0]; i++) {  // as the shader `sky` has it
        const x = i / TILES[0], y = j / TILES[1], qx = x - .5, qy = (y - .56) * 1.15, t = clamp(y, 0, 1), high = t * t * (3 - 2 * t), glow = .85 * Math.exp(-5 * (qx * qx + qy * qy));
        const [r, g, b] = [0, 1, 2].map(c => (skyBelow[c] + (skyAbove[c] - skyBelow[c]) * high) * (1 - glow) + skyGlow[c] * glow);
        places.push(2 * x - 1, 2 * y - 1, .999999, 1, r, g, b, 1);
      }
    sheet(first, TILES[0] + 1, TILES[1] + 1);
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const buffers = [makeBuffer(gl, gl.ARRAY_BUFFER, new Float32Array(places))];
    layOut(gl, [[0, 4], [1, 4]]);
    buffers.push(makeBuffer(gl, gl.ELEMENT_ARRAY_BUFFER, new Uint16Array(triangles)));
    gl.bindVertexArray(null);
    return { array, buffers, count: triangles.length, skyAt };
  }

  /** It is drawn no more. */
  free() {
    const { gl, mesh } = this;
    this.mesh = null;
    if (!mesh) return;
    gl.deleteVertexArray(mesh.array);
    for (const buffer of mesh.buffers) gl.deleteBuffer(buffer);
  }
}

/** Makes ovals that lie on the ground of all lice. @param {import('./staging.js').Staging} staging */
export function makeOvals(staging) {
  const { data, instances, decals } = staging;
  staging.instances = 0;
  for (let k = 0; k < instances; k++) {
    const d = data.subarray(INSTANCE * k, INSTANCE * (k + 1)), [x, y, z, half, fx, fy, fz, , ux, uy, uz, ghost, r, g, b] = d;
    if (ghost) continue;
    const aside = [(uy * fz - uz * fy) * half * .58, (uz * fx - ux * fz) * half * .58, (ux * fy - uy * fx) * half * .58], rise = half * .35;
    decals.disc([x + ux * rise, y + uy * rise, z + uz * rise], [fx * half, fy * half, fz * half], aside, 6, [r * .86, g * .86, b * .86], 1, 1);
  }
}
