"""A statistic from outside: the largest magnitude among the samples of a channel."""

from collections.abc import Iterator

import numpy as np
import pytest

from jointplay.client import Refused
from jointplay.solver.statistics import OF_CHANNELS, Grid
from jointplay.solver.statistics.statistic import ChannelStatistic, Floats
from tests.seams.conftest import Platform


class Crest(ChannelStatistic):
    """Largest magnitude of the samples."""

    long_name = "largest magnitude"

    def add(self, tally: Floats, values: Floats, before: int, grid: Grid) -> None:
        """Take the larger magnitudes."""
        np.maximum(tally[0], np.abs(values).max(axis=0), out=tally[0])

    def value(self, tally: Floats, count: int) -> Floats:
        """Return the largest."""
        return tally[0]


@pytest.fixture
def crest() -> Iterator[None]:
    OF_CHANNELS["crest"] = Crest()
    yield
    del OF_CHANNELS["crest"]


SWEEP = {
    "kind": "sweep",
    "scene": {"preset": "seven-bar-press", "parameters": {"speed": 100.0}},
    "grid": {"clearance": [2e-4, 3e-4]},
    "periods": 1,
    "channels": ["A.normal_force", "A.eccentricity_x"],
    "statistics": ["crest", "root_mean_square"],
    "tolerance": 1e-5,
}


@pytest.mark.usefixtures("crest")
def test_it_is_asked_for_computed_and_read_by_name(platform: Platform) -> None:
    job = platform.computed(SWEEP)
    points = job.points
    assert points.attrs["units"]["A.normal_force.crest"] == "N"
    for channel in SWEEP["channels"]:
        peaks = job.study().peaks(channel)
        largest = np.maximum(np.abs(peaks.minimum), np.abs(peaks.maximum))
        crest = points[f"{channel}.crest"].to_numpy()
        # 256 samples of a period see no more than the located extremes, and more than the mean
        assert (crest <= largest).all()
        assert (crest > points[f"{channel}.root_mean_square"]).all()


def test_without_it_the_name_is_refused(platform: Platform) -> None:
    with pytest.raises(Refused, match="largest_impact_force"):
        platform.client.submit(SWEEP)
