// @ts-check
// A thread of its own for bake(): it takes some 0.2 s, in which the picture is shown without shadows.
import { bake } from './bake.js';

onmessage = ({ data }) => {
  const light = bake(data.ground, data.exaggeration);
  postMessage({ number: data.number, light }, { transfer: [light.buffer] });
};
