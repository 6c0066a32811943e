// @ts-check
// Where arrows stand that lead to what is outside of the picture.

/**
 * An arrow at the picture's edge towards what is outside of it; inside one over it, so many pixels, or (0) none.
 * @param {{x: number, y: number, z: number}} at @param {number} colour @param {import('./camera.js').Camera} camera @param {number} over @returns {import('./names.js').Arrow[]}
 */
export function arrowTo(at, colour, camera, over) {
  const { left, top, right, bottom } = camera.insets, p = camera.project(at.x, at.y, at.z);
  const x0 = left + 22, y0 = top + 22, x1 = camera.width - right - 22, y1 = camera.height - bottom - 22, mx = (x0 + x1) / 2, my = (y0 + y1) / 2;
  if (p && p.x >= x0 && p.x <= x1 && p.y >= y0 && p.y <= y1) return over ? [{ x: p.x, y: Math.max(y0, p.y - over), angle: Math.PI / 2, colour }] : [];
  // before the division by w what lies behind the eye is on its own side, too
  const m = camera.matrix, w = Math.max(1e-6, Math.abs(m[3] * at.x + m[7] * at.y + m[11] * at.z + m[15]));
  const ux = ((m[0] * at.x + m[4] * at.y + m[8] * at.z + m[12]) / w + 1) * camera.width / 2 - mx;
  const uy = (1 - (m[1] * at.x + m[5] * at.y + m[9] * at.z + m[13]) / w) * camera.height / 2 - my;
  const t = Math.min((x1 - x0) / 2 / Math.max(1, Math.abs(ux)), (y1 - y0) / 2 / Math.max(1, Math.abs(uy)));
  return [{ x: mx + ux * t, y: my + uy * t, angle: Math.atan2(uy, ux), colour }];
}
