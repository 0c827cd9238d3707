"""Distributions of parameters: one file a distribution; this registry names them."""

from jointplay.solver.distributions.distribution import Distribution
from jointplay.solver.distributions.log_normal import LogNormal
from jointplay.solver.distributions.log_uniform import LogUniform
from jointplay.solver.distributions.normal import Normal
from jointplay.solver.distributions.triangular import Triangular
from jointplay.solver.distributions.truncated_normal import TruncatedNormal
from jointplay.solver.distributions.uniform import Uniform

DISTRIBUTIONS: dict[str, type[Distribution]] = {
    "uniform": Uniform,
    "normal": Normal,
    "truncated-normal": TruncatedNormal,
    "triangular": Triangular,
    "log-uniform": LogUniform,
    "log-normal": LogNormal,
}

__all__ = ["DISTRIBUTIONS", "Distribution"]
