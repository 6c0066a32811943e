// @ts-check
// Lice: one mesh for those near, plainer ones for those far off, all of one kind in a call.
import { INSTANCE } from './batch.js';
import { layOut, makeBuffer, use } from './gl.js';
import { louseMesh } from './louse_mesh.js';
import { DEPTHS } from './drawing.js';
import { SUN } from './vectors.js';

/** From so many pixels of half length on a louse has head and legs, and all of it; where there are many, later. */
const FINER = [9, 20], FINER_OF_MANY = [17, 30], MANY = 60;

export class LiceDrawing {
  /** @param {WebGL2RenderingContext} gl @param {Record<string, import('./gl.js').Program>} programs */
  constructor(gl, programs) {
    this.gl = gl;
    this.program = programs.louse;
    /** By detail; those that were drawn. @type {ReturnType<LiceDrawing['make']>[]} */
    this.kinds = [];
  }

  /** A mesh with room for instances; not before it is wanted: the finest takes a slow machine as long as a picture. @private @param {0 | 1 | 2} detail */
  make(detail) {
    const { gl } = this, mesh = louseMesh(detail), array = gl.createVertexArray();
    gl.bindVertexArray(array);
    makeBuffer(gl, gl.ARRAY_BUFFER, mesh.places);
    layOut(gl, [[0, 4]]);
    makeBuffer(gl, gl.ARRAY_BUFFER, mesh.normals);
    layOut(gl, [[1, 3]]);
    makeBuffer(gl, gl.ELEMENT_ARRAY_BUFFER, mesh.triangles);
    const data = new Float32Array(64 * INSTANCE);
    const buffer = makeBuffer(gl, gl.ARRAY_BUFFER, data.byteLength, true);
    layOut(gl, [[2, 4], [3, 4], [4, 4], [5, 4]], 1);
    gl.bindVertexArray(null);
    return { array, buffer, data, detail, room: 64, count: 0, triangles: mesh.triangles.length };
  }

  begin() {
    for (const kind of this.kinds) if (kind) kind.count = 0;
  }

  /** Copies the k-th instance. @param {Float32Array} data @param {number} k @param {number} pixels its half length in the picture @param {number} of how many there are */
  add(data, k, pixels, of) {
    const finer = of > MANY ? FINER_OF_MANY : FINER, detail = pixels < finer[0] ? 0 : pixels < finer[1] ? 1 : 2, kind = this.kinds[detail] ??= this.make(detail);
    if ((kind.count + 1) * INSTANCE > kind.data.length) {
      const grown = new Float32Array(2 * kind.data.length);
      grown.set(kind.data);
      kind.data = grown;
    }
    for (let to = INSTANCE * kind.count++, from = INSTANCE * k, end = to + INSTANCE; to < end;) kind.data[to++] = data[from++];
  }

  /** @param {import('./camera.js').Camera} camera @param {boolean} hides whether the ground's depths are in a texture */
  draw(camera, hides) {
    const { gl } = this;
    const values = { M: camera.matrix, eye: camera.eye, toSun: SUN, hides: +hides, depths: DEPTHS };
    for (const kind of this.kinds) {
      if (!kind?.count) continue;
      use(gl, this.program, { ...values, plain: +(kind.detail === 0) });
      gl.bindVertexArray(kind.array);
      gl.bindBuffer(gl.ARRAY_BUFFER, kind.buffer);
      if (kind.room * INSTANCE < kind.data.length) {
        kind.room = kind.data.length / INSTANCE;
        gl.bufferData(gl.ARRAY_BUFFER, kind.data.byteLength, gl.DYNAMIC_DRAW);
      }
      gl.bufferSubData(gl.ARRAY_BUFFER, 0, kind.data, 0, kind.count * INSTANCE);
      gl.drawElementsInstanced(gl.TRIANGLES, kind.triangles, gl.UNSIGNED_SHORT, 0, kind.count);
    }
  }
}
