"""Time as whole periods plus local time, so that period 10 000 is as sharp as the first."""

from solver import compensated
from solver.jit import kernel

product_difference = kernel()(compensated.product_difference)
