// @ts-check
// The little that the picture needs around WebGL 2.
import { SHADERS } from './shaders.js';

/** The texture units of a surface's depths and colours. */
export const DEPTHS = { unit: 4 }, COLOURS = { unit: 5 };

/** A program of shaders.js. */
export class Program {
  /** @type {{program: WebGLProgram, shaders: WebGLShader[]} | null} */ #made = null;
  /** @type {Record<string, WebGLUniformLocation | null> | null} */ #at = null;

  /** @param {WebGL2RenderingContext} gl @param {string} name @param {[string, string]} sources */
  constructor(gl, name, sources) {
    this.gl = gl;
    this.name = name;
    this.sources = sources;
  }

  /** Has it compiled; how that went is asked for when it is used first, so that a driver does several side by side while the page goes on. */
  begin() {
    if (this.#made) return this.#made;
    const { gl } = this, program = gl.createProgram();
    const shaders = this.sources.map((source, k) => {
      const shader = /** @type {WebGLShader} */ (gl.createShader(k ? gl.FRAGMENT_SHADER : gl.VERTEX_SHADER));
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      return shader;
    });
    gl.linkProgram(program);
    return this.#made = { program, shaders };
  }

  get program() {
    return this.begin().program;
  }

  /** Where its uniforms are. */
  get at() {
    const { program, shaders } = this.begin();
    return this.#at ??= placesIn(this.gl, this.name, program, shaders);
  }
}

/** Every program; those of `first` are compiled, null: all. @param {WebGL2RenderingContext} gl @param {string[] | null} first @returns {Record<string, Program>} */
export function makePrograms(gl, first) {
  const programs = Object.entries(SHADERS).map(([name, sources]) => new Program(gl, name, sources));
  for (const program of programs) if (first?.includes(program.name) ?? true) program.begin();
  return Object.fromEntries(programs.map(program => [program.name, program]));
}

/** Where a program's uniforms are. Throws an Error where it could not be made. @param {WebGL2RenderingContext} gl @param {string} name
 * @param {WebGLProgram} program @param {WebGLShader[]} shaders */
function placesIn(gl, name, program, shaders) {
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(`the ${name} shader: ${shaders.map(s => gl.getShaderInfoLog(s)).join(' ')} ${gl.getProgramInfoLog(program)}`);
  /** @type {Record<string, WebGLUniformLocation | null>} */
  const at = {};
  for (let k = 0, n = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) ?? 0; k < n; k++) {
    const info = gl.getActiveUniform(program, k);
    if (info) at[info.name] = gl.getUniformLocation(program, info.name);
  }
  return at;
}

/** Uses a program with uniforms by name: numbers, vectors by length, 16 numbers a matrix; {unit} a texture's.
 * @param {WebGL2RenderingContext} gl @param {Program} program @param {Record<string, any>} values */
export function use(gl, { program, at }, values) {
  gl.useProgram(program);
  for (const name in values) {
    const place = at[name], v = values[name];
    if (!place) continue;
    if (typeof v === 'number') gl.uniform1f(place, v);
    else if (v.length === 2) gl.uniform2fv(place, v);
    else if (v.length === 3) gl.uniform3fv(place, v);
    else if (v.length === 4) gl.uniform4fv(place, v);
    else if (v.length === 16) gl.uniformMatrix4fv(place, false, v);
    else gl.uniform1i(place, v.unit);
  }
}

/** @param {WebGL2RenderingContext} gl @param {number} target @param {AllowSharedBufferSource | number} data @param {boolean} changes */
export function makeBuffer(gl, target, data, changes = false) {
  const buffer = gl.createBuffer();
  gl.bindBuffer(target, buffer);
  // @ts-ignore a number is a size
  gl.bufferData(target, data, changes ? gl.DYNAMIC_DRAW : gl.STATIC_DRAW);
  return buffer;
}

/** Floats of the bound buffer as attributes: [location, how many of them]. @param {WebGL2RenderingContext} gl
 * @param {[number, number][]} layout @param {number} divisor */
export function layOut(gl, layout, divisor = 0) {
  const stride = layout.reduce((sum, [, n]) => sum + 4 * n, 0);
  let at = 0;
  for (const [location, n] of layout) {
    gl.enableVertexAttribArray(location);
    gl.vertexAttribPointer(location, n, gl.FLOAT, false, stride, at);
    gl.vertexAttribDivisor(location, divisor);
    at += 4 * n;
  }
}

/** Fills a texture, made where `texture` is null; it stays bound to its unit. @param {WebGL2RenderingContext} gl @param {WebGLTexture | null} texture @param {number} unit
 * @param {number} width @param {number} height @param {number[]} kind internal format, format, type @param {ArrayBufferView | null} data */
export function fillTexture(gl, texture, unit, width, height, kind, data) {
  const made = texture ?? gl.createTexture();
  gl.activeTexture(gl.TEXTURE0 + unit);
  gl.bindTexture(gl.TEXTURE_2D, made);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  gl.texImage2D(gl.TEXTURE_2D, 0, kind[0], width, height, 0, kind[1], kind[2], data);
  for (const which of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, which, gl.LINEAR);
  for (const which of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, which, gl.CLAMP_TO_EDGE);
  return made;
}

/** What is drawn into besides the canvas: colour and depth; several samples a pixel, or both as textures. */
export class Surface {
  /** @param {WebGL2RenderingContext} gl @param {number} width @param {number} height @param {number} samples 0: one, in textures */
  constructor(gl, width, height, samples) {
    this.gl = gl;
    this.width = width;
    this.height = height;
    this.frame = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    const parts = [{ attachment: gl.COLOR_ATTACHMENT0, format: gl.RGBA8, ...COLOURS }, { attachment: gl.DEPTH_ATTACHMENT, format: gl.DEPTH_COMPONENT24, ...DEPTHS }];
    this.buffers = !samples ? [] : parts.map(({ attachment, format }) => {
      const buffer = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
      gl.renderbufferStorageMultisample(gl.RENDERBUFFER, samples, format, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, buffer);
      return buffer;
    });
    this.textures = samples ? [] : parts.map(({ attachment, format, unit }) => {
      const texture = gl.createTexture();
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
      for (const which of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, which, gl.NEAREST);
      gl.bindTexture(gl.TEXTURE_2D, null);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, attachment, gl.TEXTURE_2D, texture, 0);
      return { texture, unit };
    });
  }

  /** Its textures to the shaders; or no more: what is drawn into can't be read. @param {boolean} on */
  show(on) {
    const { gl } = this;
    for (const { texture, unit } of this.textures) {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, on ? texture : null);
    }
  }

  /** Copies into another one of the same size. @param {Surface} to @param {boolean} depth its depth, too */
  copyTo(to, depth) {
    const { gl, width: w, height: h } = this;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.frame);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, to.frame);
    gl.blitFramebuffer(0, 0, w, h, 0, 0, w, h, gl.COLOR_BUFFER_BIT | (depth ? gl.DEPTH_BUFFER_BIT : 0), gl.NEAREST);
  }

  free() {
    this.gl.deleteFramebuffer(this.frame);
    for (const buffer of this.buffers) this.gl.deleteRenderbuffer(buffer);
    for (const { texture } of this.textures) this.gl.deleteTexture(texture);
  }
}
