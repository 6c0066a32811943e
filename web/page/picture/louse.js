// @ts-check
// How a woodlouse lies on the ground.

/**
 * The axes of a body on ground with the gradient (zx, zy) that goes along the unit vector (hx, hy) over the map: those of the
 * document's yaw, pitch and roll, without an angle: into out[at..at+2] forward, along the ground, and into
 * out[at+4..at+6] up, the ground's normal.
 * @param {number} hx @param {number} hy @param {number} zx @param {number} zy
 * @param {Float32Array | number[]} out @param {number} at
 */
export function bodyAxes(hx, hy, zx, zy, out, at) {
  const rise = zx * hx + zy * hy, f = 1 / Math.sqrt(1 + rise * rise), u = 1 / Math.sqrt(1 + zx * zx + zy * zy);
  out[at] = hx * f;
  out[at + 1] = hy * f;
  out[at + 2] = rise * f;
  out[at + 4] = -zx * u;
  out[at + 5] = -zy * u;
  out[at + 6] = u;
}
