"""A branch of periodic orbits, followed by pseudo-arclength: predictor, corrector, step control."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.location import NotLocated, Piece
from jointplay.solver.continuation.multipliers import largest
from jointplay.solver.continuation.orbit import Curve, NoOrbit, Orbit, Way
from jointplay.solver.continuation.past_grazing import past_grazing
from jointplay.solver.continuation.plan import Reach
from jointplay.solver.continuation.sign_changes import Special
from jointplay.solver.continuation.special import explained, special_orbits

SMALLEST = 1e-7
"""Step, as a length along the branch, below which the branch is lost."""
FIRST = 0.1
"""First step, in the largest."""
STRAIGHT, SHARP = 0.995, 0.955
"""Cosine between tangents from which on steps grow, and below which one is refused: some 6 and 17
degrees."""
FEW_ROUNDS = 3
"""Rounds of Newton's method up to which steps grow."""
GROWTH, SHRINK = 1.6, 0.4
FINE = 8.0
"""Steps up to so many of the smallest are not refused for what they skip."""
ASTRAY = 0.5
"""Share of the step by which the corrector may move the predicted orbit."""
SHAKEN = 0.01
"""Error of the multipliers, in the largest, that tells of grazing: there the map has a corner."""
UNDETERMINED = 0.1
"""The same beyond which an orbit without contacts is refused."""
CORNER = 1e-4
"""Length along the branch before and behind grazing where a hard stop's map may be a corner."""
SLOW = 0.02
"""Speed of an impact, in what counts as one, below which a lost branch is next to grazing."""
LONG = 5.0
"""Period, in that at the start, beyond which a branch may end at a position of rest."""
ENOUGH = 8
"""Orbits after which a branch may have closed."""
CLOSED = "the branch has closed"


@dataclass(frozen=True)
class Row:
    """An orbit of a branch, as it is told."""

    orbit: Orbit
    length: float
    """Along the branch since its start; negative behind it."""
    label: str = ""
    """One of `columns.LABELS`."""
    bounds: tuple[float, ...] = ()
    """Largest errors of the parameters at a special orbit."""
    note: str = ""

    @property
    def bound(self) -> float:
        """Largest error of the parameter at a special orbit, or the first one's; 0 elsewhere."""
        return self.bounds[0] if self.bounds else 0.0


def both_ways(start: Row, ways: Sequence[Way], reach: Reach) -> Iterator[Row]:
    """Yield the orbits of a branch behind its first one, one way after the other.

    Where the first way closes the branch, there is no other.
    """
    for (orbit, along), sense in zip(ways, (1.0, -1.0), strict=False):
        begin = orbit.curve.scales.length(orbit.vector - start.orbit.vector)
        closed = False
        for row in follow(orbit, along, reach, sense, begin):
            closed = row.note == CLOSED
            yield row
        if closed:
            return


def follow(
    start: Orbit, along: Floats, reach: Reach, sense: float = 1.0, begin: float = 0.0
) -> Iterator[Row]:
    """Yield the orbits of a branch behind the start, in one direction, until it ends.

    `along` : that direction, roughly, as a scaled vector. `sense` : 1 or -1, of the lengths that
    are told. `begin` : length at the start. The last row says why the branch ends.

    The last orbits are held back: where the branch is lost in the corner that a hard stop has at
    grazing, it goes on from there with another number of impacts, without those next to it.
    """
    orbit, counted, passed_at = start, 0, -1
    while True:
        before, held, lost = orbit, list[Row](), None
        for row in _smooth(orbit, along, reach, sense, begin, counted, start):
            if row.label == "MX":
                lost = row
                break
            counted += not row.label
            held.append(row)
            while abs(row.length - held[0].length) > CORNER:
                before = held[0].orbit
                yield held.pop(0)
        if lost is None:
            yield from held
            return
        passed = past_grazing(before, lost.orbit)
        if isinstance(passed, NoOrbit) and passed.grazing:
            lost = replace(lost, note=_lost(lost.orbit, passed) + passed.reason)
        if isinstance(passed, NoOrbit) or counted == passed_at:
            yield from [*held, lost]
            return
        touching, (orbit, along), passed_at = passed.grazing, passed.way, counted
        yield Row(touching, lost.length, "GR", (passed.bound,), passed.note)
        begin = abs(lost.length) + orbit.curve.scales.length(orbit.vector - touching.vector)
        yield Row(orbit, sense * begin)


def _smooth(
    start: Orbit, along: Floats, reach: Reach, sense: float, begin: float, counted: int, home: Orbit
) -> Iterator[Row]:
    """Yield what `follow` does, up to where ordinary steps end.

    `counted` : orbits before. `home` : the first of them, at which the branch may have closed.
    """
    curve, tangent = start.curve, start.tangent(along)
    if tangent is None:
        yield Row(start, sense * begin, "MX", note="the branch has no direction here")
        return
    orbit, length, step = start, begin, FIRST * reach.step
    for count in range(counted + 1, reach.orbits + 1):
        stepped = _step(curve, orbit, tangent, step, reach)
        if isinstance(stepped, NoOrbit):
            yield Row(orbit, sense * length, "MX", note=_lost(orbit, stepped))
            return
        piece, specials, step = stepped
        for one in specials:
            found = one.found
            at = sense * (length + found.at)
            yield Row(found.orbit, at, one.label, found.bounds, one.note)
            if one.last:
                return
        before, orbit, tangent = orbit, piece.last, piece.last_tangent
        length += curve.scales.length(orbit.vector - before.vector)
        if not reach.inside(orbit.values):
            yield Row(orbit, sense * length, "EP", note="end of the range")
            return
        if count >= ENOUGH and _closed(piece, home):
            yield Row(orbit, sense * length, "EP", note=CLOSED)
            return
        ended = count == reach.orbits
        note = f"{count} orbits were asked for" if ended else ""
        yield Row(orbit, sense * length, "EP" if ended else "", note=note)


def _step(
    curve: Curve, orbit: Orbit, tangent: Floats, step: float, reach: Reach
) -> tuple[Piece, list[Special], float] | NoOrbit:
    """Return the next piece, what lies in it, and the step to try behind it."""
    while True:
        piece = _piece(curve, orbit, tangent, step, reach)
        if isinstance(piece, Piece) and _is_undetermined(piece.last):
            piece = NoOrbit("its multipliers are lost in the error of the runs", math.nan)
        if isinstance(piece, Piece):
            try:
                specials = special_orbits(piece)
            except NotLocated as error:
                sentence = f"an orbit between could not be computed: {error}"
                piece = NoOrbit(sentence, math.nan)
            else:
                if explained(piece, specials) or step <= FINE * SMALLEST:
                    turn = curve.scales.product(tangent, piece.last_tangent)
                    grows = turn > STRAIGHT and piece.last.rounds <= FEW_ROUNDS
                    return piece, specials, min(step * GROWTH if grows else step, reach.step)
                piece = NoOrbit("its stability changes in a way that is not known", math.nan)
        if step <= SMALLEST:
            return piece
        step = max(SHRINK * step, SMALLEST)


def _piece(
    curve: Curve, orbit: Orbit, tangent: Floats, step: float, reach: Reach
) -> Piece | NoOrbit:
    """Return the branch up to the orbit a step farther, or to the end of the range."""
    guess = orbit.guess(orbit.vector + step * tangent, tangent)
    inside = reach.inside(curve.section(guess).values)
    found = (
        curve.orbit(guess, tangent, orbit.scale) if inside else _at_end(curve, orbit, guess, reach)
    )
    if isinstance(found, Orbit) and inside and not reach.inside(found.values):
        inside, found = False, _at_end(curve, orbit, found.vector, reach)
    if isinstance(found, NoOrbit):
        return found
    behind = found.tangent(tangent)
    if behind is None:
        return NoOrbit("the branch has no direction behind it", found.residual)
    if inside and curve.scales.length(found.vector - guess) > ASTRAY * step:
        return NoOrbit("Newton's method went astray", found.residual)
    if curve.scales.product(tangent, behind) < SHARP and step > FINE * SMALLEST:
        return NoOrbit("the branch turns too sharply", found.residual)
    if curve.scales.product(tangent, found.vector - orbit.vector) <= 0.0:
        return NoOrbit("the branch does not come to the end of the range", found.residual)
    return Piece(curve, _alike(orbit, found, tangent), tangent, found, behind)


def _is_undetermined(orbit: Orbit) -> bool:
    """Return whether an orbit without contacts tells nothing of its stability."""
    touches = orbit.curve.sections.kernel.pairs
    if touches or orbit.sure:
        return False
    return orbit.error > UNDETERMINED * max(1.0, largest(orbit.multipliers))


def _alike(orbit: Orbit, other: Orbit, along: Floats) -> Orbit:
    """Return an orbit with the differences of another: tests of both must be of one kind."""
    if orbit.scale == other.scale:
        return orbit
    found = orbit.curve.orbit(orbit.vector, along, other.scale)
    return found if isinstance(found, Orbit) and found.scale == other.scale else orbit


def _at_end(curve: Curve, orbit: Orbit, beyond: Floats, reach: Reach) -> Orbit | NoOrbit:
    """Return the orbit at the end of the range, between one inside and a vector beyond."""
    here, there = orbit.values, curve.section(beyond).values
    shares = [((end - here[k]) / (there[k] - here[k]), k, end) for k, end in reach.left(there)]
    share, k, end = min(shares)
    guess = orbit.vector + share * (beyond - orbit.vector)
    axis, place = np.zeros(len(guess)), len(guess) - len(here) + k
    axis[place] = 1.0
    guess[place] = end / curve.scales.extents[place]
    return curve.orbit(orbit.guess(guess, axis), axis, orbit.scale)


def _closed(piece: Piece, start: Orbit) -> bool:
    """Return whether a piece passes the start of its branch."""
    scales = piece.curve.scales
    apart = start.vector - piece.first.vector
    along = scales.product(piece.first_tangent, apart)
    beside = scales.length(apart - along * piece.first_tangent)
    return 0.0 < along <= piece.length and beside < 0.1 * piece.length


def _lost(orbit: Orbit, why: NoOrbit) -> str:
    """Return where and why a branch was lost, and what may be tried."""
    shaken = orbit.error > SHAKEN * largest(orbit.multipliers)
    touching = why.grazing or shaken or not orbit.linear.alike
    if orbit.curve.sections.kernel.pairs and touching:
        cause, remedy = "an impact begins or ends here (grazing)", "a softer contact"
        if orbit.onsets:
            driven = orbit.curve.sections.crossing is None
            cause += ", or lies on the section"
            remedy += f", or another {'phase of the drive' if driven else 'section'}"
    elif speed := _slow_impact(orbit):
        cause = f"{why.reason} next to grazing: an impact has {speed:.2g} m/s"
        remedy = "a softer contact"
    else:
        cause, remedy = why.reason, "a smaller tolerance or a smaller 'largest_step'"
        if orbit.curve.sections.has_friction:
            remedy = f"a wider ramp of friction, {remedy}"
    at = ", ".join(f"{one:.9g}" for one in orbit.values)
    return f"lost at {at}, because {cause}{_long(orbit)}; try {remedy}"


def _slow_impact(orbit: Orbit) -> float:
    """Return the speed of an impact that is next to grazing, m/s; 0: there is none."""
    states = orbit.curve.sections.kernel.states
    fast = orbit.curve.scales.extents[states : -orbit.curve.parameters].max(initial=0.0)
    speed = orbit.looser.passage.margins.speed
    return speed if speed < SLOW * fast else 0.0


def _long(orbit: Orbit) -> str:
    """Return a clause about an orbit that comes back late, as next to a position of rest."""
    map_, duration = orbit.curve.sections, orbit.linear.passage.duration
    if map_.crossing is None or duration < LONG * map_.periods * map_.crossing.interval:
        return ""
    return f", where its period grows as next to a position of rest: {duration:.3g} s"
