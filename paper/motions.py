"""Kind of motion: exponents and verdicts beside the publication's words."""

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from jointplay.paper import cases, reported
from jointplay.paper.comparison import Cell, Row, signed, small
from jointplay.paper.runs import Stores
from jointplay.paper.variants import Variant
from jointplay.records.arrays import Flags
from jointplay.solver.nonlinear.estimate import Estimate
from jointplay.storage.studies import StudyReader

UNKNOWN = "exponent not computed"
Members = Flags | slice
EVERY = slice(None)


def mean_exponent(study: StudyReader, members: Members = EVERY) -> Estimate | None:
    """Return the mean largest Lyapunov exponent of points, 1/s, of the whole system.

    The error covers their own errors and their scatter; None if no exponent was computed.
    """
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


def tally(study: StudyReader, members: Members = EVERY) -> list[tuple[str, int]]:
    """Return how many of some points have which verdict, the most frequent first."""
    codes = study.verdicts
    if codes is None:
        return []
    return Counter(study.verdict_names[code] for code in codes[members] if code >= 0).most_common()


def in_words(verdicts: Sequence[tuple[str, int]]) -> str:
    """Return a tally as text: the word alone if it is the only one."""
    if len(verdicts) <= 1:
        return verdicts[0][0] if verdicts else "no verdict"
    total = sum(count for _, count in verdicts)
    return ", ".join(f"{word} {100 * count / total:.0f} %" for word, count in verdicts)


def rows(stores: Stores, variants: Sequence[Variant]) -> Iterator[Row]:
    """Set verdicts beside the words on phase portraits and sections."""
    for case, entry in enumerate(reported.document()["phase_ranges"]):
        words = entry["words"]
        cells = [
            _cell(
                stores.study("settled", case, variant),
                2.0 / entry["omega_over_pi"],
                _in_diagram(stores, variant, entry),
            )
            for variant in variants
        ]
        yield Row(
            (),
            reported.case_name(entry),
            ", ".join(entry["figures"]),
            "; ".join(f"{joint}: {words[joint]}" for joint in cases.JOINTS),
            tuple(cells),
            ("system", "window", "tolerance"),
        )


def _cell(study: StudyReader, period: float, elsewhere: Estimate | None) -> Cell:
    exponent = mean_exponent(study)
    details = [UNKNOWN]
    if exponent:
        turn = small(exponent.value * period, 0.005)
        details = [f"λ = {_written(exponent)}", f"{turn} a revolution"]
    zero_one, recurrence = (_median(study, name) for name in ("zero_one", "period"))
    if math.isfinite(zero_one):
        details.append(f"0–1 test {signed(zero_one, '.2f')}")
    if recurrence > 0.0:
        details.append(f"recurs after {recurrence:g}")
    if elsewhere:
        details.append(f"in the diagram λ = {_written(elsewhere)}")
    return Cell(in_words(tally(study)), tuple(details))


def _written(exponent: Estimate) -> str:
    return str(exponent).replace("-", "−") + " 1/s"


def _in_diagram(stores: Stores, variant: Variant, entry: Mapping[str, Any]) -> Estimate | None:
    """Return the exponent of the same motion in a bifurcation diagram, if it is there."""
    parameters = reported.parameters(entry)
    for which, shown in enumerate(reported.document()["bifurcation"]):
        name, _ = reported.SETTINGS[shown["parameter"]]
        study = stores.study("diagram", which, variant)
        here = np.isclose(study.values[:, 0], parameters[name], rtol=1e-9, atol=0.0)
        if here.any() and reported.parameters(shown).items() <= parameters.items():
            return mean_exponent(study, here)
    return None


def _median(study: StudyReader, name: str) -> float:
    values = study.indicators.get(name)
    if values is None or not np.isfinite(values).any():
        return math.nan
    return float(np.nanmedian(values))
