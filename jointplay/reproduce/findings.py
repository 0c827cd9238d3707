"""Sentences whose numbers are computed: what the report says in short, and its evidence."""

from collections.abc import Iterator
from pathlib import Path

from jointplay.reproduce import cases, load_cases, overview, ranges, reported
from jointplay.reproduce.comparison import milliseconds
from jointplay.reproduce.motions import in_words, judged
from jointplay.reproduce.size import Size
from jointplay.reproduce.variants import AS_PUBLISHED, CONSTANT, MATERIAL, Variant


def in_short(folder: Path, size: Size) -> Iterator[str]:
    """Yield the main findings."""
    worst = max(max(overview.strokes(folder, variant)) for variant in size.variants)
    yield f"All printed peaks of the displacement agree within {1e3 * worst:.2f} mm."
    yield _impacts(folder)
    yield _spans(folder)
    yield from _motions(folder, size)
    yield gravity(folder)


def gravity(folder: Path) -> str:
    """Return what the displacements say about the direction of gravity."""
    variant = Variant(CONSTANT, MATERIAL)
    entry = reported.document()["adams_comparison"]["displacement_m"]
    strokes = ", ".join(
        f"{1e3 * load_cases.stroke(folder, one, variant):.1f} mm ({one})" for one in cases.GRAVITIES
    )
    fits = " and ".join(
        f"{1e3 * entry[program]:.1f} mm by {words} fits gravity "
        f"{load_cases.nearest(folder, program, variant)}"
        for program, words in load_cases.PROGRAMS.items()
    )
    return f"The displacement peaks at {strokes}, by the direction of gravity; {fits}."


def sampling(folder: Path, size: Size) -> str:
    """Return how much the publication's grid loses of our own peaks."""
    shares = [
        abs(one.sampled / one.value)
        for variant in size.variants
        for case in range(len(reported.document()["response_peaks"]))
        for one in (
            overview.peak(folder, case, variant, channel) for channel in overview.IMPACTS.values()
        )
    ]
    return (
        f"Of our own peaks of forces and accelerations the grid shows {100 * min(shares):.0f} to"
        f" {100 * max(shares):.0f} %."
    )


def slip(folder: Path) -> str:
    """Return how the slip velocity changes the range of a rate."""
    entry = reported.document()["phase_ranges"][0]
    high = entry["B"]["v"][1]
    fastest = [
        ranges.found(folder, "early", Variant(CONSTANT, one), 0, "B.eccentricity_rate_x").high
        for one in (MATERIAL, AS_PUBLISHED)
    ]
    return (
        f"at {reported.case_name(entry)} the rate at B reaches {1e3 * fastest[0]:.1f} mm/s with the"
        f" slip of the material and {1e3 * fastest[1]:.1f} mm/s with that of eqs 5–7, where"
        f" {1e3 * high:.1f} mm/s are printed."
    )


def window(folder: Path, size: Size) -> str:
    """Return how much a range shrinks while the motion settles."""
    entry = reported.document()["phase_ranges"][0]
    fastest = [
        ranges.found(folder, one, Variant(CONSTANT, AS_PUBLISHED), 0, "B.eccentricity_rate_x").high
        for one in ranges.WINDOWS
    ]
    early, late = (f"{first} to {last}" for first, last in (size.early, size.late))
    return (
        f"Our ranges are of revolutions {early} and, as “late”, {late}. The motion settles slowly:"
        f" with the slip as published, at {reported.case_name(entry)}, the rate at B reaches"
        f" {1e3 * fastest[0]:.1f} mm/s in the first and {1e3 * fastest[1]:.1f} mm/s in the second."
    )


def bed() -> str:
    """Return the factors between the publication's experiment and theory."""
    factors = sorted(
        entry["cycle30_experiment"] / entry["cycle30_theory"]
        for entry in reported.document()["test_bed"]
    )
    return f"{factors[0]:.1f} to {factors[-1]:.1f}"


def _impacts(folder: Path) -> str:
    """Return which printed peaks fall into the same impact as ours."""
    timed = overview.impacts(folder, Variant(CONSTANT, AS_PUBLISHED))
    same = [one for one in timed if one.same_impact]
    times = ", ".join(milliseconds(time) for time in sorted({one.time or 0.0 for one in same}))
    ratios = [one.ratio for one in same]
    return (
        f"With {CONSTANT.label} the strongest impact is the printed one, to a step of the printed"
        f" grid, in {len(same)} of {sum(one.time is not None for one in timed)} peaks of force or"
        f" acceleration that have a time (at {times}); sampled on that grid ours are then"
        f" {min(ratios):.2f} to {max(ratios):.2f} times the printed ones. At the others another"
        " impact of the sequence was the strongest."
    )


def _spans(folder: Path) -> str:
    """Return the range of A in x in the cases that the publication prints with most digits."""
    parts = []
    for case, entry in enumerate(reported.document()["phase_ranges"]):
        low, high = ranges.found(
            folder, "late", Variant(CONSTANT, MATERIAL), case, "A.eccentricity_x"
        )
        printed = [f"{1e3 * one:.4f}" for one in entry["A"]["x"]]
        parts.append(
            f"{1e3 * low:.4f} to {1e3 * high:.4f} mm at {reported.case_name(entry)} (printed"
            f" {printed[0]} to {printed[1]})"
        )
    text = "; ".join(parts).replace("-", "−")
    return f"{CONSTANT.label}, {MATERIAL.label}: the eccentricity of A in x spans {text}."


def _motions(folder: Path, size: Size) -> Iterator[str]:
    entries = reported.document()["phase_ranges"]
    for variant in size.motions:
        motions = [judged(folder, cases.settled(case, variant)) for case in range(len(entries))]
        if any(motion.exponent is None for motion in motions):
            yield "Lyapunov exponents were not computed: this version has no indicator of them yet."
            return
        told = "; ".join(
            f"{motion.exponent} 1/s at {reported.case_name(entry)}, {in_words(motion.verdicts)}"
            for entry, motion in zip(entries, motions, strict=True)
        )
        yield f"Largest exponent, {variant.label}: {told}."
