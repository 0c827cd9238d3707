/** Profiles of cams as functions of the angle, for the eye: tables are straight between knots. */

const APART = 0.02; // rad between the values of a slope: about as far as knots are

/** Returns the value of a profile at an angle, m. */
export function profileAt(profile, angle) {
  const { type, knots, values, coefficients } = profile;
  if (type === "sinusoidal") {
    return (profile.offset ?? 0) + profile.amplitude * Math.sin(profile.frequency * angle + (profile.phase ?? 0));
  }
  if (!knots) return profile.value ?? coefficients?.[0] ?? profile.start ?? 0;
  const span = knots.at(-1) - knots[0];
  const inside = knots[0] + ((((angle - knots[0]) % span) + span) % span);
  const piece = Math.min(Math.max(knots.findLastIndex((knot) => knot <= inside), 0), knots.length - 2);
  const off = inside - knots[piece];
  if (coefficients) return coefficients[piece].reduceRight((sum, one) => sum * off + one, 0);
  const share = off / (knots[piece + 1] - knots[piece]);
  return values[piece] + share * (values[piece + 1] - values[piece]);
}

/** Returns the slope of a profile over the angle, m/rad. */
export function slopeAt(profile, angle) {
  return (profileAt(profile, angle + APART) - profileAt(profile, angle - APART)) / (2 * APART);
}
