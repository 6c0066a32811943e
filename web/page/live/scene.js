// @ts-check
// From what is known of a game to what the picture draws of it.

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
  const lice = source.lice.map((louse) => ({ ...placed(louse, ground), name: source.nameOf(louse.id), colour: louse.id, isYou: louse.id === you && you !== 0 }));
  const ghosts = (marks?.ghosts ?? []).map((ghost) => ({ ...placed(ghost, ground), colour: GHOSTS[ghost.kind] }));
  return { lice, you, follow: followed, marks: { ...marks, ghosts } };
}
