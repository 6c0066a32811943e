// @ts-check
// The few calls to a system that are left in core.wasm: it may say its last words, and has no files, no surroundings, no clock that counts.

const NO_SUCH_FILE = 8;  // EBADF

/**
 * @param {WebAssembly.Module} module
 * @param {() => DataView} memory
 * @param {(words: string) => void} say what an assertion says before it ends the core
 */
export function wasi(module, memory, say) {
  const decoder = new TextDecoder();
  /** @type {Record<string, Function>} */
  const answered = {
    fd_write(/** @type {number} */ _file, /** @type {number} */ parts, /** @type {number} */ count, /** @type {number} */ written) {
      const view = memory();
      let size = 0;
      for (let k = 0; k < count; ++k) {
        const bytes = view.getUint32(parts + 8 * k + 4, true);
        say(decoder.decode(new Uint8Array(view.buffer, view.getUint32(parts + 8 * k, true), bytes)));
        size += bytes;
      }
      view.setUint32(written, size, true);
      return 0;
    },
    proc_exit(/** @type {number} */ code) {
      throw new Error(`it ended with status ${code}`);
    },
  };
  /** @type {Record<string, Function>} */
  const functions = {};
  for (const { name } of WebAssembly.Module.imports(module)) functions[name] = answered[name] ?? (() => NO_SUCH_FILE);
  return { wasi_snapshot_preview1: functions };
}
