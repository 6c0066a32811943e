// @ts-check
// Who is in the room and what was said: names from the welcome and from events, the chat and the game's own notices.

/** The oldest lines are forgotten beyond. */
const LINES = 60;

export class Roster {
  /** @type {Map<number, {name: string, role: string}>} */ #residents = new Map();
  /** @type {{from: string, id: number, text: string}[]} `from` is empty for a notice of the game */ lines = [];
  /** How many lines there ever were: tells what is new. */ said = 0;
  spectators = 0;
  /** Words for an event, which come behind the first picture; null before. @type {typeof import('./words.js').told|null} */ #told = null;
  /** Events that have none yet. @type {Parameters<typeof import('./words.js').told>[]} */ #untold = [];

  /** @param {typeof import('./words.js').told} told */
  setWords(told) {
    this.#told = told;
    for (const what of this.#untold.splice(0)) this.note(told(...what));
  }

  /** A new session: who is there replaces who was; the chat stays. */
  welcome(welcome) {
    this.#residents = new Map(welcome.players.map(({ id, name, role }) => [id, { name, role }]));
    if (welcome.id && welcome.name) this.#residents.set(welcome.id, { name: welcome.name, role: 'player' });
    this.spectators = welcome.spectators ?? 0;
  }

  event(event, you, hz, isPlayed = true) {
    if (event.id !== 0 && event.kind === 'joined') this.#residents.set(event.id, { name: event.name, role: event.role ?? 'player' });
    if (event.id !== 0 && event.kind === 'left') this.#residents.delete(event.id);
    if (event.kind === 'chat') this.say(event.name, event.text ?? '', event.id);
    else this.#tell([event, you, hz, (id) => this.nameOf(id), isPlayed]);
  }

  /** @param {Parameters<typeof import('./words.js').told>} what */
  #tell(what) {
    if (this.#told) return this.note(this.#told(...what));
    this.#untold.push(what);
    if (this.#untold.length > LINES) this.#untold.shift();
  }

  note(text) { if (text) this.say('', text, 0); }

  say(from, text, id) {
    this.lines.push({ from, id, text });
    if (this.lines.length > LINES) this.lines.shift();
    this.said++;
  }

  nameOf(id) { return this.#residents.get(id)?.name ?? `#${id}`; }
  isBot(id) { return this.#residents.get(id)?.role === 'bot'; }
  get lice() { return this.#residents.size; }
  get bots() { return [...this.#residents.values()].filter(({ role }) => role === 'bot').length; }
  /** The louse of that name or number; 0: none. */
  find(text) {
    for (const [id, { name }] of this.#residents) if (name === text || String(id) === text) return id;
    return 0;
  }
}
