"""Nonlinear analysis of motions: kind of motion, exponents, periods, each with its error.

Independent of mechanisms: growth factors and sections come in, numbers with errors go out. Every
result is a function of its input alone; where chance is used, the seed is an argument. The way
through the folder:

1. `settling`: has the motion forgotten its start? `Settling` takes sections as they are computed.
2. On the sections of the settled motion
   - `recurrence`: `recurrence_period`, 1, 2, 3 … or 0;
   - `rotation`: `rotation_number` of a closed curve, or None;
   - `zero_one`: `zero_one_test`, K near 0 for regular and near 1 for chaotic motion;
   - `spectrum`: `power_spectrum`, lines or a continuum.
3. `lyapunov`: `exponent_from_growth` turns the growth of a tangent vector, or of the distance to a
   companion, into the largest exponent.
4. `verdict`: `decide` weighs them: periodic, quasi-periodic, chaotic, or undecided and why.

Numbers with errors are `estimate.Estimate`; what an error means is said there and, for means of
correlated numbers, in `batch_means`. The logistic map at r = 3.9, from the start:

>>> import numpy as np
>>> from jointplay.solver.nonlinear.lyapunov import exponent_from_growth
>>> from jointplay.solver.nonlinear.recurrence import recurrence_period
>>> from jointplay.solver.nonlinear.decision import decide
>>> from jointplay.solver.nonlinear.zero_one import zero_one_test
>>> orbit = np.empty((1000, 1))
>>> orbit[0] = 0.3
>>> for i in range(999):
...     orbit[i + 1] = 3.9 * orbit[i] * (1.0 - orbit[i])
>>> exponent = exponent_from_growth(np.log(np.abs(3.9 * (1.0 - 2.0 * orbit[:, 0]))), 1.0)
>>> period = recurrence_period(orbit[100:], scale=np.ones(1), tolerance=1e-3)
>>> decide(exponent, zero_one_test(orbit[100:]), period).name
'chaotic'

To add an indicator: a file with one function that returns an `Estimate`, a test on systems of
`tests/solver/nonlinear/textbook.py` with known answers, and a rule in `verdict.decide`.
"""
