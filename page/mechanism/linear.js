/** Small dense systems of linear equations. */

/**
 * Returns the step that makes rows `{value, slopes}` zero in the least-squares sense.
 *
 * Solves (JᵀJ + damping) x = −Jᵀr by Cholesky's factorisation.
 */
export function solve(rows, count, damping) {
  const matrix = Array.from({ length: count }, () => new Float64Array(count));
  const right = new Float64Array(count);
  for (const { value, slopes } of rows) {
    for (const [i, slope] of slopes) {
      right[i] -= slope * value;
      for (const [j, other] of slopes) if (j <= i) matrix[i][j] += slope * other;
    }
  }
  for (let i = 0; i < count; i++) {
    matrix[i][i] += damping + 1e-12;
    for (let j = 0; j <= i; j++) {
      let sum = matrix[i][j];
      for (let k = 0; k < j; k++) sum -= matrix[i][k] * matrix[j][k];
      if (i === j) matrix[i][i] = Math.sqrt(Math.max(sum, 1e-18));
      else matrix[i][j] = sum / matrix[j][j];
    }
  }
  for (let i = 0; i < count; i++) {
    for (let k = 0; k < i; k++) right[i] -= matrix[i][k] * right[k];
    right[i] /= matrix[i][i];
  }
  for (let i = count - 1; i >= 0; i--) {
    for (let k = i + 1; k < count; k++) right[i] -= matrix[k][i] * right[k];
    right[i] /= matrix[i][i];
  }
  return right;
}
