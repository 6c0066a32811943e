// @ts-check
// How a louse lies on the ground.

/**
 * The document's Euler angles of a louse that goes along the unit vector (hx, hy) over the map, where the ground
 * has the gradient (zx, zy): yaw counter-clockwise from +x, pitch about the turned y axis (uphill is negative),
 * roll about the forward axis; radians.
 * @param {number} hx @param {number} hy @param {number} zx @param {number} zy
 */
export function attitudeOf(hx, hy, zx, zy) {
  const pitch = Math.atan(-zx * hx - zy * hy);
  return { yaw: Math.atan2(hy, hx), pitch, roll: Math.atan((zy * hx - zx * hy) * Math.cos(pitch)) };
}

/**
 * The axes of a body so turned, without an angle: into out[at..at+2] forward, along the ground, and into
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
