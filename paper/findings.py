"""Sentences whose numbers are computed: what the report says in short, and its evidence."""

import math
from collections.abc import Iterator
from pathlib import Path

from jointplay.paper import cases, diagrams, load_cases, overview, ranges, reported
from jointplay.paper.comparison import milliseconds, signed
from jointplay.paper.motions import judged
from jointplay.paper.size import Size
from jointplay.paper.variants import AS_PUBLISHED, CONSTANT, MATERIAL, SLIPS, Variant
from jointplay.storage.studies import StudyReader


def in_short(folder: Path, size: Size) -> Iterator[str]:
    """Yield the main findings."""
    worst = max(max(overview.strokes(folder, variant)) for variant in size.variants)
    yield f"All printed peaks of the displacement agree within {1e3 * worst:.2f} mm."
    yield _impacts(folder)
    yield _spans(folder)
    yield _motions(folder, size)
    yield _expansion(folder, size)
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
    """Return the range of A in x at the slowest and at the fastest speed."""
    entries = reported.document()["phase_ranges"]
    parts = []
    for case in (0, len(entries) - 1):
        ours = ranges.found(folder, "late", Variant(CONSTANT, MATERIAL), case, "A.eccentricity_x")
        low, high = (signed(1e3 * one, ".4f") for one in ours)
        printed = " to ".join(signed(1e3 * one, ".4f") for one in entries[case]["A"]["x"])
        name = reported.case_name(entries[case])
        parts.append(f"{low} to {high} mm at {name} (printed {printed})")
    return (
        f"With {CONSTANT.label} and the {MATERIAL.label} the eccentricity of A in x spans"
        f" {'; '.join(parts)}."
    )


def _motions(folder: Path, size: Size) -> str:
    """Return in how many readings each of the judged motions is chaotic, with the exponents."""
    parts = []
    for case, entry in enumerate(reported.document()["phase_ranges"]):
        found = [judged(folder, cases.settled(case, variant)) for variant in size.motions]
        exponents = [one.exponent.value for one in found if one.exponent]
        if not exponents:
            return "Lyapunov exponents were not computed."
        chaotic = sum(bool(one.verdicts) and one.verdicts[0][0] == "chaotic" for one in found)
        words = " and ".join(f"{joint} {entry['words'][joint]}" for joint in cases.JOINTS)
        low, high = (signed(one, ".2f") for one in (min(exponents), max(exponents)))
        parts.append(
            f"at {reported.case_name(entry)} chaotic in {chaotic} of {len(found)} readings"
            f" (exponents {low} to {high} 1/s; printed: {words})"
        )
    return f"The settled motion of the whole system is {'; '.join(parts)}."


def _expansion(folder: Path, size: Size) -> str:
    """Return where the sections of B widen most as the speed grows."""
    parts = []
    for choice in SLIPS:
        rises = []
        for variant in size.motions:
            study = StudyReader(folder / cases.diagram(1, variant))
            value, before, after = diagrams.largest_rise(study, "B")
            if variant.slip == choice and math.isfinite(value):
                at = value / reported.si("omega_over_pi", 1.0)
                rises.append(f"{at:.2f}π ({before:.2g} to {after:.2g} c, {variant.law.label})")
        if rises:
            parts.append(f"with the {choice.label} at {' and '.join(rises)}")
    if not parts:
        return "Too few speeds were computed to say where the sections of B widen."
    return (
        "The sections of B are printed to expand suddenly at 1.42π rad/s; ours widen most"
        f" {', '.join(parts)}."
    )


def weakening(folder: Path, size: Size) -> str:
    """Return extent and exponent of B over the printed intervals of the speed."""
    variant = size.motions[-1]
    study = StudyReader(folder / cases.diagram(1, variant))
    parts = []
    for words in reported.document()["bifurcation"][1]["reported"]:
        if words["joint"] == "B":
            extent, exponent = diagrams.medians(study, "omega_over_pi", words)
            low, high = words["interval"]
            parts.append(f"{extent:.2g} c and {exponent:.2g} 1/s on {low:g} to {high:g}π")
    return f"{variant.label}, medians of extent and exponent: {', '.join(parts)}."
