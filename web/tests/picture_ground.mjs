// A ground for tests: heights and gradients of a function on a grid.
export function groundOf(domain, columns, rows, f, more = {}) {
  const grid = new Float32Array(3 * columns * rows), e = 1e-5;
  for (let j = 0, k = 0; j < rows; j++)
    for (let i = 0; i < columns; i++) {
      const x = domain[0] + (domain[2] - domain[0]) * i / (columns - 1), y = domain[1] + (domain[3] - domain[1]) * j / (rows - 1);
      grid[k++] = f(x, y), grid[k++] = (f(x + e, y) - f(x - e, y)) / (2 * e), grid[k++] = (f(x, y + e) - f(x, y - e)) / (2 * e);
    }
  return { domain, columns, rows, grid, ...more };
}
export const pot = (x, y) => (x * x + y * y) / 40;
export const hill = (x, y) => 9 * Math.exp(-(x * x + y * y) / 60);
