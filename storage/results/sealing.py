"""Conditions under which a store may be sealed, and what is known only then."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.peak import Peak
from jointplay.storage.errors import InvalidAppend
from jointplay.storage.results import metadata
from jointplay.storage.results.layout import ResultLayout

_NO_PEAK: Final = Peak(*[float("nan")] * 4)


def check_sealable(
    layout: ResultLayout,
    attributes: Mapping[str, Any],
    certificate: Mapping[str, metadata.Document],
    peaks: Mapping[str, Peak],
) -> None:
    """Refuse (InvalidAppend) what a store of this layout cannot be sealed with.

    `attributes` : of the root; `certificate` : documents of its group, if there is one.
    """
    found = attributes["samples"], attributes["sections"]
    if attributes["complete"] and found != (layout.samples, layout.sections):
        raise InvalidAppend(
            f"{found[0]} of {layout.samples} samples and {found[1]} of {layout.sections} sections"
            " were appended: seal with complete=False"
        )
    try:
        metadata.serialise(attributes)
        metadata.serialise(certificate)
    except (TypeError, ValueError) as error:
        sentence = f"summary and certificate must be finite JSON values: {error}"
        raise InvalidAppend(sentence) from error
    if unknown := peaks.keys() - {channel.name for channel in layout.channels}:
        raise InvalidAppend(f"peaks of channels that the layout lacks: {sorted(unknown)}")


def peak_columns(layout: ResultLayout, peaks: Mapping[str, Peak]) -> list[Floats]:
    """Return the columns of the table of peaks, (channels,) each; NaN without a peak."""
    found = [peaks.get(channel.name, _NO_PEAK) for channel in layout.channels]
    rows = [(one.minimum, one.minimum_time, one.maximum, one.maximum_time) for one in found]
    return list(np.array(rows).reshape(-1, 4).T)
