"""The certificate of a run as one document: how far its numbers can be believed.

Errors are None where the motion is not converged.
"""

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from jointplay.records.run import CertificateRecord, Floats, Source

COST: Final = ("steps", "rejections", "onsets", "smallest_step", "solver_seconds")
EXTREMES: Final = ("lowest_minimum", "highest_minimum", "lowest_maximum", "highest_maximum")
HISTOGRAM: Final = ("edges", "share", "spread")


def certificate_document(
    source: Source, certificate: CertificateRecord, names: Sequence[str] | None = None
) -> dict[str, Any]:
    """Return the document of some channels, by default of all; None where nothing is known.

    Parameters
    ----------
    source
        The run; its attribute "summary" says what it cost.
    certificate
        What the run has.
    names
        Channels.
    """
    summary = source.attributes.get("summary") or {}
    time = certificate.arrays["time"].values
    known = converged(certificate, time)
    positions = {channel.name: at for at, channel in enumerate(source.channels)}
    described = {channel.name: channel for channel in source.channels}
    facts = dict(certificate.attributes)
    kinds = facts.pop("kinds", [None] * len(positions))  # certificates were made without once
    channels = {
        name: {
            "unit": described[name].unit,
            "long_name": described[name].long_name,
            "bar": kinds[positions[name]],
            **_of_channel(certificate, positions[name], known),
        }
        for name in (positions if names is None else names)
    }
    return {
        "complete": source.complete,
        **facts,
        **{name: summary.get(name) for name in COST},
        "time": {"unit": "s", "long_name": "time", "values": time.tolist()},
        "channels": channels,
    }


def converged(certificate: CertificateRecord, time: Floats) -> NDArray[np.bool_]:
    """Tell at which times [s] the motion is converged."""
    spans = certificate.attributes["converged"]
    inside = [(start <= time) & (time <= stop) for start, stop in spans]
    return np.any(inside, axis=0) if inside else np.zeros(len(time), np.bool_)


def unconverged(facts: Mapping[str, Any], start: float, stop: float) -> list[tuple[float, float]]:
    """Return the spans [s] of a window in which the motion is not converged."""
    found, reached = [], start
    for begin, end in facts["converged"]:
        if begin > reached:
            found.append((reached, min(begin, stop)))
        reached = max(reached, end)
    found.append((reached, stop))
    return [(a, b) for a, b in found if a < b]


def _of_channel(
    certificate: CertificateRecord, column: int, known: NDArray[np.bool_]
) -> Mapping[str, Any]:
    arrays = {name: array.values for name, array in certificate.arrays.items()}
    error = np.where(known, arrays["error"][:, column], np.nan)
    return {
        "until": _numbers(arrays["until"][column : column + 1])[0],
        "error": _numbers(error),
        "extremes": dict(zip(EXTREMES, _numbers(arrays["extremes"][column]), strict=True)),
        "histogram": {name: _numbers(arrays[name][:, column]) for name in HISTOGRAM},
    }


def _numbers(values: Floats) -> list[float | None]:
    """Return numbers as JSON has them."""
    return [value if np.isfinite(value) else None for value in values.tolist()]
