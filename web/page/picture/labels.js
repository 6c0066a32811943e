// @ts-check
// Names beside lice that avoid each other.

/**
 * A label to place: its anchor in CSS pixels, how far it may keep from it, its size; higher ranks first.
 * @typedef {{key: any, x: number, y: number, reach: number, width: number, height: number, rank: number}} Wanted
 */

/**
 * Places as many as fit, at most `most`: above, below, right, left of their anchors, no two over one another, all
 * inside; one that is forced (its rank is Infinity) always. Gives the upper left corners, by key.
 * @param {Wanted[]} wanted @param {{left: number, top: number, right: number, bottom: number}} free @param {number} most
 * @returns {Map<any, {x: number, y: number}>}
 */
export function placeLabels(wanted, free, most) {
  /** @type {Map<any, {x: number, y: number}>} */
  const placed = new Map();
  /** @type {number[][]} by rows of 32 pixels, so that few are compared */
  const rows = [];
  const isTaken = (x, y, w, h) => {
    for (let r = Math.floor(y / 32); r <= Math.floor((y + h) / 32); r++) {
      const row = rows[r] ?? [];
      for (let k = 0; k < row.length; k += 4)
        if (x < row[k + 2] && row[k] < x + w && y < row[k + 3] && row[k + 1] < y + h) return true;
    }
    return false;
  };
  wanted.sort((a, b) => b.rank - a.rank);
  for (const label of wanted) {
    if (placed.size >= most) break;
    const { width: w, height: h, reach } = label;
    const choices = [[label.x - w / 2, label.y - reach - h], [label.x - w / 2, label.y + reach],
      [label.x + reach, label.y - h / 2], [label.x - reach - w, label.y - h / 2]];
    const inside = choices.filter(([x, y]) => x >= free.left && y >= free.top && x + w <= free.right && y + h <= free.bottom);
    const place = inside.find(([x, y]) => !isTaken(x, y, w, h)) ?? (label.rank === Infinity ? inside[0] : undefined);
    if (!place) continue;
    const [x, y] = place;
    placed.set(label.key, { x, y });
    for (let r = Math.floor(y / 32); r <= Math.floor((y + h) / 32); r++) (rows[r] ??= []).push(x, y, x + w, y + h);
  }
  return placed;
}
