// @ts-check
// Textures, and what is drawn into besides the canvas.
import { DEPTHS } from './drawing.js';

/** The texture unit of a surface's colours. */
export const COLOURS = { unit: 5 };

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
