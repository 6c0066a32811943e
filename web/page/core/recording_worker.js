// @ts-check
// A recording's desk in a thread of its own: calls in, what they give or throw out.
import { RecordingDesk } from './recording_desk.js';

/** @type {RecordingDesk | null} */
let desk = null;
let work = Promise.resolve();

const calls = {
  /** @param {{module: WebAssembly.Module}} of */
  async begin({ module }) {
    desk = new RecordingDesk(module);
  },
  /** @param {{blob: Blob}} of */
  open: async ({ blob }) => at().open(new Uint8Array(await blob.arrayBuffer())),
  /** @param {{tick: number}} of */
  seek: ({ tick }) => at().seek(tick),
  /** @param {{steps: number}} of */
  advance: ({ steps }) => at().advance(steps),
  /** @param {{id: number}} of */
  measure: ({ id }) => at().measure(id),
  /** @param {{blob: Blob, number: number}} of */
  verify: async ({ blob, number }) => at().verify(new Uint8Array(await blob.arrayBuffer()), ticks => self.postMessage({ number, ticks })),
};

function at() {
  if (!desk) throw new Error('no core yet');
  return desk;
}

/** One after the other, in the order they came. */
self.onmessage = ({ data }) => {
  work = work.then(async () => {
    try {
      const result = await /** @type {Record<string, Function>} */ (calls)[data.call](data);
      self.postMessage({ number: data.number, result });
    } catch (error) {
      self.postMessage({ number: data.number, error: /** @type {Error} */ (error).message });
    }
  });
};
