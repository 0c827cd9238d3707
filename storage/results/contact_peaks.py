"""Peaks of contacts in an overview of samples: forces that no sample shows are known of each."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.storage.results.reader import ResultReader

_FORCE = ".normal_force"


def with_contact_peaks(reader: ResultReader, name: str, bins: Floats, pairs: Floats) -> Floats:
    """Return minima and maxima (k, 2) of a channel, in which no contact's peak force is lost.

    A contact counts in the bin that its middle is in; other channels are returned as they are.

    Parameters
    ----------
    bins
        (k, 2) ascending times of the first and the last sample of each bin, s.
    pairs
        (k, 2) minima and maxima of the samples.
    """
    joint = name.removesuffix(_FORCE)
    if not name.endswith(_FORCE) or joint not in reader.joints or not len(bins):
        return pairs
    rows = reader.impacts()
    rows = rows[rows["joint"] == reader.joints.index(joint)]
    middle = np.where(
        np.isfinite(rows["release"]), 0.5 * (rows["onset"] + rows["release"]), rows["onset"]
    )
    inside = (middle >= bins[0, 0]) & (middle <= bins[-1, 1])
    index = np.searchsorted(bins[:, 0], middle[inside], side="right") - 1
    raised = pairs.copy()
    np.fmax.at(raised[:, 1], index, rows["peak_force"][inside])
    return raised
