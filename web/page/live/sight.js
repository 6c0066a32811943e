// @ts-check
// What there is to see of a room: what the rules show and want, the table, what is proven, and the scene for the picture.
import { marksOf } from './goal.js';

/** For goal.js: of the louse `id`, yours or one that is watched; 0: nobody's. @param {import('./room.js').Room} room */
export function factsOf(room, id) {
  const isOwn = id !== 0 && id === room.you;
  return {
    mode: room.mode, rules: room.welcome?.rules ?? null, game: room.mode === 'roam' ? null : room.game, tick: room.tick, hz: room.hz, lice: room.lice, ways: room.ways,
    you: room.louse(id), id, isOwn, run: isOwn ? room.own.run : null, nameOf: (of) => room.roster.nameOf(of), rank: room.rows.find((row) => row.id === id)?.rank ?? 0,
  };
}

/** What the picture shows on the ground. @param {import('./room.js').Room} room @param {ReturnType<typeof factsOf>} facts */
export function marksIn(room, facts) {
  return { ...marksOf(facts), ghosts: facts.isOwn && facts.you ? room.own.ghostsAt(room.tick) : [] };
}

/** What is proven of what is shown. @param {import('./room.js').Room} room @returns {{text: string, tone: 'ok'|'bad'|''}} */
export function proofOf(room) {
  if (room.stream?.difference) return { text: room.stream.difference, tone: 'bad' };
  if (room.door.behavior !== null && !room.door.isSame)
    return { text: `no proof: the server computes by behavior ${room.door.behavior}, this page by ${room.behavior}`, tone: '' };
  if (room.welcome?.stream === 'inputs') return { text: `state ok ${room.stream?.proven ?? 0}`, tone: 'ok' };
  const { exact = 0, corrected = 0 } = room.own.pilot?.prediction ?? {};
  return exact + corrected ? { text: `predicted ${exact}/${exact + corrected}`, tone: corrected ? '' : 'ok' } : { text: '', tone: '' };
}

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
