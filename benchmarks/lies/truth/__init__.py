"""An independent program: a scene's document, integrated by other equations and another method.

It reads the document and the bodies' first positions and velocities, and shares no line with the
solver: absolute coordinates with multipliers, constraints projected after every step, laws written
out again from their equations, Dormand and Prince's method of order 8 landing on onsets, releases
and kinks. Runs at two tolerances tell how far it can be believed itself.
"""

from benchmarks.lies.truth.channels import true_channels

__all__ = ["true_channels"]
