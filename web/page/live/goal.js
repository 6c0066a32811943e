// @ts-check
// What the rules of play want and show: the lines over the picture, the marks on the ground, the table, the podium. And what there
// is to say of a room: its facts, what is proven.
import { leftText, medalOf, medalToWin, MOMENTS, pointer, scoreText, spanText } from './words.js';

const HARVEST = 30, TOLD_BEFORE = 15;  // s

/**
 * What is known. `you`: the louse whose goal it is, or null where there is none or it is out; `id`: its number; isOwn: it is yours; azimuth: of "up in the picture".
 * @typedef {{mode: string, rules: any, game: any, tick: number, hz: number, lice: any[], ways: import('./ways.js').Ways, you: any, id: number, isOwn: boolean,
 *   run: import('./own/own_game.js').OwnRun|null, nameOf: (id: number) => string, rank: number, azimuth?: number}} Facts
 * @typedef {{text: string, tone?: string}} Span a piece of a line
 */

const secondsUntil = (facts, tick) => Math.max(0, tick - facts.tick) / facts.hz;
const isPlayed = (game) => game?.phase === 'play' || game?.phase === 'countdown';
const middle = ({ a, b }) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];

/** The crumb that is worth most, of those the nearest. */
function dearest({ game, you, ways }) {
  let best = null, shortest = 0;
  for (const crumb of game.crumbs ?? []) {
    if (crumb[3] === 0) continue;
    const distance = Math.hypot(...ways.way(you.x, you.y, crumb[1], crumb[2]));
    if (best && (crumb[3] < best[3] || (crumb[3] === best[3] && distance >= shortest))) continue;
    best = crumb;
    shortest = distance;
  }
  return best;
}

/** Where it wants you: [x, y] and in words, or null. @param {Facts} facts */
export function aim(facts) {
  const { mode, rules, game, you } = facts;
  if (!isPlayed(game) || !you) return null;
  if (mode === 'race' && rules?.gates?.length) {
    const k = Math.min(you.gate ?? 0, rules.gates.length - 1);
    if (!rules.gates[k]) return null;
    return { at: middle(rules.gates[k]), what: `gate ${k || 'S'}`, hint: rules.gates[k].air ? ', fly through' : '' };
  }
  if (mode === 'forage') {
    const crumb = dearest(facts);
    return crumb && { at: [crumb[1], crumb[2]], what: crumb[3] > 1 ? 'crumb worth 3' : 'crumb', hint: '' };
  }
  const place = mode === 'hill' ? rules?.places?.[game.place] : null;
  return place ? { at: place.at, what: 'place', hint: '' } : null;
}

/** @returns {Span[]} */
function aimSpans(facts) {
  const goal = aim(facts);
  if (!goal) return [];
  const [x, y] = facts.ways.way(facts.you.x, facts.you.y, goal.at[0], goal.at[1]);
  return [{ text: `${goal.what} ${pointer(x, y, facts.azimuth ?? Math.PI / 2)} ${Math.hypot(x, y).toFixed(0)} m${goal.hint}`, tone: 'goal' }];
}

/** @returns {Span} */
function holderSpan({ game, id, isOwn, nameOf }) {
  if (game.contested) return { text: 'contested: nobody holds it', tone: 'bad' };
  if (game.holder !== 0 && game.holder === id) return { text: isOwn ? 'you hold it' : 'holds it', tone: 'good' };
  return { text: game.holder ? `${nameOf(game.holder)} holds it` : 'free: be alone on it' };
}

/** @returns {Span[]} */
function ownSpans(facts) {
  const { mode, rules, game, you, run, hz, tick, rank, lice } = facts;
  const ranked = rank > 0 ? [{ text: `#${rank}/${lice.length}` }] : [];
  if (mode === 'hill') {
    const held = you ? { text: `held ${scoreText(mode, you.score ?? 0, hz)}`, tone: 'strong' } : { text: 'out: back at a spawn soon', tone: 'bad' };
    return [held, holderSpan(facts), ...ranked];
  }
  if (!you) return [];
  if (mode === 'race') {
    const clock = you.lap_start ? { text: spanText(Math.max(0, tick * MOMENTS - ((run?.runStart) || you.lap_start)), hz), tone: 'strong' } : { text: 'starts at S' };
    const medal = medalToWin(rules?.author_ms, you.score ?? 0, hz);
    const best = medal ? [{ text: medal, tone: 'goal' }] : you.score ? [{ text: `best ${spanText(you.score, hz)}` }] : [];
    return [{ text: `lap ${Math.min((you.lap ?? 0) + 1, rules?.laps ?? 1)}/${rules?.laps ?? 1}` }, clock, ...ranked, ...best];
  }
  const chain = run?.chain(tick, hz) ?? 0;
  const chained = chain ? [{ text: `\u00d7${Math.min(3, chain + 1)} ${'\u25ae'.repeat(Math.ceil(run.chainLeft(tick, hz) * 8)).padEnd(8, '\u25af')}`, tone: 'goal' }] : [];
  return [{ text: `score ${you.score ?? 0}`, tone: 'strong' }, ...ranked, ...chained];
}

/** Two lines at most; of a podium the first alone. @param {Facts} facts @returns {Span[][]} */
export function goalLines(facts) {
  const { mode, game } = facts;
  if (!game?.phase) return [];
  const left = leftText(secondsUntil(facts, game.until ?? 0));
  /** @type {Span[]} */ const first = [{ text: mode, tone: 'strong' }];
  if (game.phase === 'gather') return [[...first, { text: 'nobody plays' }]];
  if (game.phase === 'podium') return [[...first, { text: `next round in ${left}`, tone: 'goal' }, { text: `round ${game.round} is over` }]];
  if (game.phase === 'countdown') first.push({ text: `round ${game.round} begins in ${left}`, tone: 'goal' });
  else first.push({ text: `${left} left`, tone: 'strong' });
  if (mode === 'forage' && game.phase === 'play' && secondsUntil(facts, game.until ?? 0) <= HARVEST) first.push({ text: 'harvest \u00d72', tone: 'goal' });
  if (mode === 'hill' && !facts.id) first.push(holderSpan(facts));
  if (mode === 'hill' && game.moves_at) first.push({ text: `moves in ${leftText(secondsUntil(facts, game.moves_at))}` });
  first.push(...aimSpans(facts));
  const own = facts.id ? ownSpans(facts) : [];
  return own.length ? [first, facts.isOwn ? own : [{ text: `${facts.nameOf(facts.id)}:` }, ...own]] : [first];
}

/** What the picture shows besides lice (scene.marks). @param {Facts} facts */
export function marksOf(facts) {
  const { mode, rules, game, you } = facts, marks = /** @type {any} */ ({ gates: [], crumbs: [], ring: null, ghosts: [], arrow: null });
  if (!game) return marks;
  if (mode === 'race') marks.gates = (rules?.gates ?? []).map((gate, k) => ({
    a: gate.a, b: gate.b, air: !!gate.air, number: k || 'S', state: !you ? 'later' : (you.gate ?? 0) === k ? 'next' : you.lap_start && k < (you.gate || rules.gates.length) ? 'passed' : 'later',
  }));
  for (const [, x, y, value] of game.crumbs ?? []) if (value > 0) marks.crumbs.push({ x, y, value });
  const place = mode === 'hill' ? rules?.places?.[game.place] : null;
  if (place) {
    const state = game.contested ? 'contested' : !game.holder ? 'free' : game.holder === facts.id && facts.isOwn ? 'yours' : 'held';
    const next = game.moves_at && rules.places.length > 1 && secondsUntil(facts, game.moves_at) <= TOLD_BEFORE ? rules.places[(game.place + 1) % rules.places.length] : null;
    marks.ring = { x: place.at[0], y: place.at[1], radius: place.radius ?? 3, state, colour: state === 'yours' ? 'you' : game.holder,
                   next: next && { x: next.at[0], y: next.at[1], radius: next.radius ?? 3 } };
  }
  const goal = aim(facts);
  if (goal) marks.arrow = { x: goal.at[0], y: goal.at[1] };
  return marks;
}

/** Gates since the run's start: how far somebody is in it; 0 where the clock does not run. */
function progress(facts, louse) {
  if (facts.mode !== 'race' || !louse.lap_start) return 0;
  const gates = facts.rules?.gates?.length ?? 1;
  return louse.lap * gates + (louse.gate === 0 ? gates : louse.gate);  // the last one leads to the first
}

/** The lice by what the mode ranks by, best first. @param {Facts} facts
 * @returns {{id: number, rank: number, measure: string, share: number}[]} */
export function scoreRows(facts) {
  const { mode, rules, game, hz, lice } = facts;
  const table = new Map((game?.table ?? []).map(([id, score], k) => [id, { score, place: k }]));
  const order = lice.map((louse) => {
    const score = louse.score ?? table.get(louse.id)?.score ?? 0, done = score === 0 ? progress(facts, louse) : 0;
    const key = !game ? louse.distance : mode === 'race' ? (score === 0 ? -Infinity : -score) : score;
    const measure = !game ? `${louse.distance.toFixed(0)} m` : done > 0 ? `lap ${louse.lap + 1}/${rules?.laps ?? 1}` : scoreText(mode, score, hz);
    return { id: louse.id, key, done, measure, place: table.get(louse.id)?.place ?? 1e9, share: mode === 'hill' && game ? Math.min(1, score / ((rules?.hold_s ?? 60) * hz)) : 0 };
  });
  order.sort((a, b) => (b.key === a.key ? b.done - a.done || a.place - b.place || a.id - b.id : b.key - a.key));
  return order.map(({ id, key, measure, share }, k) => ({ id, measure, share, rank: Number.isFinite(key) ? k + 1 : 0 }));
}

/** The best three of the round, while the podium stands. @param {Facts} facts */
export function podium(facts) {
  if (facts.game?.phase !== 'podium') return [];
  return (facts.game.table ?? []).filter(([, score]) => score !== 0).slice(0, 3).map(([id, score]) => ({
    id, name: facts.nameOf(id), measure: scoreText(facts.mode, score, facts.hz), medal: facts.mode === 'race' ? medalOf(facts.rules?.author_ms, score, facts.hz) : '',
  }));
}

/** For goal.js: of the louse `id`, yours or one that is watched; 0: nobody's. @param {import('./room.js').Room} room */
export function factsOf(room, id) {
  const isOwn = id !== 0 && id === room.you;
  return {
    mode: room.mode, rules: room.shown?.rules ?? null, game: room.mode === 'roam' ? null : room.game, tick: room.tick, hz: room.hz, lice: room.lice, ways: room.ways,
    you: room.louse(id), id, isOwn, run: isOwn ? room.own.run : null, nameOf: (of) => room.roster.nameOf(of), rank: room.rows.find((row) => row.id === id)?.rank ?? 0,
  };
}

/** What the picture shows on the ground. @param {import('./room.js').Room} room @param {ReturnType<typeof factsOf>} facts */
export function marksIn(room, facts) {
  return { ...marksOf(facts), ghosts: facts.isOwn && facts.you ? room.own.ghostsAt(room.tick) : [] };
}

/** What is proven of what is shown. @param {import('./room.js').Room} room @returns {{text: string, tone: 'ok'|'bad'|'', why?: string}} */
export function proofOf(room) {
  if (room.stream?.difference) return { text: room.stream.difference, tone: 'bad' };
  if (room.door.behavior !== null && !room.door.isSame)
    return { text: `no proof: the server computes by behavior ${room.door.behavior}, this page by ${room.behavior}`, tone: '' };
  if (room.welcome?.stream === 'inputs') return { text: `state ok ${room.stream?.proven ?? 0}`, tone: 'ok', why: 'so many ticks were run again here from the inputs alone, each equal to the server\'s, bit for bit' };
  const { exact = 0, corrected = 0 } = room.own.pilot?.prediction ?? {};
  return exact + corrected ? { text: `predicted ${exact}/${exact + corrected}`, tone: corrected ? '' : 'ok', why: 'so many of the server\'s answers said of your louse what this page had computed before they came, bit for bit' } : { text: '', tone: '' };
}
