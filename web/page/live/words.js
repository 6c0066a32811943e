// @ts-check
// What the rules of play and their events say, for a person.

/** Of a tick: what times are counted in. */
export const MOMENTS = 65536;

const pad = (value, digits) => String(value).padStart(digits, '0');

/** A span of moments: 1:23.456. */
export function spanText(moments, hz) {
  if (moments < 0) return '-' + spanText(-moments, hz);
  const ms = Math.floor(moments / MOMENTS / hz * 1000);
  return `${Math.floor(ms / 60000)}:${pad(Math.floor(ms / 1000) % 60, 2)}.${pad(ms % 1000, 3)}`;
}

/** Seconds that are left, whole ones: 2:05. */
export function leftText(seconds) {
  const whole = Math.ceil(Math.max(0, seconds));
  return `${Math.floor(whole / 60)}:${pad(whole % 60, 2)}`;
}

/** With its sign, of a span of moments in seconds: -0.31. */
export function signedText(moments, hz) {
  const seconds = moments / MOMENTS / hz;
  return (seconds < 0 ? '\u2212' : '+') + Math.abs(seconds).toFixed(2);
}

/** A score as a mode counts it: "1:02.345", "12", "13.4 s"; "--" where there is none yet. */
export function scoreText(mode, score, hz) {
  if (mode === 'race') return score === 0 ? '--' : spanText(score, hz);
  return mode === 'hill' ? `${(score / hz).toFixed(1)} s` : String(score);
}

/** One of eight arrows: a way over the map as it lies in the picture. @param {number} azimuth of "up in the picture" [radians] */
export function pointer(x, y, azimuth) {
  return '\u2191\u2196\u2190\u2199\u2193\u2198\u2192\u2197'[((Math.round((Math.atan2(y, x) - azimuth) * 4 / Math.PI) % 8) + 8) % 8];
}

/** The medals of a race with this author's time [ms], the best first. */
export function medals(authorMs) {
  const times = (hundredths) => Math.ceil(authorMs * hundredths / 100);
  return [['author', authorMs], ['gold', times(106)], ['silver', times(120)], ['bronze', times(150)]];
}

const msOf = (moments, hz) => moments / MOMENTS / hz * 1000;

/** Which medal a run deserves; '': none. */
export function medalOf(authorMs, moments, hz) {
  if (!authorMs || moments <= 0) return '';
  return medals(authorMs).find(([, ms]) => msOf(moments, hz) <= ms)?.[0] ?? '';
}

/** The next medal that the best run has not yet, and its time; '': no medals are known. */
export function medalToWin(authorMs, best, hz) {
  if (!authorMs) return '';
  const next = medals(authorMs).reverse().find(([, ms]) => !(best > 0 && msOf(best, hz) <= ms));
  return next ? `${next[0]} ${spanText(next[1] / 1000 * hz * MOMENTS, hz).slice(0, -1)}` : 'all medals won';
}

/** Who fell, and by whom: whoever bumped it off has held the place longer for it, where the round is played. */
function fallWords({ id, name, by }, you, nameOf, isPlayed) {
  const whom = id === you ? 'you' : name;
  return by ? `${by === you ? 'you' : nameOf(by)} pushed ${whom} off${isPlayed ? ': +3 s' : ''}` : `${whom} fell off`;
}

/** What an event is told as in the chat; '': not worth a line. you: your louse, or 0.
 * @param {(id: number) => string} [nameOf] @param {boolean} [isPlayed] what it does counts */
export function told(event, you, hz, nameOf = String, isPlayed = true) {
  const { kind, name } = event, isYou = event.id !== 0 && event.id === you;
  switch (kind) {
    case 'joined': return event.role === 'spectator' ? `${name} watches` : `${event.role === 'bot' ? 'bot ' : ''}${name} joined`;
    case 'left': return `${name} left`;
    case 'respawned': return `${name} starts again`;
    case 'skip': return `${name} votes for the next game: ${event.votes} of ${event.needed}`;
    case 'gate':
      if (!isYou) return '';
      if (!event.split) return event.gate === 0 ? 'through S: the clock runs' : '';
      return `gate ${event.gate} ${spanText(event.split, hz)}${event.delta == null ? '' : ` ${signedText(event.delta, hz)} s`}`;
    case 'lap': return isYou ? `lap ${spanText(event.time, hz)}${event.best ? ', your best' : ''}` : '';
    case 'run': return `${name} ran ${spanText(event.time, hz)}, #${event.rank}`;
    case 'record': return `${name} drove a record: ${spanText(event.time, hz)}`;
    case 'harvest': return 'harvest: crumbs count twice';
    case 'holds': return event.id === 0 ? '' : isYou ? 'you hold the place' : `${name} holds the place`;
    case 'moving': return 'the place will move';
    case 'fell': return fallWords(event, you, nameOf, isPlayed);
    case 'round': return event.phase === 'play' ? `round ${event.round} begins` : event.phase === 'podium' ? `round ${event.round} is over` : '';
    default: return '';
  }
}

/** What ended the line, and what to do. */
export function farewell({ code, reason }) {
  const what = { kicked: 'You were sent out', banned: 'You are banned', replaced: 'Your louse is played from somewhere else now', flood: 'Too much was sent' }[code];
  return what ? `${what}: ${reason}` : reason;
}

/** What is played, for the help. */
export function rulesInWords(mode, rules) {
  switch (mode) {
    case 'race': return `Race: drive through the gates in turn, S first; ${rules?.laps ?? 3} laps are a run, and the best run wins.`;
    case 'forage': return 'Forage: roll over crumbs; a big one is worth 3. One within 4 s of another counts twice, the next three times.';
    case 'hill': return `Hill: be alone in the ring to hold it; held for ${rules?.hold_s ?? 60} s wins. ${rules?.edge === 'fall' ? 'Bump others off, and don\'t fall.' : 'Lice bump each other away.'}`;
    default: return 'Roam: push, roll, and climb by swinging: push while rolling down.';
  }
}
