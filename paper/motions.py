"""What kind of motion it is: exponents and verdicts beside the publication's words."""

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.paper import cases, reported
from jointplay.paper.comparison import Cell, Row, signed, small
from jointplay.paper.variants import Variant
from jointplay.records.run import Floats
from jointplay.solver.nonlinear.estimate import Estimate
from jointplay.storage.studies import StudyReader

UNKNOWN = "exponent not computed"


@dataclass(frozen=True)
class Motion:
    """One point of the parameters, judged from several starts.

    Parameters
    ----------
    exponent
        Largest Lyapunov exponent of the whole system, 1/s: mean over the starts; None if it was
        not computed.
    zero_one, period
        Medians of K of the 0-1 test and of the period by recurrence; NaN if unknown.
    verdicts
        How many starts ended in which verdict.
    """

    exponent: Estimate | None
    zero_one: float
    period: float
    verdicts: tuple[tuple[str, int], ...]


def judged(folder: Path, name: str) -> Motion:
    """Return what a study of several starts says."""
    study = StudyReader(folder / name)
    return Motion(
        mean_exponent(study, np.ones(study.points, dtype=bool)),
        _median(study, "zero_one"),
        _median(study, "period"),
        tally(study, np.ones(study.points, dtype=bool)),
    )


def mean_exponent(study: StudyReader, members: NDArray[np.bool_]) -> Estimate | None:
    """Return the mean exponent of points; the error covers their own errors and their scatter."""
    values = study.indicators.get("lyapunov")
    if values is None:
        return None
    errors = study.indicators["lyapunov_error"][members]
    known = np.isfinite(values[members]) & np.isfinite(errors)
    if not known.any():
        return None
    mine, errors = values[members][known], errors[known]
    count = len(mine)
    scatter = float(mine.std(ddof=1)) / math.sqrt(count) if count > 1 else 0.0
    own = float(np.sqrt((errors**2).sum())) / count
    return Estimate(float(mine.mean()), max(scatter, own))


def tally(study: StudyReader, members: NDArray[np.bool_]) -> tuple[tuple[str, int], ...]:
    """Return how many of some points have which verdict, the most frequent first."""
    codes = study.verdicts
    if codes is None:
        return ()
    names = [study.verdict_names[code] for code in codes[members] if code >= 0]
    return tuple(Counter(names).most_common())


def rows(folder: Path, variants: Sequence[Variant]) -> Iterator[Row]:
    """Set verdicts beside the words on phase portraits and sections."""
    for case, entry in enumerate(reported.document()["phase_ranges"]):
        motions = [judged(folder, cases.settled(case, variant)) for variant in variants]
        words = entry["words"]
        yield Row(
            (),
            reported.case_name(entry),
            ", ".join(entry["figures"]),
            "; ".join(f"{joint}: {words[joint]}" for joint in cases.JOINTS),
            tuple(
                _cell(motion, 2.0 / entry["omega_over_pi"], _in_diagram(folder, variant, entry))
                for motion, variant in zip(motions, variants, strict=True)
            ),
            ("system", "window", "tolerance"),
        )


def in_words(verdicts: Sequence[tuple[str, int]]) -> str:
    """Return a tally as text: the word alone if it is the only one."""
    if len(verdicts) == 1:
        return verdicts[0][0]
    total = sum(count for _, count in verdicts)
    return ", ".join(f"{word} {100 * count / total:.0f} %" for word, count in verdicts)


def _cell(motion: Motion, period: float, elsewhere: Estimate | None) -> Cell:
    details = [f"λ = {written(motion.exponent)}" if motion.exponent else UNKNOWN]
    if motion.exponent:
        details.append(f"{small(motion.exponent.value * period, 0.005)} a revolution")
    if math.isfinite(motion.zero_one):
        details.append(f"0–1 test {signed(motion.zero_one, '.2f')}")
    if motion.period > 0.0:
        details.append(f"recurs after {motion.period:g}")
    if elsewhere:
        details.append(f"in the diagram λ = {written(elsewhere)}")
    return Cell(in_words(motion.verdicts) or "no verdict", tuple(details))


def written(exponent: Estimate) -> str:
    """Return an exponent with its error and unit."""
    return str(exponent).replace("-", "−") + " 1/s"


def _in_diagram(folder: Path, variant: Variant, entry: Mapping[str, Any]) -> Estimate | None:
    """Return the exponent of the same motion in a bifurcation diagram, if it is there."""
    parameters = reported.parameters(entry)
    for which, shown in enumerate(reported.document()["bifurcation"]):
        name, _ = reported.SETTINGS[shown["parameter"]]
        fixed = reported.parameters(shown)
        study = StudyReader(folder / cases.diagram(which, variant))
        here = np.isclose(study.values[:, 0], parameters[name], rtol=1e-9, atol=0.0)
        if here.any() and all(parameters[one] == value for one, value in fixed.items()):
            return mean_exponent(study, here)
    return None


def _median(study: StudyReader, name: str) -> float:
    values: Floats | None = study.indicators.get(name)
    if values is None or not np.isfinite(values).any():
        return math.nan
    return float(np.nanmedian(values))
