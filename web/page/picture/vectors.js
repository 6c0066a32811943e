// @ts-check
// Vectors of three numbers and matrices of sixteen, by columns, as WebGL takes them.

/** @typedef {[number, number, number]} Vector */

/** @param {Vector} a @param {Vector} b @returns {Vector} */
export const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
/** @param {Vector} a @param {Vector} b */
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
/** @param {Vector} a @param {Vector} b @returns {Vector} */
export const cross = (a, b) =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
/** To the sun, of length 1: from the north-west, some 38 degrees high. @type {Vector} */
export const SUN = [-.568, .459, .683];
/** Of length 1; the zero vector stays. @param {Vector} a @returns {Vector} */
export const unit = a => {
  const n = Math.hypot(a[0], a[1], a[2]) || 1;
  return [a[0] / n, a[1] / n, a[2] / n];
};
/** @param {number} v @param {number} least @param {number} most */
export const clamp = (v, least, most) => Math.max(least, Math.min(most, v));
/** From a to b at t, 0 to 1. @param {number} a @param {number} b @param {number} t */
export const mix = (a, b, t) => a + (b - a) * t;
/** World to eye: from `eye` towards `target`, x to the right. @param {Vector} eye @param {Vector} target @param {Vector} up */
export function lookAt(eye, target, up) {
  const z = unit(minus(eye, target)), x = unit(cross(up, z)), y = cross(z, x);
  return [x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0,
    -dot(x, eye), -dot(y, eye), -dot(z, eye), 1];
}

/** Eye to clip space. @param {number} angle the whole height's, radians @param {number} aspect @param {number} near @param {number} far */
export function perspective(angle, aspect, near, far) {
  const t = 1 / Math.tan(angle / 2);
  return [t / aspect, 0, 0, 0, 0, t, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0];
}

/** Eye to clip space, without perspective. @param {number} half the picture's height / 2, m @param {number} aspect @param {number} near @param {number} far */
export const orthographic = (half, aspect, near, far) =>
  [1 / (half * aspect), 0, 0, 0, 0, 1 / half, 0, 0, 0, 0, 2 / (near - far), 0, 0, 0, (far + near) / (near - far), 1];

/** @param {number[]} a @param {number[]} b */
export function times(a, b) {
  const out = new Array(16);
  for (let c = 0; c < 16; c += 4)
    for (let r = 0; r < 4; r++)
      out[c + r] = a[r] * b[c] + a[r + 4] * b[c + 1] + a[r + 8] * b[c + 2] + a[r + 12] * b[c + 3];
  return out;
}
