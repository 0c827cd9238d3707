"""Statistics of channels on a uniform grid of time; one file a member, this roster names them."""

from jointplay.solver.statistics.of_channels.mean import Mean
from jointplay.solver.statistics.of_channels.mean_absolute import MeanAbsolute
from jointplay.solver.statistics.of_channels.quantile import Quantile
from jointplay.solver.statistics.of_channels.root_mean_square import RootMeanSquare
from jointplay.solver.statistics.of_channels.standard_deviation import StandardDeviation
from jointplay.solver.statistics.of_channels.statistic import ChannelStatistic, Grid

OF_CHANNELS: dict[str, ChannelStatistic] = {
    "mean": Mean(),
    "root_mean_square": RootMeanSquare(),
    "standard_deviation": StandardDeviation(),
    "mean_absolute": MeanAbsolute(),
    "quantile_05": Quantile(0.05),
    "median": Quantile(0.5),
    "quantile_95": Quantile(0.95),
}

__all__ = ["OF_CHANNELS", "ChannelStatistic", "Grid"]
