"""Statistics over a stretch of time, kept up while it is computed: flat memory, always one order.

One file a member, named by these two registries: statistics of channels on a uniform grid, and of
the contacts of pairs. A member takes what became known a few rows at a time, and its result has the
same bits however the rows were cut.
"""

from collections import ChainMap

from jointplay.records.channel import Channel
from jointplay.solver.statistics.contact_share import ContactShare
from jointplay.solver.statistics.impact_count import ImpactCount
from jointplay.solver.statistics.impact_force import LargestImpactForce
from jointplay.solver.statistics.mean import Mean
from jointplay.solver.statistics.mean_absolute import MeanAbsolute
from jointplay.solver.statistics.quantile import Quantile
from jointplay.solver.statistics.root_mean_square import RootMeanSquare
from jointplay.solver.statistics.standard_deviation import StandardDeviation
from jointplay.solver.statistics.statistic import ChannelStatistic, ContactStatistic, Grid

__all__ = ["OF_CHANNELS", "OF_CONTACTS", "STATISTICS", "Grid", "Output", "outputs_of"]

OF_CHANNELS: dict[str, ChannelStatistic] = {
    "mean": Mean(),
    "root_mean_square": RootMeanSquare(),
    "standard_deviation": StandardDeviation(),
    "mean_absolute": MeanAbsolute(),
    "quantile_05": Quantile(0.05),
    "median": Quantile(0.5),
    "quantile_95": Quantile(0.95),
}
OF_CONTACTS: dict[str, ContactStatistic] = {
    "impacts": ImpactCount(),
    "largest_impact_force": LargestImpactForce(),
    "contact_share": ContactShare(),
}
STATISTICS: ChainMap[str, ChannelStatistic | ContactStatistic] = ChainMap(
    OF_CONTACTS,  # type: ignore[arg-type]
    OF_CHANNELS,  # type: ignore[arg-type]
)
"""All of them, those of channels first."""

Output = tuple[str, str]
"""Unit and long name."""


def outputs_of(
    chosen: tuple[str, ...], channels: tuple[Channel, ...], pairs: tuple[str, ...]
) -> dict[str, Output]:
    """Return unit and long name of chosen statistics of channels and contact pairs.

    They are named after both: ``A.normal_force.mean``, ``A.contact_share``.
    """
    found: dict[str, Output] = {}
    for channel in channels:
        for name in chosen:
            if name in OF_CHANNELS:
                long_name = f"{OF_CHANNELS[name].long_name} of {channel.long_name}"
                found[f"{channel.name}.{name}"] = (channel.unit, long_name)
    for pair in pairs:
        for name in chosen:
            if name in OF_CONTACTS:
                of_pair = OF_CONTACTS[name]
                found[f"{pair}.{name}"] = (of_pair.unit, f"{of_pair.long_name} (joint {pair})")
    return found
