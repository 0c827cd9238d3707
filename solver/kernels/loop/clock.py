"""Time as whole periods plus local time, so that period 10 000 is as sharp as the first."""

from jointplay.solver.kernels import compensated
from jointplay.solver.kernels.jit import kernel

product_difference = kernel()(compensated.product_difference)
