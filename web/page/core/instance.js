// @ts-check
// An instance of core.wasm: its functions, its memory, its texts.
import { wasi } from './wasi.js';

const decoder = new TextDecoder();
const encoder = new TextEncoder();

/** The core came to its end: by a fault of its own or of its caller's, or for want of memory. The instance is of no use any more. */
export class CoreEnded extends Error {}

/**
 * @param {string | URL | BufferSource} source
 * @returns {Promise<WebAssembly.Module>}
 */
async function compiled(source) {
  if (typeof source !== 'string' && !(source instanceof URL)) return WebAssembly.compile(source);
  const response = await fetch(source);
  if (!response.ok) throw new Error(`the server answers with ${response.status}`);
  if (response.headers.get('content-type') === 'application/wasm') return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}

/** What is closed once nobody holds its handle any more. @type {FinalizationRegistry<() => void>} */
const forgotten = new FinalizationRegistry(close => close());

export class Instance {
  /** @param {string | URL | BufferSource | WebAssembly.Module} source */
  static async load(source) {
    const module = source instanceof WebAssembly.Module ? source : await compiled(source);
    const made = new Instance(module);
    const instance = await WebAssembly.instantiate(module, wasi(module, () => made.view(), words => { made.lastWords += words; }));
    /** @type {any} */ (made.functions) = instance.exports;
    made.call('_initialize');
    return made;
  }

  /** @param {WebAssembly.Module} module */
  constructor(module) {
    this.module = module;
    /** @type {Record<string, any>} */
    this.functions = {};
    this.lastWords = '';
    this.isEnded = false;
    this.seen = new Float64Array(0);
  }

  /**
   * A function's number. Throws CoreEnded.
   * @param {string} name
   * @param {...number} numbers
   * @returns {number}
   */
  call(name, ...numbers) {
    if (this.isEnded) throw new CoreEnded(`the core has ended: ${this.lastWords}`);
    try {
      return this.functions[name](...numbers);
    } catch (error) {
      this.isEnded = true;
      this.lastWords = this.lastWords.trim() || /** @type {Error} */ (error).message;
      throw new CoreEnded(`the core has ended: ${this.lastWords}`);
    }
  }

  /**
   * Has what `owner` holds closed: by close(), else when the page has forgotten the owner.
   * @param {object} owner
   * @param {string} name of the function that closes it
   * @param {number} handle
   */
  keep(owner, name, handle) {
    const close = () => { if (!this.isEnded) this.call(name, handle); };
    forgotten.register(owner, close, owner);
  }

  /** @param {object} owner of keep(), at most once @param {string} name @param {number} handle */
  close(owner, name, handle) {
    forgotten.unregister(owner);
    if (!this.isEnded) this.call(name, handle);
  }

  /** The memory as it is now; until the next call, which may move it. */
  view(at = 0, size = this.functions.memory.buffer.byteLength - at) {
    return new DataView(this.functions.memory.buffer, at, size);
  }

  /** All of the memory, by eight bytes; until the next call. The same view as long as the memory does not move, which leaves it empty:
   * where there are hundreds of questions a picture, to ask for the memory takes longer than all else. */
  get doubles() {
    if (!this.seen.length) this.seen = new Float64Array(this.functions.memory.buffer);
    return this.seen;
  }

  /** @param {number} size */
  allocate(size) {
    const at = this.call('allocate', size) >>> 0;
    if (at === 0) throw new Error('there is no memory left for it');
    return at;
  }

  /**
   * Calls with memory that ends with the call.
   * @template T
   * @param {number} size
   * @param {(at: number) => T} use
   * @returns {T}
   */
  withMemory(size, use) {
    const at = this.allocate(size);
    try {
      return use(at);
    } finally {
      if (!this.isEnded) this.call('release', at);
    }
  }

  /**
   * The same with bytes, or a text's UTF-8, in it.
   * @template T
   * @param {string | Uint8Array} content
   * @param {(at: number, size: number) => T} use
   * @returns {T}
   */
  withBytes(content, use) {
    if (typeof content === 'string') {
      return this.withMemory(3 * content.length, at => {
        const room = new Uint8Array(this.functions.memory.buffer, at, 3 * content.length);
        return use(at, encoder.encodeInto(content, room).written);
      });
    }
    return this.withMemory(content.length, at => {
      new Uint8Array(this.functions.memory.buffer, at, content.length).set(content);
      return use(at, content.length);
    });
  }

  /** The last answer's text. */
  answer() {
    const at = this.call('answer_at') >>> 0;
    return decoder.decode(new Uint8Array(this.functions.memory.buffer, at, this.call('answer_size')));
  }

  /**
   * What a function answers with, as JSON.
   * @param {string} name
   * @param {...number} numbers
   * @returns {any}
   */
  json(name, ...numbers) {
    this.call(name, ...numbers);
    return JSON.parse(this.answer());
  }
}
