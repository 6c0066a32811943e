// @ts-check
// What is shown as the picture takes it: lice on the ground under them, ghosts, marks.

/** The colours of ghosts, by kind; their outlines and names tell them from lice. */
const GHOSTS = { record: 2, author: 4, own: 'you' };

/** A louse with the ground under it and what it is called. */
function placed(louse, ground) {
  const sample = ground.sample(louse.x, louse.y);  // of a big map the server knows how high they are
  return !ground.isExact && louse.z !== undefined ? { ...louse, zx: sample.zx, zy: sample.zy } : { ...louse, z: sample.z, zx: sample.zx, zy: sample.zy };
}

/**
 * @param {any} source a room, a player or the lab
 * @param {number} followed the louse that is followed, or 0
 * @param {any} marks what the rules show
 */
export function sceneOf(source, followed, marks) {
  const { ground, you = 0 } = source;
  const lice = source.lice.map((louse) => {
    const { id, phase, x, y, vx, vy, heading_x, heading_y, flight_z, flight_vz, distance, outline } = louse, sample = ground.sample(x, y);
    const z = !ground.isExact && louse.z !== undefined ? louse.z : sample.z;  // as in placed(); to copy hundreds as they come takes tens of times as long as to name what is drawn
    return { id, phase, x, y, vx, vy, heading_x, heading_y, flight_z, flight_vz, distance, outline, z, zx: sample.zx, zy: sample.zy, name: source.nameOf(id), colour: id, isYou: id === you && you !== 0 };
  });
  const ghosts = (marks?.ghosts ?? []).map((ghost) => ({ ...placed(ghost, ground), colour: GHOSTS[ghost.kind] }));
  return { lice, you, follow: followed, marks: { ...marks, ghosts } };
}
