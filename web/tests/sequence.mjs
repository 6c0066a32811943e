// Numbers from 0 to 1 that are the same in every run (Numerical Recipes' congruence, modulo 2^32).
export function sequence(seed) {
  let state = seed >>> 0;
  return () => (state = Math.imul(state, 1664525) + 1013904223 >>> 0) / 4294967296;
}
