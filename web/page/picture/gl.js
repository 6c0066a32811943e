// @ts-check
// The little that the picture needs around WebGL 2.

/** A program of sources. */
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

/** A program of each, which begin to compile. @param {WebGL2RenderingContext} gl @param {Record<string, [string, string]>} shaders @returns {Record<string, Program>} */
export function makePrograms(gl, shaders) {
  const programs = Object.entries(shaders).map(([name, sources]) => new Program(gl, name, sources));
  for (const program of programs) program.begin();
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
